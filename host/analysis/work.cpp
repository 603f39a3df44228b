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
    double sense = 0;  // the coil's first turn conveys; a turn back against the powder is work as well
    for (std::size_t i = 1; i < std::min(angle.size(), torque.size()); ++i) {
        const double turned = angle[i] - angle[i - 1];
        if (sense == 0 && turned != 0) sense = turned > 0 ? 1 : -1;
        sum.turns += std::abs(turned) / (2 * kPi);
        sum.work += torque[i] * turned * sense;
    }
    return sum;
}

}  // namespace vkdose
