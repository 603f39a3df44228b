#include "host/report/deflate.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <stdexcept>

namespace vkdose::report {

struct Deflate::Stream {
    z_stream z{};
    Stream() {
        if (deflateInit(&z, Z_DEFAULT_COMPRESSION) != Z_OK) throw std::bad_alloc();
    }
    ~Stream() { deflateEnd(&z); }
    Stream(const Stream&) = delete;
    Stream& operator=(const Stream&) = delete;
};

Deflate::Deflate() : stream_(std::make_unique<Stream>()) {}
Deflate::~Deflate() = default;

void Deflate::add(std::span<const std::uint8_t> bytes) {
    run(bytes, Z_NO_FLUSH);
}

const std::string& Deflate::finish() {
    run({}, Z_FINISH);
    return packed_;
}

void Deflate::run(std::span<const std::uint8_t> bytes, int flush) {
    z_stream& z = stream_->z;
    z.next_in = const_cast<Bytef*>(bytes.data());  // zlib does not write there
    z.avail_in = static_cast<uInt>(bytes.size());
    std::array<std::uint8_t, 65536> room{};
    do {
        z.next_out = room.data();
        z.avail_out = static_cast<uInt>(room.size());
        if (deflate(&z, flush) == Z_STREAM_ERROR) throw std::logic_error("a zlib stream was added to after its end");
        packed_.append(reinterpret_cast<const char*>(room.data()), room.size() - z.avail_out);
    } while (z.avail_out == 0);
}

std::string base64(std::string_view bytes) {
    static constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const std::size_t given = std::min<std::size_t>(3, bytes.size() - i);
        std::uint32_t word = 0;
        for (std::size_t k = 0; k < 3; ++k)
            word = word << 8 | (k < given ? static_cast<std::uint8_t>(bytes[i + k]) : 0u);
        for (std::size_t k = 0; k < 4; ++k) text += k <= given ? kDigits[word >> (18 - 6 * k) & 63] : '=';
    }
    return text;
}

}  // namespace vkdose::report
