#pragma once
// What the warnings about bodies have in common.

#include <fmt/format.h>

#include <cmath>

#include "host/advice/rules.h"
#include "host/core/millimetres.h"

namespace vkdose {

inline std::string keyOf(std::size_t body, const char* key) {
    return fmt::format("body[{}].{}", body, key);
}

/// The turn of a body that the drive turns while powder is dosed; null for every other.
inline const geometry::Turn* drivenTurn(const Subject& s, const RigidBody& body) {
    if (s.c.schedule.rotateTime == 0 || body.clock != Clock::Drive) return nullptr;
    return std::get_if<geometry::Turn>(&body.course.motion);
}

/// Whether it turns about an axis along that of the canister.
inline bool alongCanister(const geometry::Turn& turn) {
    return std::abs(turn.axis.z) > 0.999;
}

/// How deep a place is behind a wall of the canister; negative: so far before it. NaN where there is none: above, and
/// beyond the front wall, which has a hole [m].
inline double behindWall(const Canister& can, const Vec3& x) {
    if (x.z > can.length || x.y > can.height - can.width / 2) return std::nan("");
    const double half = can.width / 2, aside = std::abs(x.x) - half;
    const double below = can.flatFloor ? std::max(aside, -half - x.y) : x.y < 0 ? std::hypot(x.x, x.y) - half : aside;
    return std::max(below, -x.z);
}

}  // namespace vkdose
