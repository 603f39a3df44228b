#pragma once
// A CSV file that is written line by line and can be read while the run goes on.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "host/core/output_file.h"

namespace vkdose {

/// Length and checksum of a file when it was stored.
struct CsvMark {
    std::uint64_t bytes = 0;
    std::optional<std::uint32_t> checksum = std::nullopt;  ///< CRC-32 of them, if it was noted
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
    void requireSame(const CsvMark& mark);
    void cut();
    void hold(std::string_view text);
    void write();

    std::filesystem::path path_;
    OutputFile file_;
    std::string held_;            ///< lines that are not yet written
    std::uint64_t at_ = 0;        ///< bytes before the next line
    std::uint32_t checksum_ = 0;  ///< of the content before the present place
    bool cut_ = false;            ///< the content after the present place must be cut off
};

}  // namespace vkdose
