#include "host/core/csv_lines.h"

#include <csv.h>

#include <algorithm>
#include <charconv>
#include <limits>

namespace vkdose {

namespace {

std::optional<double> readNumber(std::string_view text) {
    double value = 0;
    const auto [stop, code] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (code != std::errc() || stop != text.data() + text.size()) return std::nullopt;
    return value;
}

/// Whether a spreadsheet would take this text in a cell for a formula, perhaps behind some apostrophes. A number with a
/// sign is not a formula.
bool isFormula(std::string_view field) {
    field.remove_prefix(std::min(field.find_first_not_of('\''), field.size()));
    return !field.empty() && std::string_view("=+-@\t").find(field.front()) != std::string_view::npos &&
           !readNumber(field);
}

}  // namespace

std::string csvLine(const Row& fields) {
    std::string line;
    for (std::size_t i = 0; i < fields.size(); ++i) {
        std::string field = (isFormula(fields[i]) ? "'" : "") + fields[i];
        for (char& c : field)
            if (c == '\n' || c == '\r') c = ' ';
        const bool edged = !field.empty() && (field.front() == ' ' || field.back() == ' ' || field.front() == '\t' ||
                                              field.back() == '\t');
        if (edged || field.find_first_of(",\"") != std::string::npos) {
            std::string quoted = "\"";
            for (const char c : field) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
            field = quoted + '"';
        }
        line += (i == 0 ? "" : ",") + field;
    }
    return line;
}

std::optional<Row> csvFields(std::string_view line, char separator) {
    csv_parser parser{};
    csv_init(&parser, CSV_STRICT | CSV_STRICT_FINI);
    csv_set_delim(&parser, static_cast<unsigned char>(separator));
    Row fields;
    const auto onField = [](void* text, std::size_t size, void* out) {
        std::string_view field(static_cast<const char*>(text), size);
        if (!field.empty() && field.front() == '\'' && isFormula(field)) field.remove_prefix(1);
        static_cast<Row*>(out)->emplace_back(field);
    };
    const auto onRow = [](int, void*) {};
    const bool good = csv_parse(&parser, line.data(), line.size(), onField, onRow, &fields) == line.size() &&
                      csv_fini(&parser, onField, onRow, &fields) == 0;
    csv_free(&parser);
    if (!good) return std::nullopt;
    return fields;
}

bool CsvLines::next() {
    while (std::getline(stream_, text_)) {
        ended_ = !stream_.eof();
        // Spreadsheets put a byte order mark before the header.
        if (++number_ == 1 && text_.starts_with("\xef\xbb\xbf")) text_.erase(0, 3);
        if (!text_.empty() && text_.back() == '\r') text_.pop_back();
        if (text_.find_first_not_of(" \t") != std::string::npos) return true;
    }
    return false;
}

double numberIn(const std::string& text) {
    return readNumber(text).value_or(std::numeric_limits<double>::quiet_NaN());
}

}  // namespace vkdose
