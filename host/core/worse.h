#pragma once
// The worst of several errors.

#include <algorithm>
#include <cmath>
#include <limits>

namespace vkdose {

/// The larger of two errors. NaN counts as infinitely large, because std::max would drop it.
inline double worse(double a, double b) {
    return std::isnan(a) || std::isnan(b) ? std::numeric_limits<double>::infinity() : std::max(a, b);
}

}  // namespace vkdose
