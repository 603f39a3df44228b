#pragma once
// Rolling resistance: its kinematics. The force element is the one of sliding (physics.md, "Rolling").

#include "host/core/vec.h"
#include "host/model/material.h"

namespace vkdose::reference {

/// Lever a_r [m] of a contact with `reduced` 2 a_i a_j / (a_i + a_j), wall: 2 a_i [m].
double rollingLever(RollingLever choice, double reduced);

/// Rolling velocity -a_r n x (omega_i - omega_j) [m/s]; `spin` is the difference [rad/s].
Vec3 rollingVelocity(double lever, const Vec3& n, const Vec3& spin);

/// Torque on i of the pseudo force that resists rolling [N m]. The opposite torque acts on j.
Vec3 rollingTorque(double lever, const Vec3& n, const Vec3& force);

}  // namespace vkdose::reference
