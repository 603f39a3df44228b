#pragma once
// Finds surfaces that coincide, or nearly so, where a sphere can be. A sphere there would have two contacts with one
// and the same wall, and so twice the stiffness, damping, friction and adhesion.

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
/// touches from the same side. Their normals are within 2.5 degrees of each other, the distance of each from the
/// sphere's centre is within a fiftieth of the radius, and no other surface is in the sphere's way. A wall that ends at
/// a front wall does not form such a pair with it, because a backend counts only one contact there (jointContact).
std::optional<Coincidence> findCoincidence(const std::vector<Surface>& surfaces, double radius, const Vec3& low,
                                           const Vec3& high);

}  // namespace vkdose::geometry
