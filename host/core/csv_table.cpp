#include "host/core/csv_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>

#include "host/core/error.h"
#include "host/core/file.h"
#include "host/core/printable.h"

namespace vkdose {

namespace {

[[noreturn]] void refuseLine(const std::string& file, int line, std::string problem, std::string remedy) {
    throw CaseError({{file, line, "", "", std::move(problem), std::move(remedy)}});
}

/// A number whose decimals have a comma, with a point.
std::string withPoint(std::string field) {
    const std::size_t comma = field.find(',');
    if (comma != std::string::npos && field.find('.') == std::string::npos) field[comma] = '.';
    return field;
}

/// The names of the first few columns, for a message.
std::string firstOf(const Row& names) {
    constexpr std::size_t kShown = 6;
    std::string text;
    for (std::size_t i = 0; i < names.size() && i < kShown; ++i)
        text += fmt::format("{}\"{}\"", text.empty() ? "" : ", ", printable(names[i]));
    return names.size() > kShown ? text + " and more" : text;
}

}  // namespace

Table Table::read(const std::filesystem::path& file, LastLine last) {
    std::optional<std::string> content = fileContent(file);
    if (!content) refuseLine(file.string(), 0, readFault(file), "give a folder that vkdose wrote, or a CSV");
    std::istringstream stream(*std::move(content));
    Table table;
    table.file_ = file.string();
    for (CsvLines lines(stream); lines.next();) {
        if (last == LastLine::Growing && !lines.ended()) break;
        if (last == LastLine::Whole && lines.text().starts_with('#')) continue;
        if (last == LastLine::Whole && table.names_.empty())
            table.semicolons_ = lines.text().find(';') != std::string::npos;
        const std::optional<Row> fields = csvFields(lines.text(), table.semicolons_ ? ';' : ',');
        if (!fields)
            refuseLine(table.file_, lines.number(), "is not CSV",
                       "separate the fields by commas, quote those that hold quotes");
        if (table.names_.empty()) {
            table.names_ = *fields;
            continue;
        }
        if (fields->size() != table.names_.size())
            refuseLine(table.file_, lines.number(),
                       fmt::format("has {} fields, the header {}", fields->size(), table.names_.size()),
                       fields->size() > table.names_.size() && !table.semicolons_
                           ? "give one field for each column, and write decimals with a point"
                           : "give one field for each column");
        table.rows_.push_back({*fields, lines.number()});
    }
    if (table.names_.empty()) refuseLine(table.file_, 0, "is empty", "begin with a header");
    return table;
}

Table Table::salvage(const std::filesystem::path& file) {
    std::istringstream stream(fileContent(file).value_or(""));
    Table table;
    table.file_ = file.string();
    for (CsvLines lines(stream); lines.next() && lines.ended();) {
        std::optional<Row> fields = lines.fields();
        if (fields && table.names_.empty())
            table.names_ = std::move(*fields);
        else if (fields && fields->size() == table.names_.size())
            table.rows_.push_back({std::move(*fields), lines.number()});
    }
    return table;
}

bool Table::has(std::string_view name) const {
    return std::find(names_.begin(), names_.end(), name) != names_.end();
}

std::size_t Table::place(std::string_view name) const {
    const auto found = std::find(names_.begin(), names_.end(), name);
    if (found == names_.end())
        refuseLine(file_, 1, fmt::format("lacks the column {}; it has {}", name, firstOf(names_)),
                   "give it, or a table that has it");
    return static_cast<std::size_t>(found - names_.begin());
}

const std::string& Table::text(std::size_t row, std::string_view name) const {
    return rows_.at(row).fields[place(name)];
}

double Table::number(std::size_t row, std::string_view name) const {
    const std::string& field = text(row, name);
    const double value = numberIn(semicolons_ ? withPoint(field) : field);
    if (std::isnan(value) && !field.empty() && field != "nan" && field != "-nan")
        refuse(row, name, "is not a number", "give a plain number");
    return value;
}

std::vector<double> Table::column(std::string_view name) const {
    (void)place(name);  // a table without rows lacks it too
    std::vector<double> values;
    for (std::size_t i = 0; i < rows(); ++i) values.push_back(number(i, name));
    return values;
}

void Table::refuse(std::size_t row, std::string_view name, std::string problem, std::string remedy) const {
    throw CaseError(
        {{file_, rows_.at(row).number, std::string(name), text(row, name), std::move(problem), std::move(remedy)}});
}

void Table::removeIf(const std::function<bool(const Row&)>& condition) {
    std::erase_if(rows_, [&](const Line& line) { return condition(line.fields); });
}

void Table::sort(const std::function<bool(const Row&, const Row&)>& less) {
    std::stable_sort(rows_.begin(), rows_.end(),
                     [&](const Line& a, const Line& b) { return less(a.fields, b.fields); });
}

}  // namespace vkdose
