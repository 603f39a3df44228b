#include "host/analysis/work.h"

#include <algorithm>
#include <cmath>
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
        const double turned = std::abs(angle[i] - angle[i - 1]);
        sum.turns += turned / (2 * kPi);
        sum.work += torque[i] * turned;
    }
    return sum;
}

}  // namespace vkdose
