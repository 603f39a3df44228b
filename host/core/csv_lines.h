#pragma once
// The lines of a CSV and their fields. No other place takes them apart or puts them together.

#include <istream>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace vkdose {

using Row = std::vector<std::string>;

/// One line, without its line break. Fields that need quotes get them. A line break in a field becomes a blank, so that
/// a row stays on one line. A text that a spreadsheet would compute (it begins with = + - @ or a tab, and is no number)
/// gets an apostrophe in front, as is the custom.
std::string csvLine(const Row& fields);

/// Takes a line apart. Returns nothing if it is not CSV (a stray quote). Blanks around a field without quotes are
/// dropped, and so is the apostrophe that keeps a text from being a formula.
std::optional<Row> csvFields(std::string_view line, char separator = ',');

/// Reads a CSV line by line, so that a message about a fault can name its line.
class CsvLines {
  public:
    explicit CsvLines(std::istream& stream) : stream_(stream) {}

    /// On to the next line that is not blank; false at the end.
    bool next();

    int number() const { return number_; }             ///< of the line, from 1
    const std::string& text() const { return text_; }  ///< as it stands, without its end and a byte order mark
    bool ended() const { return ended_; }              ///< by a line break
    std::optional<Row> fields() const { return csvFields(text_); }

  private:
    std::istream& stream_;
    int number_ = 0;
    std::string text_;
    bool ended_ = false;
};

/// The whole of `text` as a number; NaN if it is none, or says nan.
double numberIn(const std::string& text);

}  // namespace vkdose
