#pragma once
// The coil as triangles, for other programs that take walls only as meshes. vkdose itself does not compute with it.

#include <vector>

#include "geometry/coil.h"
#include "geometry/mesh_file.h"

namespace vkdose::geometry {

/// The wire as a closed tube with flat ends: rings of `around` >= 3 corners on its surface, `perTurn` rings to a turn.
/// 8 turns of 20 rings with 8 corners make 2572 triangles.
std::vector<Triangle> coilMesh(const Coil& coil, int around, int perTurn);

}  // namespace vkdose::geometry
