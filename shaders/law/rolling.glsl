// Rolling resistance: kinematics of rolling at a contact; the force element is sliding's.
#ifndef VKDOSE_LAW_ROLLING_GLSL
#define VKDOSE_LAW_ROLLING_GLSL

#include "shared/layout.h"

/// Lever a_r [m] from the reduced radius 2 a_i a_j/(a_i + a_j), or half of it (Luding's own): kLeverFull, kLeverHalf.
float rollingLever(float reduced, uint choice) { return choice == kLeverFull ? reduced : 0.5 * reduced; }

/// Rolling velocity -a_r n x (omega_i - omega_j) [m/s].
vec3 rollingVelocity(float lever, vec3 n, vec3 relativeSpin) { return -lever * cross(n, relativeSpin); }

#endif
