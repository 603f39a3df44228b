#include "host/analysis/work.h"

#include <algorithm>
#include <cstddef>
#include <limits>

#include "host/core/vec.h"

namespace vkdose {

double DriveWork::massPerTurn(double mass) const {
    return turns > 0 ? mass / turns : std::numeric_limits<double>::quiet_NaN();
}

double DriveWork::massPerJoule(double mass) const {
    return work > 0 ? mass / work : std::numeric_limits<double>::quiet_NaN();
}

DriveWork driveWork(std::span<const double> angle, std::span<const double> torque) {
    DriveWork sum;
    for (std::size_t i = 1; i < std::min(angle.size(), torque.size()); ++i) {
        sum.turns += (angle[i] - angle[i - 1]) / (2 * kPi);
        sum.work += torque[i] * (angle[i] - angle[i - 1]);
    }
    return sum;
}

}  // namespace vkdose
