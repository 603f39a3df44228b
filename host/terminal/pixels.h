#pragma once
// Pixels made of characters. Where a terminal has 24-bit colour, they are two coloured halves of a cell, else the eight
// dots of a braille character. Either way a pixel is as wide as high if a cell is twice as high as wide.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace vkdose::terminal {

enum class Style { Colour, Plain };

struct Colour {
    std::uint8_t red = 0, green = 0, blue = 0;
    bool operator==(const Colour&) const = default;
};

class Canvas {
  public:
    /// A canvas of so many character cells, all dark.
    Canvas(int columns, int rows, Style style);

    static int pixelsAcross(Style style) { return style == Style::Colour ? 1 : 2; }  ///< a cell
    static int pixelsDown(Style style) { return style == Style::Colour ? 2 : 4; }

    Style style() const { return style_; }
    int width() const { return width_; }  ///< [pixels]
    int height() const { return height_; }

    /// Lights a pixel, x to the right and y down from the upper left corner. A pixel outside is ignored.
    void light(int x, int y, Colour colour);
    void darken(int x, int y);
    std::optional<Colour> at(int x, int y) const;

    /// A line of text for each row of cells, UTF-8. Each line has all its cells and leaves no colour set.
    std::vector<std::string> lines() const;

  private:
    bool holds(int x, int y) const { return x >= 0 && x < width_ && y >= 0 && y < height_; }
    std::string colourLine(int row) const;
    std::string brailleLine(int row) const;

    int columns_, rows_;
    Style style_;
    int width_, height_;
    std::vector<std::optional<Colour>> pixels_;
};

/// The character of a code point from U+0800 to U+FFFF, as UTF-8.
std::string utf8(unsigned codePoint);

}  // namespace vkdose::terminal
