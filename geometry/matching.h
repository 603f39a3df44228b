#pragma once
// Which contact of the last step does a contact continue? A sphere that rolls from one triangle to the next, over an
// edge or a corner, or with a body that moves, keeps the history of its contact.

#include <cstddef>
#include <limits>
#include <vector>

#include "host/core/vec.h"

namespace vkdose::geometry {

inline constexpr std::size_t kNew = std::numeric_limits<std::size_t>::max();

/// For each of the directions `now` the index of the one of `before` that it continues, or kNew. All are unit vectors
/// in the frame of the body. The nearest pairs come first, ties by the index now, then by that before; a pair is within
/// 45 degrees, and each direction is in one pair at most.
std::vector<std::size_t> continued(const std::vector<Vec3>& before, const std::vector<Vec3>& now);

/// The vector turned as the unit vector `from` must be to become `to`, on the shortest way. A spring so keeps its
/// length and its place in the tangent plane. `from` and `to` must not be opposite.
Vec3 turnedAlong(const Vec3& vector, const Vec3& from, const Vec3& to);

}  // namespace vkdose::geometry
