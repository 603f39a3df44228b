#include "host/verify/finding.h"

#include <cmath>
#include <limits>

namespace vkdose::verify {

double Check::error() const {
    const double scale = tolerance.scale != 0 ? tolerance.scale : std::abs(expected);
    if (!std::isfinite(expected) || !std::isfinite(got) || !std::isfinite(scale) || !(scale > 0))
        return std::numeric_limits<double>::quiet_NaN();
    return std::abs(got - expected) / scale;
}

bool Check::passes() const {
    return std::isfinite(tolerance.share) && error() <= tolerance.share;
}

}  // namespace vkdose::verify
