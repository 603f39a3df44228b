#include "host/report/table.h"

#include <csv.h>
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <limits>
#include <sstream>

#include "host/core/error.h"

namespace vkdose::report {

namespace {

using Rows = std::vector<std::vector<std::string>>;

[[noreturn]] void refuse(const std::string& file, std::size_t line, std::string problem, std::string remedy) {
    throw CaseError({{file, static_cast<int>(line), "", "", std::move(problem), std::move(remedy)}});
}

Rows parse(const std::string& text, const std::string& file) {
    csv_parser parser{};
    csv_init(&parser, CSV_STRICT | CSV_STRICT_FINI);
    Rows rows(1);
    const auto onField = [](void* field, std::size_t size, void* out) {
        static_cast<Rows*>(out)->back().emplace_back(static_cast<const char*>(field), size);
    };
    const auto onRow = [](int, void* out) { static_cast<Rows*>(out)->emplace_back(); };
    const bool good = csv_parse(&parser, text.data(), text.size(), onField, onRow, &rows) == text.size() &&
                      csv_fini(&parser, onField, onRow, &rows) == 0;
    csv_free(&parser);
    if (!good) refuse(file, rows.size(), "is not CSV", "separate the fields by commas, quote those that hold quotes");
    rows.pop_back();  // the one that the last line's end began
    return rows;
}

}  // namespace

double numberIn(const std::string& text) {
    double value = 0;
    const auto [stop, code] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool whole = code == std::errc() && stop == text.data() + text.size();
    return whole ? value : std::numeric_limits<double>::quiet_NaN();
}

Table Table::read(const std::filesystem::path& file, LastLine last) {
    std::ifstream stream(file, std::ios::binary);
    std::ostringstream content;
    content << stream.rdbuf();
    if (!stream) refuse(file.string(), 0, "cannot be read", "give a folder that vkdose wrote, or a CSV");
    std::string text = content.str();
    if (last == LastLine::Whole && !text.empty() && text.back() != '\n') text += '\n';
    text.erase(text.rfind('\n') == std::string::npos ? 0 : text.rfind('\n') + 1);
    if (text.starts_with("\xef\xbb\xbf")) text.erase(0, 3);

    Table table;
    table.file_ = file.string();
    table.rows_ = parse(text, table.file_);
    if (table.rows_.empty()) refuse(table.file_, 0, "is empty", "begin with a header");
    table.names_ = table.rows_.front();
    table.rows_.erase(table.rows_.begin());
    for (std::size_t i = 0; i < table.rows_.size(); ++i)
        if (table.rows_[i].size() != table.names_.size())
            refuse(table.file_, i + 2,
                   fmt::format("has {} fields, the header {}", table.rows_[i].size(), table.names_.size()),
                   "give one field for each column");
    return table;
}

bool Table::has(const std::string& name) const {
    return std::find(names_.begin(), names_.end(), name) != names_.end();
}

std::size_t Table::place(const std::string& name) const {
    const auto found = std::find(names_.begin(), names_.end(), name);
    if (found == names_.end()) refuse(file_, 1, "lacks the column " + name, "give it, or a table that has it");
    return static_cast<std::size_t>(found - names_.begin());
}

const std::string& Table::text(std::size_t row, const std::string& name) const {
    return rows_.at(row)[place(name)];
}

double Table::number(std::size_t row, const std::string& name) const {
    const std::string& field = text(row, name);
    const double value = numberIn(field);
    if (value != value && !field.empty() && field != "nan" && field != "-nan")
        throw CaseError({{file_, static_cast<int>(row) + 2, name, field, "is not a number", "give a plain number"}});
    return value;
}

std::vector<double> Table::column(const std::string& name) const {
    std::vector<double> values;
    for (std::size_t i = 0; i < rows(); ++i) values.push_back(number(i, name));
    return values;
}

}  // namespace vkdose::report
