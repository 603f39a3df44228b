#include "host/study/csv_table.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <sstream>

namespace vkdose {

std::optional<std::size_t> CsvTable::column(std::string_view name) const {
    const auto found = std::find(header.begin(), header.end(), name);
    if (found == header.end()) return std::nullopt;
    return std::size_t(found - header.begin());
}

std::string CsvTable::text(const Row& row, std::string_view name) const {
    const auto at = column(name);
    return at && *at < row.size() ? row[*at] : "";
}

std::optional<double> CsvTable::number(const Row& row, std::string_view name) const {
    const std::string field = text(row, name);
    char* end = nullptr;
    const double value = std::strtod(field.c_str(), &end);
    if (field.empty() || *end != '\0') return std::nullopt;
    return value;
}

std::string csvLine(const Row& fields) {
    std::string line;
    for (std::size_t i = 0; i < fields.size(); ++i) {
        std::string field = fields[i];
        for (char& c : field)
            if (c == '\n' || c == '\r') c = ' ';
        if (field.find_first_of(",\"") != std::string::npos) {
            std::string quoted = "\"";
            for (const char c : field) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
            field = quoted + '"';
        }
        line += (i == 0 ? "" : ",") + field;
    }
    return line;
}

Row csvFields(std::string_view line) {
    Row fields(1);
    bool quoted = false;
    for (std::size_t i = 0; i < line.size(); ++i) {
        const char c = line[i];
        if (quoted && c == '"' && i + 1 < line.size() && line[i + 1] == '"') {
            fields.back() += '"';
            ++i;
        } else if (c == '"') {
            quoted = !quoted;
        } else if (c == ',' && !quoted) {
            fields.emplace_back();
        } else {
            fields.back() += c;
        }
    }
    return fields;
}

CsvTable readTable(const std::filesystem::path& file) {
    CsvTable table;
    std::ifstream stream(file, std::ios::binary);
    std::ostringstream all;
    all << stream.rdbuf();
    const std::string text = all.str();
    for (std::size_t start = 0, end = 0; (end = text.find('\n', start)) != std::string::npos; start = end + 1) {
        Row row = csvFields(std::string_view(text).substr(start, end - start));
        if (table.header.empty())
            table.header = std::move(row);
        else if (row.size() == table.header.size())
            table.rows.push_back(std::move(row));
    }
    return table;
}

}  // namespace vkdose
