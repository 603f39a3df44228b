#pragma once
// The fixed surfaces as triangles, for pictures only. No computation uses them.

#include <vector>

#include "geometry/coil_mesh.h"
#include "geometry/surface.h"

namespace vkdose::geometry {

/// The parts of the surfaces inside the box from `low` to `high` [m] and, if one of them is a trough, inside the
/// trough. A throat reaches out of the box by its length. A tube of finite length is shown whole. Round surfaces get
/// `around` corners to a turn, which lie on the surface. The orientation of a triangle is unspecified.
std::vector<Triangle> surfaceMesh(const std::vector<Surface>& surfaces, const Vec3& low, const Vec3& high,
                                  int around = 96);

}  // namespace vkdose::geometry
