#pragma once
// Bytes as a text that a page can hold and a browser's DecompressionStream takes.

#include <cstdint>
#include <memory>
#include <span>
#include <string>

namespace vkdose::report {

/// A growing zlib stream (RFC 1950), whose length so far can be asked.
class Deflate {
  public:
    Deflate();
    ~Deflate();
    Deflate(const Deflate&) = delete;
    Deflate& operator=(const Deflate&) = delete;
    Deflate(Deflate&&) noexcept = default;
    Deflate& operator=(Deflate&&) noexcept = default;

    void add(std::span<const std::uint8_t> bytes);
    std::size_t size() const { return packed_.size(); }  ///< of what has left the compressor's window

    /// The whole stream. Nothing may be added afterwards.
    const std::string& finish();

  private:
    struct Stream;
    void run(std::span<const std::uint8_t> bytes, int flush);

    std::unique_ptr<Stream> stream_;
    std::string packed_;
};

/// In base64 (RFC 4648), four characters for three bytes.
std::string base64(std::string_view bytes);

}  // namespace vkdose::report
