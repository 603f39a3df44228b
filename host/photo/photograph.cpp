#include "host/photo/photograph.h"

#include <fmt/format.h>
#include <leptonica/allheaders.h>

#include <new>
#include <optional>
#include <utility>

#include "host/core/file.h"

namespace vkdose::photo {

namespace {

constexpr int kLeastRegion = 8;
/// The number of bytes that Leptonica reads to recognise a format.
constexpr std::size_t kLeastBytes = 12;

std::string bytesOf(const std::filesystem::path& file) {
    std::optional<std::string> bytes = fileContent(file);
    if (!bytes) throw PhotoError(unreadable(file) + "; name a picture");
    if (bytes->empty()) throw PhotoError(file.string() + " is empty; give a PNG, JPEG or TIFF");
    return *std::move(bytes);
}

/// Name of a format that is taken; null for any other.
const char* nameOf(int format) {
    switch (format) {
        case IFF_PNG:
            return "PNG";
        case IFF_JFIF_JPEG:
            return "JPEG";
        case IFF_TIFF:
        case IFF_TIFF_PACKBITS:
        case IFF_TIFF_RLE:
        case IFF_TIFF_G3:
        case IFF_TIFF_G4:
        case IFF_TIFF_LZW:
        case IFF_TIFF_ZIP:
        case IFF_TIFF_JPEG:
            return "TIFF";
        default:
            return nullptr;
    }
}

}  // namespace

Picture held(Pix* pix) {
    if (pix == nullptr) throw std::bad_alloc();
    return Picture(pix);
}

Picture::~Picture() {
    pixDestroy(&pix_);
}

int Picture::width() const {
    return pixGetWidth(pix_);
}

int Picture::height() const {
    return pixGetHeight(pix_);
}

Picture readPicture(const std::filesystem::path& file) {
    setMsgSeverity(L_SEVERITY_NONE);  // its messages are for programmers; ours follow
    const std::string bytes = bytesOf(file);
    const auto* data = reinterpret_cast<const l_uint8*>(bytes.data());
    int format = IFF_UNKNOWN;
    if (bytes.size() >= kLeastBytes) findFileFormatBuffer(data, &format);
    const char* name = nameOf(format);
    if (name == nullptr) throw PhotoError(file.string() + " is no picture that can be read; give a PNG, JPEG or TIFF");

    int width = 0, height = 0;
    const bool header = pixReadHeaderMem(data, bytes.size(), nullptr, &width, &height, nullptr, nullptr, nullptr) == 0;
    if (header && double(width) * double(height) > kMostPixels)
        throw PhotoError(fmt::format("{} has {} x {} pixels; make it smaller, {:.0f} million are read at most",
                                     file.string(), width, height, kMostPixels / 1e6));
    Pix* pix = header ? pixReadMem(data, bytes.size()) : nullptr;
    if (pix == nullptr)
        throw PhotoError(fmt::format("{} is a damaged {}, or cut off; save it again, or as PNG", file.string(), name));
    const Picture read(pix);
    return held(pixRemoveAlpha(read.pix()));
}

Region whole(const Picture& picture) {
    return {0, 0, picture.width(), picture.height()};
}

Grey greyOf(const Picture& picture, const Region& r) {
    const auto refuse = [&](const char* fault) {
        throw PhotoError(fmt::format("the region {},{},{},{} {}; the picture is {} x {} pixels", r.x, r.y, r.width,
                                     r.height, fault, picture.width(), picture.height()));
    };
    if (r.width < kLeastRegion || r.height < kLeastRegion) refuse("is too small, it takes at least 8 x 8");
    if (r.x < 0 || r.y < 0 || r.x > picture.width() - r.width || r.y > picture.height() - r.height)
        refuse("(x, y, width, height) reaches beyond the picture");

    BOX* box = boxCreate(r.x, r.y, r.width, r.height);
    Pix* cut = pixClipRectangle(picture.pix(), box, nullptr);
    boxDestroy(&box);
    const Picture part = held(cut);
    const Picture grey = held(pixConvertTo8(part.pix(), 0));
    const Picture calm = held(pixMedianFilter(grey.pix(), 3, 3));

    Grey out(r.width, r.height);
    for (int y = 0; y < r.height; ++y) {
        const l_uint32* line = pixGetData(calm.pix()) + std::ptrdiff_t(y) * pixGetWpl(calm.pix());
        for (int x = 0; x < r.width; ++x) out.at(x, y) = std::uint8_t(GET_DATA_BYTE(line, x));
    }
    return out;
}

Picture pictureOf(const Grey& grey) {
    Picture picture = held(pixCreate(grey.width, grey.height, 8));
    for (int y = 0; y < grey.height; ++y) {
        l_uint32* line = pixGetData(picture.pix()) + std::ptrdiff_t(y) * pixGetWpl(picture.pix());
        for (int x = 0; x < grey.width; ++x) SET_DATA_BYTE(line, x, grey.at(x, y));
    }
    return picture;
}

std::string pngBytes(const Picture& picture) {
    l_uint8* data = nullptr;
    std::size_t size = 0;
    if (pixWriteMemPng(&data, &size, picture.pix(), 0) != 0) throw std::bad_alloc();
    std::string bytes(reinterpret_cast<const char*>(data), size);
    lept_free(data);
    return bytes;
}

}  // namespace vkdose::photo
