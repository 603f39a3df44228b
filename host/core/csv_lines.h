#pragma once
// The lines of a CSV and their fields: the only place that takes them apart or puts them together.

#include <istream>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace vkdose {

using Row = std::vector<std::string>;

/// One line, without its end: fields in quotes where they need them. A line break in a field becomes a blank: a row
/// stays on a line. A text that a spreadsheet would compute (it begins with = + - @ or a tab, and is no number) gets an
/// apostrophe in front, as is the custom.
std::string csvLine(const Row& fields);

/// Takes a line apart; nothing if it is not CSV (a stray quote). Blanks around a field without quotes do not count, nor
/// does the apostrophe that keeps a text from being a formula.
std::optional<Row> csvFields(std::string_view line);

/// Goes through a CSV line by line, so that every fault has its line.
class CsvLines {
  public:
    explicit CsvLines(std::istream& stream) : stream_(stream) {}

    /// On to the next line that is not blank; false if there is none.
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
