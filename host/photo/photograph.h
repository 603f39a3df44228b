#pragma once
// Photographs. Leptonica reads, cuts, greys and writes them. Its own types end here.

#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

struct Pix;

namespace vkdose::photo {

/// A photograph from which nothing can be read, or options that do not fit it. The text says what would be right.
class PhotoError : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// A part of a picture [pixels]; x to the right and y down from the upper left corner.
struct Region {
    int x = 0, y = 0, width = 0, height = 0;
};

/// Grey values, row by row from the top: 0 black, 255 white.
struct Grey {
    int width = 0, height = 0;
    std::vector<std::uint8_t> value;

    Grey(int w, int h) : width(w), height(h), value(std::size_t(w) * std::size_t(h)) {}
    std::uint8_t& at(int x, int y) { return value[std::size_t(y) * std::size_t(width) + std::size_t(x)]; }
    std::uint8_t at(int x, int y) const { return value[std::size_t(y) * std::size_t(width) + std::size_t(x)]; }
};

/// A picture in colour or grey, as the file holds it.
class Picture {
  public:
    /// Takes over `pix`, which must not be null.
    explicit Picture(Pix* pix) : pix_(pix) {}
    ~Picture();
    Picture(Picture&& other) noexcept : pix_(other.pix_) { other.pix_ = nullptr; }
    Picture& operator=(Picture&&) = delete;
    Picture(const Picture&) = delete;
    Picture& operator=(const Picture&) = delete;

    int width() const;
    int height() const;
    Pix* pix() const { return pix_; }

  private:
    Pix* pix_;
};

/// Takes over the result of a call of Leptonica. Leptonica gives null only when memory is short; null throws
/// std::bad_alloc.
Picture held(Pix* pix);

/// The most pixels that a picture may have. A larger picture is refused before any pixel is read.
inline constexpr double kMostPixels = 100e6;

/// Reads a PNG, JPEG or TIFF (its first page). Transparent parts become white. Throws PhotoError if there is no
/// picture, or only a part of one.
Picture readPicture(const std::filesystem::path& file);

/// The whole picture.
Region whole(const Picture& picture);

/// The region in grey, each pixel the median of the 3 x 3 around it, so that a camera's noise does not fray edges.
/// Throws PhotoError if the region is not within the picture, or smaller than 8 x 8.
Grey greyOf(const Picture& picture, const Region& region);

/// A picture of grey values.
Picture pictureOf(const Grey& grey);

/// The bytes of a PNG file.
std::string pngBytes(const Picture& picture);

}  // namespace vkdose::photo
