#pragma once
// Torsion friction: spring, dashpot and slider about the normal (physics.md, "Torsion"). A scalar is enough: seen from
// the other particle normal and spin difference both change sign.

#include "host/backend/reference/sliding.h"
#include "host/core/vec.h"

namespace vkdose::reference {

/// Twisting velocity a_r n . (omega_i - omega_j) [m/s].
double torsionVelocity(double lever, const Vec3& n, const Vec3& spin);

/// Pseudo force that resists the twisting velocity `v` [N], at most friction * `bearing` (F_C [N]); lever * force * n
/// is the torque on i. `spring` [m] is advanced by v dt and, where the slider slips, set to what the slider bears.
/// `slips` tells whether it does.
double torsionForce(const FrictionElement& element, double bearing, double v, double dt, double& spring,
                    bool* slips = nullptr);

}  // namespace vkdose::reference
