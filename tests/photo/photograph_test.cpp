// Files as cameras write them, and as accidents leave them.

#include "host/photo/photograph.h"

#include <leptonica/allheaders.h>
#include <unistd.h>

#include <array>
#include <fstream>

#include "host/photo/light.h"
#include "host/photo/profile.h"
#include "tests/app/sandbox.h"
#include "tests/photo/drawing.h"
#include "tests/support/catch.h"
#include "tests/support/near.h"

using namespace vkdose;
using namespace vkdose::photo;
using namespace vkdose::test;
namespace fs = std::filesystem;

namespace {

Drawing sine() {
    Drawing d;
    d.surface = [](double x) { return 90 + 25 * std::sin(2 * kPi * x / 150); };
    return d;
}

/// The drawing in brown and blue-grey, as a camera would see it.
Picture inColour(const Grey& grey) {
    Picture picture = held(pixCreate(grey.width, grey.height, 32));
    for (int y = 0; y < grey.height; ++y)
        for (int x = 0; x < grey.width; ++x) {
            const int v = grey.at(x, y);
            pixSetRGBPixel(picture.pix(), x, y, std::min(255, v + 25), v, v < 120 ? v / 2 : std::min(255, v + 10));
        }
    return picture;
}

double heightAt(const Picture& picture, int column) {
    Reading r;
    r.mmPerPixel = 1;
    return surfaceOf(picture, r).points[std::size_t(column)].heightMm.value();
}

std::string encoded(const Picture& picture, int format) {
    l_uint8* data = nullptr;
    std::size_t size = 0;
    REQUIRE(pixWriteMem(&data, &size, picture.pix(), format) == 0);
    std::string bytes(reinterpret_cast<const char*>(data), size);
    lept_free(data);
    return bytes;
}

/// A PNG of 4 x 4 black pixels whose header claims another size; its checksum is right.
std::string pngClaiming(std::uint32_t width, std::uint32_t height) {
    std::string png = encoded(held(pixCreate(4, 4, 8)), IFF_PNG);
    const auto put = [&png](std::size_t at, std::uint32_t v) {
        for (int i = 0; i < 4; ++i) png[at + std::size_t(i)] = char(v >> (24 - 8 * i));
    };
    put(16, width);
    put(20, height);
    std::uint32_t crc = 0xffffffffU;  // of "IHDR" and its 13 bytes, as the PNG specification computes it
    for (std::size_t i = 12; i < 29; ++i) {
        crc ^= std::uint8_t(png[i]);
        for (int k = 0; k < 8; ++k) crc = (crc & 1U) != 0 ? 0xedb88320U ^ (crc >> 1U) : crc >> 1U;
    }
    put(29, ~crc);
    return png;
}

}  // namespace

TEST_CASE("PNG, JPEG and TIFF, in grey and in colour, give the same surface") {
    const Sandbox box;
    const Grey grey = draw(sine());
    for (const bool colour : {false, true}) {
        const Picture picture = colour ? inColour(grey) : pictureOf(grey);
        for (const int format : {IFF_PNG, IFF_JFIF_JPEG, IFF_TIFF_LZW}) {
            const fs::path file = box.write("photo", encoded(picture, format));
            const Picture read = readPicture(file);
            REQUIRE(read.width() == grey.width);
            for (const int column : {3, 37, 112, 296}) {
                // As in a clean picture; JPEG blurs an edge by less than the half pixel more that is left for it.
                CAPTURE(colour, format, column);
                CHECK(near(heightAt(read, column), sine().surface(column + 0.5), 1, 1.5));
            }
        }
    }
}

TEST_CASE("what is transparent is white") {
    const Sandbox box;
    const Grey grey = draw(sine());
    const Picture picture = held(pixCreate(grey.width, grey.height, 32));
    pixSetSpp(picture.pix(), 4);
    for (int y = 0; y < grey.height; ++y)
        for (int x = 0; x < grey.width; ++x)  // black powder; the background black as well, but transparent
            pixSetPixel(picture.pix(), x, y, grey.at(x, y) < 125 ? 255U : 0U);
    const Picture read = readPicture(box.write("a.png", encoded(picture, IFF_PNG)));
    CHECK(near(heightAt(read, 37), sine().surface(37.5), 1, 1.0));
}

