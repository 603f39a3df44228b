#pragma once
// The deflated data of a page, taken apart.

#include <zlib.h>

#include <cstdint>
#include <string>
#include <vector>

#include "tests/support/catch.h"

namespace vkdose::test {

inline std::string fromBase64(const std::string& text) {
    const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string bytes;
    std::uint32_t word = 0;
    int bits = 0;
    for (const char c : text) {
        if (c == '=') break;
        word = word << 6 | static_cast<std::uint32_t>(digits.find(c));
        bits += 6;
        if (bits >= 8) bytes += static_cast<char>(word >> (bits -= 8) & 255);
    }
    return bytes;
}

/// The stream's bytes, to be taken from front to back.
class Bytes {
  public:
    explicit Bytes(const std::string& stream) {
        const std::string packed = fromBase64(stream);
        plain_.resize(40'000'000);
        uLongf size = plain_.size();
        REQUIRE(uncompress(plain_.data(), &size, reinterpret_cast<const Bytef*>(packed.data()), packed.size()) == Z_OK);
        plain_.resize(size);
    }
    std::vector<int> levels(std::size_t n) {
        std::vector<int> list(plain_.begin() + at_, plain_.begin() + at_ + n);
        at_ += n;
        return list;
    }
    std::vector<int> words(std::size_t n) {
        std::vector<int> low = levels(n), high = levels(n);
        for (std::size_t i = 0; i < n; ++i) low[i] += 256 * high[i];
        return low;
    }
    /// Adds differences to `values`.
    void wordsOnTop(std::vector<int>& values) {
        const std::vector<int> change = words(values.size());
        for (std::size_t i = 0; i < values.size(); ++i)
            values[i] = (values[i] + (change[i] % 2 == 0 ? change[i] / 2 : -(change[i] + 1) / 2)) & 65535;
    }
    void levelsOnTop(std::vector<int>& values) {
        const std::vector<int> change = levels(values.size());
        for (std::size_t i = 0; i < values.size(); ++i) values[i] = (values[i] + change[i]) & 255;
    }
    bool over() const { return at_ == plain_.size(); }

  private:
    std::vector<std::uint8_t> plain_;
    std::size_t at_ = 0;
};

}  // namespace vkdose::test
