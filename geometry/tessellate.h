#pragma once
// Exact shapes as triangles. Corners lie on the shape, so the mesh differs from it by facet^2 / (8 radius of
// curvature).

#include "geometry/shape.h"

namespace vkdose::geometry {

/// The surface as triangles with sides of about `facet` [m] along curves, seen from outside, edge to edge. Flat faces
/// are not cut further. A shape without an end is cut off at the box from `low` to `high`. A mesh is given back as it
/// is. A flight is a solid with all its faces, without the shaft. Along their straight lines the wall of a cone and the
/// blade of a flight are cut like along curves, or not at all.
enum class StraightLines { Cut, Whole };
std::vector<Triangle> tessellated(const Shape& shape, double facet, const Vec3& low, const Vec3& high,
                                  StraightLines straight = StraightLines::Cut);

}  // namespace vkdose::geometry
