#pragma once
// Surfaces that coincide, or nearly so, where a sphere can be: a sphere there would have two contacts with what is one
// wall, and so twice the stiffness, damping, friction and adhesion.

#include <cstddef>
#include <optional>
#include <vector>

#include "geometry/surface.h"

namespace vkdose::geometry {

struct Coincidence {
    std::size_t first, second;  ///< indices of the surfaces
    Vec3 centre;                ///< of a sphere that touches both in the same place [m]
};

/// Looks for two of `surfaces` that a sphere of `radius` [m] with its centre in the box from `low` to `high` [m]
/// touches from the same side, their normals within 2.5 degrees and their distances within a fiftieth of the radius,
/// while no other surface is in its way. A wall that ends at a front wall and that front wall are no such pair: there a
/// backend counts one contact (jointContact).
std::optional<Coincidence> findCoincidence(const std::vector<Surface>& surfaces, double radius, const Vec3& low,
                                           const Vec3& high);

}  // namespace vkdose::geometry
