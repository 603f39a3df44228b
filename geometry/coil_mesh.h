#pragma once
// The coil as triangles, for other programs that take walls only as meshes. vkdose itself does not compute with it.

#include <array>
#include <string>
#include <vector>

#include "geometry/coil.h"

namespace vkdose::geometry {

using Triangle = std::array<Vec3, 3>;  ///< anticlockwise, seen from outside [m]

/// The wire as a closed tube with flat ends: rings of `around` >= 3 corners on its surface, `perTurn` rings to a turn.
/// 8 turns of 20 rings with 8 corners make 2572 triangles.
std::vector<Triangle> coilMesh(const Coil& coil, int around, int perTurn);

/// The triangles as text in the STL format.
std::string stlText(const std::vector<Triangle>& mesh);

}  // namespace vkdose::geometry
