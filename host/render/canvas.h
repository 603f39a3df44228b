#pragma once
// A picture to write and draw on, over the library cairo. Places are in pixels from the top left corner, colours in
// sRGB.

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "host/core/vec.h"
#include "host/render/ray_caster.h"

struct _cairo;  // cairo's own names, so that only canvas.cpp includes it
struct _cairo_surface;

namespace vkdose::render {

class Canvas {
  public:
    /// White. Throws OutputError if there is no memory for it.
    Canvas(int width, int height);

    int width() const { return width_; }
    int height() const { return height_; }

    struct Point {
        double x, y;
    };
    enum class Align { Left, Centre, Right };

    /// Draws the image with its top left corner at (left, top). Pixels that it does not cover stay.
    void image(const Image& image, int left, int top);
    void line(const std::vector<Point>& points, double thickness, const Vec3& colour);
    void box(double left, double top, double width, double height, const Vec3& colour);
    /// Writes on the line y, with the text's left end, middle or right end at x. `size`: height of a line [pixels].
    void text(const std::string& text, double x, double y, double size, const Vec3& colour, Align align = Align::Left);
    /// Reading upwards, its middle at y.
    void textUpwards(const std::string& text, double x, double y, double size, const Vec3& colour);
    double textWidth(const std::string& text, double size);
    /// Nothing is drawn outside of this box until `unclip`.
    void clip(double left, double top, double width, double height);
    void unclip();

    /// Components from 0 to 1.
    Vec3 colourAt(int x, int y) const;
    /// Rows of pixels from the top, each blue, green, red and a byte of no meaning.
    std::vector<std::uint8_t> bytes() const;
    /// As a PNG file. Throws OutputError if there is no memory for it.
    std::string png() const;

  private:
    struct Close {
        void operator()(_cairo* c) const;
        void operator()(_cairo_surface* s) const;
    };
    void font(double size);
    void ink(const Vec3& colour);

    int width_, height_;
    std::unique_ptr<_cairo_surface, Close> surface_;
    std::unique_ptr<_cairo, Close> cairo_;
};

}  // namespace vkdose::render
