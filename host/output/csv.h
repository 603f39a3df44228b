#pragma once
// A CSV file that is written line by line and can be read while the run goes on.

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace vkdose {

/// Length and checksum of a file when it was stored.
struct CsvMark {
    std::uint64_t bytes = 0;
    std::optional<std::uint32_t> checksum = std::nullopt;  ///< CRC-32 of them; none if it was not noted
};

class CsvFile {
  public:
    /// Creates or replaces the file and writes its header. Throws OutputError if that fails.
    CsvFile(std::filesystem::path path, std::string_view header);

    /// Goes on with an existing file after its content at `mark`. Later content is cut off when the first line is
    /// written. Throws OutputError if the file is shorter, has been changed before that place or cannot be written.
    CsvFile(std::filesystem::path path, const CsvMark& mark);

    /// Appends one line. Throws OutputError if it cannot be written (a full disk).
    void line(const std::string& fields);

    /// Makes everything written so far visible to readers. Throws OutputError likewise, or if the file is no longer
    /// where it was, because nobody would find the lines.
    void flush();

    /// Makes everything written so far survive a crash of the machine. Returns the file's length and checksum.
    CsvMark store();

  private:
    struct Close {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };
    void cut();
    [[noreturn]] void fail() const;
    void requireSame(const CsvMark& mark);
    bool isWhereItWas() const;

    std::filesystem::path path_;
    std::unique_ptr<std::FILE, Close> file_;
    std::uint32_t checksum_ = 0;  ///< of the content before the present place
    bool cut_ = false;            ///< the content after the present place must be cut off
};

}  // namespace vkdose
