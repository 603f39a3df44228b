#include "host/verify/finding.h"

#include <cmath>
#include <limits>

#include "host/core/worse.h"

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

double worstShare(const std::vector<Check>& checks) {
    double worst = 0;
    for (const Check& check : checks) {
        const double error = check.error();
        worst = worse(worst, error == 0 ? 0 : error / check.tolerance.share);  // an exact figure may be allowed nothing
    }
    return worst;
}

}  // namespace vkdose::verify