TEST_CASE("what is no picture is refused by name") {
    const Sandbox box;
    CHECK_THROWS_WITH(readPicture(box / "none.png"), Catch::Contains("none.png"));
    CHECK_THROWS_WITH(readPicture(box.path()), Catch::Contains("folder"));
    CHECK_THROWS_WITH(readPicture(box.write("empty.png", "")), Catch::Contains("empty"));
    for (const std::string text : {"x", "\x89PNG", "not a picture but some text", "GIF89a and more to come"})
        CHECK_THROWS_WITH(readPicture(box.write("text.png", text)), Catch::Contains("PNG, JPEG or TIFF"));
}

TEST_CASE("a picture that is cut off anywhere is refused") {
    const Sandbox box;
    const Grey grey = draw(sine());
    for (const int format : {IFF_PNG, IFF_JFIF_JPEG, IFF_TIFF_LZW}) {
        const std::string bytes = encoded(pictureOf(grey), format);
        // A TIFF may end in directories or padding that no reader needs, a PNG in its closing chunk of 12 bytes.
        for (const double share : {0.01, 0.1, 0.5, 0.9, 0.97}) {
            CAPTURE(format, share, bytes.size());
            const auto length = std::size_t(double(bytes.size()) * share);
            CHECK_THROWS_AS(readPicture(box.write("cut", bytes.substr(0, length))), PhotoError);
        }
    }
}

TEST_CASE("bytes turned over never do more than refuse the picture or change it") {
    const Sandbox box;
    const Grey grey = draw(sine());
    for (const int format : {IFF_PNG, IFF_JFIF_JPEG, IFF_TIFF_LZW}) {
        const std::string bytes = encoded(pictureOf(grey), format);
        int refused = 0;
        for (std::uint64_t trial = 0; trial < 60; ++trial) {
            std::string broken = bytes;
            // Half of them in the first hundred bytes, where sizes and tables stand.
            const auto u = uniforms(99, Stream::Jitter, trial);
            const double range = trial % 2 == 0 ? std::min(100.0, double(bytes.size())) : double(bytes.size());
            broken[std::size_t(u[0] * range)] ^= char(1 + int(u[1] * 254));
            try {
                const Picture picture = readPicture(box.write("broken", broken));
                CHECK(double(picture.width()) * picture.height() <= kMostPixels);
            } catch (const PhotoError&) {
                ++refused;
            }
        }
        CHECK(refused > 0);
    }
}

TEST_CASE("a picture of huge size is refused before it is read") {
    const Sandbox box;
    CHECK_THROWS_WITH(readPicture(box.write("a.png", pngClaiming(20000, 6000))),
                      Catch::Contains("20000 x 6000") && Catch::Contains("smaller"));
    CHECK_THROWS_AS(readPicture(box.write("b.png", pngClaiming(0x7fffffff, 0x7fffffff))), PhotoError);
    CHECK_THROWS_AS(readPicture(box.write("c.png", pngClaiming(0, 4))), PhotoError);
    CHECK_THROWS_AS(readPicture(box.write("d.png", pngClaiming(5000, 5000))), PhotoError);  // its pixels are missing
}

TEST_CASE("Otsu's threshold lies between two humps") {
    Grey two(10, 2);
    for (int x = 0; x < 10; ++x) {
        two.at(x, 0) = std::uint8_t(20 + x % 3);
        two.at(x, 1) = std::uint8_t(200 + x % 3);
    }
    CHECK(otsu(two) > 100);
    CHECK(otsu(two) < 125);
    // By hand: {0, 0, 1, 8, 9}; the variance between {0, 0, 1} and {8, 9} is largest.
    Grey hand(5, 1);
    hand.value = {0, 0, 1, 8, 9};
    CHECK(otsu(hand) > 1);
    CHECK(otsu(hand) <= 8);
    Grey flat(3, 1);
    flat.value = {7, 7, 7};
    CHECK(otsu(flat) == 0);
}
