#pragma once
// The fixed surfaces as triangles, to be looked at. Nothing computes with them.

#include <vector>

#include "geometry/coil_mesh.h"
#include "geometry/surface.h"

namespace vkdose::geometry {

/// The surfaces as far as they lie in the box from `low` to `high` [m], and, if one of them is a trough, in it. A
/// throat reaches out of the box by its length; a tube of finite length is whole. Round ones have `around` corners to a
/// turn, which lie on them. Which way a triangle faces means nothing.
std::vector<Triangle> surfaceMesh(const std::vector<Surface>& surfaces, const Vec3& low, const Vec3& high,
                                  int around = 96);

}  // namespace vkdose::geometry
