#pragma once
// Measures as people write them, with their units: "80x30x100mm", "48g", "60/90/130um".

#include <string>
#include <string_view>
#include <vector>

namespace vkdose {

/// A kind of measure: its units, and the bounds within which one can be meant.
enum class Measure { Length, Mass, Density, Speed, Time, WallTime };

/// The numbers of `text` in SI (speeds in rad/s), one or several, separated by `separator`. A unit stands behind each
/// number, or behind the last for all. Blanks do not count. Throws UsageError that begins with `name` ("--coil") and
/// ends with `example` if the text is no such measure, has no unit, or is beyond what can be meant.
std::vector<double> measuresOf(Measure kind, const std::string& name, const std::string& text, char separator,
                               const std::string& example);

/// The same for a single one.
double measureOf(Measure kind, const std::string& name, const std::string& text, const std::string& example);

/// A whole number of at least 1, at most `most`.
int countOf(const std::string& name, const std::string& text, int most, const std::string& example);

/// The measure as a person would write it: "30 mm", "0.35 mm", "2.4 kg". Three digits.
std::string lengthText(double metres);
std::string massText(double kilograms);

/// Three digits or so, written as TOML and people read it: "0.0125", "1200".
std::string figureText(double value, int digits = 3);

/// The nearest number, or the next one above or below, that has so many digits.
double rounded(double value, int digits);
double roundedUp(double value, int digits);
double roundedDown(double value, int digits);

}  // namespace vkdose
