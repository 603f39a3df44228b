#pragma once
// Sliding friction: spring, dashpot and Coulomb slider in the tangent plane (physics.md, "Tangential").
// Rolling resistance uses the same element.

#include "host/core/vec.h"

namespace vkdose::reference {

struct FrictionElement {
    double stiffness;  ///< [N/m]
    double viscosity;  ///< [kg/s]
    double friction;   ///< mu [-]; 0 switches the element off
};

/// The spring turned into the plane normal to `n`, at its old length.
Vec3 intoTangentPlane(const Vec3& spring, const Vec3& n);

/// Force that resists the tangential velocity `v` [N], at most friction * `bearing` (F_C [N]). `spring` [m] is turned
/// into the plane normal to `n`, advanced by v dt and, where the slider slips, set to what the slider bears. `slips`
/// tells whether it does.
Vec3 frictionForce(const FrictionElement& element, double bearing, const Vec3& n, const Vec3& v, double dt,
                   Vec3& spring, bool* slips = nullptr);

}  // namespace vkdose::reference
