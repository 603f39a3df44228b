#pragma once
// Sliding friction: spring, dashpot and Coulomb slider in the tangent plane (physics.md, "Tangential").
// Rolling resistance uses the same element.

#include "host/core/vec.h"

namespace vkdose::reference {

struct FrictionElement {
    double stiffness = 0;  ///< [N/m]
    double viscosity = 0;  ///< [kg/s]
    double friction = 0;   ///< mu [-]; 0 switches the element off
    /// What bears the limit while the slider slips: the spring alone, or spring and dashpot together.
    bool springAlone = false;
    double slipViscosity() const { return springAlone ? 0 : viscosity; }
};

/// The spring turned into the plane normal to `n`. It keeps its length.
Vec3 intoTangentPlane(const Vec3& spring, const Vec3& n);

/// Force that resists the tangential velocity `v` [N], at most friction * `bearing` (F_C [N]). `spring` [m] is turned
/// into the plane normal to `n` and advanced by v dt. If the slider slips, the spring is set so that what bears the
/// limit exerts this largest force. `slips` tells whether the slider slips.
Vec3 frictionForce(const FrictionElement& element, double bearing, const Vec3& n, const Vec3& v, double dt,
                   Vec3& spring, bool* slips = nullptr);

}  // namespace vkdose::reference
