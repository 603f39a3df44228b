#include "host/backend/reference/sliding.h"

namespace vkdose::reference {

Vec3 intoTangentPlane(const Vec3& spring, const Vec3& n) {
    const Vec3 tangent = spring - n * glm::dot(n, spring);
    const double size = glm::length(tangent);
    return size > 0 ? tangent * (glm::length(spring) / size) : Vec3(0);
}

Vec3 frictionForce(const FrictionElement& element, double bearing, const Vec3& n, const Vec3& v, double dt,
                   Vec3& spring, bool* slips) {
    if (slips) *slips = false;
    if (element.friction <= 0) {
        spring = Vec3(0);
        return Vec3(0);
    }
    spring = intoTangentPlane(spring, n) + v * dt;
    const Vec3 trial = -element.stiffness * spring - element.viscosity * v;
    const double size = glm::length(trial);
    const double limit = element.friction * bearing;
    if (size <= limit) return trial;  // sticks

    if (slips) *slips = true;
    const Vec3 force = trial * (limit / size);
    spring = element.stiffness > 0 ? -(force + element.slipViscosity() * v) / element.stiffness : Vec3(0);
    return force;
}

}  // namespace vkdose::reference
