#pragma once
// A CSV with a header, by column name.

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "host/core/csv_lines.h"

namespace vkdose {

/// How to take a last line without a line break. In a file that a program still writes it may be half a line (Growing).
/// In a file that a person wrote it is a whole line.
enum class LastLine { Growing, Whole };

class Table {
  public:
    Table() = default;
    explicit Table(Row names) : names_(std::move(names)) {}

    /// Throws CaseError, naming the line, if there is no file, it is not CSV, or has a row of another length; ReadError
    /// if it cannot be read to its end. In a table that a person wrote (Whole) lines that begin with # are comments,
    /// and semicolons may part the fields, as spreadsheets do where decimals have a comma; then numbers may have one.
    static Table read(const std::filesystem::path& file, LastLine last = LastLine::Growing);

    /// Reads the whole lines of a table whose writer may have been killed. A line that lacks its end or a field is left
    /// out. The table is empty if there is no such file. Throws ReadError if it cannot be read to its end.
    static Table salvage(const std::filesystem::path& file);

    const Row& names() const { return names_; }
    bool has(std::string_view name) const;
    std::size_t rows() const { return rows_.size(); }
    const Row& row(std::size_t at) const { return rows_.at(at).fields; }

    /// Throws CaseError if there is no such column.
    const std::string& text(std::size_t row, std::string_view name) const;

    /// NaN where the field is empty or says nan. Throws CaseError if it is no number, or there is no such column.
    double number(std::size_t row, std::string_view name) const;
    std::vector<double> column(std::string_view name) const;

    /// The fault of a field, with its place in the file.
    [[noreturn]] void refuse(std::size_t row, std::string_view name, std::string problem, std::string remedy) const;

    void add(Row fields) { rows_.push_back({std::move(fields), 0}); }
    void removeIf(const std::function<bool(const Row&)>& condition);
    /// Rows that are equal stay in their order.
    void sort(const std::function<bool(const Row&, const Row&)>& less);

  private:
    struct Line {
        Row fields;
        int number = 0;  ///< of the line in the file; 0: the row does not come from a file
    };
    std::size_t place(std::string_view name) const;

    std::string file_;
    bool semicolons_ = false;  ///< they part the fields
    Row names_;
    std::vector<Line> rows_;
};

}  // namespace vkdose
