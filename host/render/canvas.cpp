#include "host/render/canvas.h"

#include <cairo/cairo.h>
#include <fmt/format.h>

#include <cstring>

#include "host/core/error.h"

namespace vkdose::render {

namespace {

void require(cairo_status_t status) {
    if (status != CAIRO_STATUS_SUCCESS)
        throw OutputError(fmt::format("cannot draw the picture: {}", cairo_status_to_string(status)));
}

std::uint32_t blended(Image::Pixel p, std::uint32_t under) {
    const auto channel = [&](int shift, unsigned over) {
        return ((over * p.cover + (under >> shift & 255u) * (255u - p.cover) + 127u) / 255u) << shift;
    };
    return channel(16, p.red) | channel(8, p.green) | channel(0, p.blue);
}

}  // namespace

void Canvas::Close::operator()(_cairo* c) const {
    cairo_destroy(c);
}
void Canvas::Close::operator()(_cairo_surface* s) const {
    cairo_surface_destroy(s);
}

Canvas::Canvas(int width, int height)
    : width_(width), height_(height), surface_(cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height)) {
    require(cairo_surface_status(surface_.get()));
    cairo_.reset(cairo_create(surface_.get()));
    require(cairo_status(cairo_.get()));
    box(0, 0, width, height, Vec3(1));
}

void Canvas::ink(const Vec3& colour) {
    cairo_set_source_rgb(cairo_.get(), colour.x, colour.y, colour.z);
}

void Canvas::font(double size) {
    cairo_select_font_face(cairo_.get(), "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(cairo_.get(), size);
}

void Canvas::image(const Image& image, int left, int top) {
    cairo_surface_flush(surface_.get());
    unsigned char* data = cairo_image_surface_get_data(surface_.get());
    const int stride = cairo_image_surface_get_stride(surface_.get());
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            if (x + left < 0 || x + left >= width_ || y + top < 0 || y + top >= height_) continue;
            unsigned char* at = data + std::ptrdiff_t(y + top) * stride + std::ptrdiff_t(x + left) * 4;
            std::uint32_t word = 0;
            std::memcpy(&word, at, sizeof word);
            word = blended(image.at(x, y), word);
            std::memcpy(at, &word, sizeof word);
        }
    cairo_surface_mark_dirty(surface_.get());
}

void Canvas::line(const std::vector<Point>& points, double thickness, const Vec3& colour) {
    if (points.size() < 2) return;
    ink(colour);
    cairo_set_line_width(cairo_.get(), thickness);
    cairo_set_line_join(cairo_.get(), CAIRO_LINE_JOIN_ROUND);
    cairo_new_path(cairo_.get());
    for (const Point& p : points) cairo_line_to(cairo_.get(), p.x, p.y);
    cairo_stroke(cairo_.get());
}

void Canvas::box(double left, double top, double width, double height, const Vec3& colour) {
    ink(colour);
    cairo_rectangle(cairo_.get(), left, top, width, height);
    cairo_fill(cairo_.get());
}

double Canvas::textWidth(const std::string& text, double size) {
    font(size);
    cairo_text_extents_t extents;
    cairo_text_extents(cairo_.get(), text.c_str(), &extents);
    return extents.x_advance;
}

void Canvas::text(const std::string& text, double x, double y, double size, const Vec3& colour, Align align) {
    const double width = textWidth(text, size);
    ink(colour);
    cairo_move_to(cairo_.get(), align == Align::Left ? x : align == Align::Centre ? x - width / 2 : x - width, y);
    cairo_show_text(cairo_.get(), text.c_str());
}

void Canvas::textUpwards(const std::string& text, double x, double y, double size, const Vec3& colour) {
    cairo_save(cairo_.get());
    cairo_translate(cairo_.get(), x, y);
    cairo_rotate(cairo_.get(), -kPi / 2);
    this->text(text, 0, 0, size, colour, Align::Centre);
    cairo_restore(cairo_.get());
}

void Canvas::clip(double left, double top, double width, double height) {
    cairo_rectangle(cairo_.get(), left, top, width, height);
    cairo_clip(cairo_.get());
}

void Canvas::unclip() {
    cairo_reset_clip(cairo_.get());
}

Vec3 Canvas::colourAt(int x, int y) const {
    cairo_surface_flush(surface_.get());
    const unsigned char* at = cairo_image_surface_get_data(surface_.get()) +
                              std::ptrdiff_t(y) * cairo_image_surface_get_stride(surface_.get()) +
                              std::ptrdiff_t(x) * 4;
    std::uint32_t word = 0;
    std::memcpy(&word, at, sizeof word);
    return Vec3(word >> 16 & 255u, word >> 8 & 255u, word & 255u) / 255.0;
}

std::vector<std::uint8_t> Canvas::bytes() const {
    cairo_surface_flush(surface_.get());
    const unsigned char* data = cairo_image_surface_get_data(surface_.get());
    const int stride = cairo_image_surface_get_stride(surface_.get());
    std::vector<std::uint8_t> bytes;
    for (int y = 0; y < height_; ++y) {
        const unsigned char* row = data + std::ptrdiff_t(y) * stride;
        bytes.insert(bytes.end(), row, row + std::ptrdiff_t(width_) * 4);
    }
    return bytes;
}

std::string Canvas::png() const {
    std::string file;
    const auto append = [](void* to, const unsigned char* data, unsigned size) {
        static_cast<std::string*>(to)->append(reinterpret_cast<const char*>(data), size);
        return CAIRO_STATUS_SUCCESS;
    };
    require(cairo_surface_write_to_png_stream(surface_.get(), append, &file));
    return file;
}

}  // namespace vkdose::render
