#pragma once
// A CSV file that is written line by line and can be read while the run goes on.

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

namespace vkdose {

class CsvFile {
  public:
    /// Creates or replaces the file and writes its header. Throws RunError if that fails.
    CsvFile(std::filesystem::path path, std::string_view header);

    /// Appends one line. Throws RunError if it cannot be written (a full disk).
    void line(const std::string& fields);

    /// Makes everything written so far visible to readers. Throws RunError likewise.
    void flush();

  private:
    void check();

    std::filesystem::path path_;
    std::ofstream stream_;
};

}  // namespace vkdose
