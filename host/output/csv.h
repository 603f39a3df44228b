#pragma once
// A CSV file that is written line by line and can be read while the run goes on.

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

namespace vkdose {

class CsvFile {
  public:
    /// Creates or replaces the file and writes its header. Throws OutputError if that fails.
    CsvFile(std::filesystem::path path, std::string_view header);

    /// Goes on with an existing file after its first `bytes`; what follows is cut off when the first line is written.
    /// Throws OutputError if the file is shorter or cannot be written.
    CsvFile(std::filesystem::path path, std::uint64_t bytes);

    /// Appends one line. Throws OutputError if it cannot be written (a full disk).
    void line(const std::string& fields);

    /// Makes everything written so far visible to readers. Throws OutputError likewise.
    void flush();

    /// Makes everything written so far survive a crash of the machine, and tells how much that is.
    std::uint64_t store();

  private:
    struct Close {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };
    [[noreturn]] void fail() const;

    std::filesystem::path path_;
    std::unique_ptr<std::FILE, Close> file_;
    bool cut_ = false;  ///< what follows the present place has to go
};

}  // namespace vkdose
