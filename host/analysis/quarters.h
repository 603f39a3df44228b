#pragma once
// The standard error of a figure that was taken from the four quarters of what was measured.

#include <cmath>
#include <vector>

namespace vkdose {

/// Standard error of the mean of independent values: their deviation over the root of their number. NaN of fewer than
/// two, or if one of them is not known.
inline double errorOfMean(const std::vector<double>& values) {
    const double count = static_cast<double>(values.size());
    if (values.size() < 2) return std::nan("");
    double mean = values.front(), squares = 0;  // of which rounding makes no error, if all are equal
    for (const double v : values) mean += (v - values.front()) / count;
    for (const double v : values) squares += (v - mean) * (v - mean);
    return std::sqrt(squares / (count - 1) / count);
}

}  // namespace vkdose
