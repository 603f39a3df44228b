#include "host/backend/reference/rolling.h"

namespace vkdose::reference {

double rollingLever(RollingLever choice, double reduced) {
    return choice == RollingLever::Full ? reduced : 0.5 * reduced;
}

Vec3 rollingVelocity(double lever, const Vec3& n, const Vec3& spin) {
    return -lever * glm::cross(n, spin);
}

Vec3 rollingTorque(double lever, const Vec3& n, const Vec3& force) {
    return lever * glm::cross(n, force);
}

}  // namespace vkdose::reference
