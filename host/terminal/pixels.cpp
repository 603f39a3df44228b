#include "host/terminal/pixels.h"

#include <fmt/format.h>

#include <algorithm>

namespace vkdose::terminal {

namespace {

constexpr const char* kReset = "\033[0m";

/// The code that selects a colour for the character (38) or for its background (48).
std::string selecting(int what, const Colour& c) {
    return fmt::format("\033[{};2;{};{};{}m", what, c.red, c.green, c.blue);
}

/// Remembers the colours selected, so that it writes a code only when a colour changes.
class Pen {
  public:
    void cell(std::string& line, const std::optional<Colour>& top, const std::optional<Colour>& bottom) {
        const std::string fore = top ? selecting(38, *top) : bottom ? selecting(38, *bottom) : std::string();
        const std::string back = top && bottom ? selecting(48, *bottom) : std::string();
        if (back.empty() && !back_.empty()) {
            line += kReset;
            fore_.clear();
            back_.clear();
        }
        if (!fore.empty() && fore != fore_) line += fore_ = fore;
        if (back != back_) line += back_ = back;
        line += fore.empty() ? " " : top ? "▀" : "▄";
    }
    bool used() const { return !fore_.empty() || !back_.empty(); }

  private:
    std::string fore_, back_;
};

}  // namespace

std::string utf8(unsigned codePoint) {
    return {char(0xe0U | (codePoint >> 12U)), char(0x80U | ((codePoint >> 6U) & 0x3fU)),
            char(0x80U | (codePoint & 0x3fU))};
}

Canvas::Canvas(int columns, int rows, Style style)
    : columns_(std::max(columns, 0)),
      rows_(std::max(rows, 0)),
      style_(style),
      width_(columns_ * pixelsAcross(style)),
      height_(rows_ * pixelsDown(style)),
      pixels_(std::size_t(width_) * std::size_t(height_)) {}

void Canvas::light(int x, int y, Colour colour) {
    if (holds(x, y)) pixels_[std::size_t(y) * std::size_t(width_) + std::size_t(x)] = colour;
}

void Canvas::darken(int x, int y) {
    if (holds(x, y)) pixels_[std::size_t(y) * std::size_t(width_) + std::size_t(x)].reset();
}

std::optional<Colour> Canvas::at(int x, int y) const {
    if (!holds(x, y)) return std::nullopt;
    return pixels_[std::size_t(y) * std::size_t(width_) + std::size_t(x)];
}

std::vector<std::string> Canvas::lines() const {
    std::vector<std::string> lines;
    for (int row = 0; row < rows_; ++row) lines.push_back(style_ == Style::Colour ? colourLine(row) : brailleLine(row));
    return lines;
}

std::string Canvas::colourLine(int row) const {
    std::string line;
    Pen pen;
    for (int x = 0; x < columns_; ++x) pen.cell(line, at(x, 2 * row), at(x, 2 * row + 1));
    if (pen.used()) line += kReset;
    return line;
}

std::string Canvas::brailleLine(int row) const {
    // Bit of the dot in column i and row j. Unicode numbers the upper three rows first, column by column.
    static constexpr unsigned kDot[2][4] = {{0x01, 0x02, 0x04, 0x40}, {0x08, 0x10, 0x20, 0x80}};
    std::string line;
    for (int column = 0; column < columns_; ++column) {
        unsigned dots = 0;
        for (int i = 0; i < 2; ++i)
            for (int j = 0; j < 4; ++j)
                if (at(2 * column + i, 4 * row + j)) dots |= kDot[i][j];
        line += dots == 0 ? std::string(" ") : utf8(0x2800 + dots);
    }
    return line;
}

}  // namespace vkdose::terminal
