#pragma once
// The walls, the coil and the bodies as VTKHDF files of triangles, to stand beside the frames of a run. Where there are
// bodies, each triangle tells whose it is in `body`: 0 for walls, 1 for the first of World::bodies and so on.

#include <string>

#include "host/model/case.h"
#include "host/sim/frame.h"

namespace vkdose {

/// The walls and the bodies that never move. Those of a canister are as high as the canister; other boundaries, and
/// bodies without an end, reach as far as the domain. Empty if there are none.
std::string wallsFile(const Case& c);

/// The coil as it has turned in this frame.
std::string coilFile(const Frame& frame, const geometry::Coil& coil);

/// Whether some body moves.
bool bodiesMove(const World& world);
/// The bodies that move, in their place in this frame.
std::string bodiesFile(const Frame& frame, const World& world);

}  // namespace vkdose
