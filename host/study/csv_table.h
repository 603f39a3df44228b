#pragma once
// The tables of a study: CSV with a header, a row on a line, fields in quotes where they hold a comma.

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace vkdose {

using Row = std::vector<std::string>;

struct CsvTable {
    Row header;
    std::vector<Row> rows;

    /// Index of a column; nothing if there is none of this name.
    std::optional<std::size_t> column(std::string_view name) const;
    /// A field as a number; nothing if it is empty or no number, or there is no such column.
    std::optional<double> number(const Row& row, std::string_view name) const;
    /// A field as it stands; empty if there is no such column.
    std::string text(const Row& row, std::string_view name) const;
};

/// One line, without its end. A line break in a field becomes a blank: a row stays on a line.
std::string csvLine(const Row& fields);

/// Takes a line apart.
Row csvFields(std::string_view line);

/// Reads a table. A last line that lacks its end (the writer was killed) or a field is left out. An empty table if
/// there is no such file.
CsvTable readTable(const std::filesystem::path& file);

}  // namespace vkdose
