#pragma once
// Torsion friction: spring, dashpot and slider about the normal (physics.md, "Torsion"). A scalar is enough, because
// the normal and the spin difference both change sign when the two particles are exchanged.

#include "host/backend/reference/sliding.h"
#include "host/core/vec.h"

namespace vkdose::reference {

/// Twisting velocity a_r n . (omega_i - omega_j) [m/s].
double torsionVelocity(double lever, const Vec3& n, const Vec3& spin);

/// Pseudo force that resists the twisting velocity `v` [N], at most friction * `bearing` (F_C [N]). The torque on i is
/// lever * force * n. `spring` [m] is advanced by v dt. If the slider slips, the spring is set so that what bears
/// the limit exerts this largest force. `slips` tells whether the slider slips.
double torsionForce(const FrictionElement& element, double bearing, double v, double dt, double& spring,
                    bool* slips = nullptr);

}  // namespace vkdose::reference
