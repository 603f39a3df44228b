#pragma once
// The CSV tables of a run or a sweep, by column name.

#include <filesystem>
#include <string>
#include <vector>

namespace vkdose::report {

/// What to make of a last line without an end: in a file that a program still writes it may be half a line, in one
/// that a person wrote it is whole.
enum class LastLine { Growing, Whole };

class Table {
  public:
    /// Reads a file with a header. Throws CaseError, naming the line, if the file cannot be read, is not CSV, or has a
    /// row of another length.
    static Table read(const std::filesystem::path& file, LastLine last = LastLine::Growing);

    const std::vector<std::string>& names() const { return names_; }
    bool has(const std::string& name) const;
    std::size_t rows() const { return rows_.size(); }

    /// Throws CaseError if there is no such column.
    const std::string& text(std::size_t row, const std::string& name) const;

    /// NaN where the field is empty or says nan. Throws CaseError if it is no number, or there is no such column.
    double number(std::size_t row, const std::string& name) const;
    std::vector<double> column(const std::string& name) const;

  private:
    std::size_t place(const std::string& name) const;

    std::string file_;
    std::vector<std::string> names_;
    std::vector<std::vector<std::string>> rows_;
};

/// The whole of `text` as a number; NaN if it is none.
double numberIn(const std::string& text);

}  // namespace vkdose::report
