#pragma once
// Masses as people read them.

#include <string>

namespace vkdose {

/// A mass in grams without the unit: "3.702"; below a tenth of a gram three significant digits, because doses can be
/// milligrams.
std::string grams(double kilograms);

/// The same with its sign: "+0.021", "-0.000441".
std::string signedGrams(double kilograms);

}  // namespace vkdose
