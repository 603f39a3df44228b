#include "host/backend/reference/torsion.h"

#include <cmath>

namespace vkdose::reference {

double torsionVelocity(double lever, const Vec3& n, const Vec3& spin) {
    return lever * glm::dot(n, spin);
}

double torsionForce(const FrictionElement& element, double bearing, double v, double dt, double& spring, bool* slips) {
    if (slips) *slips = false;
    if (element.friction <= 0) {
        spring = 0;
        return 0;
    }
    spring += v * dt;
    const double trial = -element.stiffness * spring - element.viscosity * v;
    const double limit = element.friction * bearing;
    if (std::abs(trial) <= limit) return trial;  // sticks

    if (slips) *slips = true;
    const double force = std::copysign(limit, trial);
    spring = element.stiffness > 0 ? -(force + element.slipViscosity() * v) / element.stiffness : 0;
    return force;
}

}  // namespace vkdose::reference
