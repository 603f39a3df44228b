#pragma once
// Numbers as text, whatever the locale of the process is: a program that uses this one as a library, or Python, may
// have set a decimal comma. No other function reads or writes a number (tests/layout). Numbers are written by fmt
// without its L, and by std::to_string if they are whole.

#include <optional>
#include <string>
#include <string_view>

namespace vkdose {

/// The number that the whole of `text` says, without blanks, plus sign or unit: "-1.5e-3", "nan", "inf". Nothing for
/// any other text, and for a number that a double cannot hold.
std::optional<double> numberOf(std::string_view text);

/// The same of a whole number without a sign.
std::optional<unsigned long long> wholeNumberOf(std::string_view text);

inline bool isDigit(char c) {
    return c >= '0' && c <= '9';
}

/// The number nearest to `value` with so many significant digits in decimal.
double nearestDecimal(double value, int digits);

}  // namespace vkdose
