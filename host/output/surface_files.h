#pragma once
// The walls and the coil as VTKHDF files of triangles, to stand beside the frames of a run.

#include <string>

#include "host/model/case.h"
#include "host/sim/frame.h"

namespace vkdose {

/// The walls. Those of a canister are as high as the canister; other boundaries reach as far as the domain. Empty if
/// there are no walls.
std::string wallsFile(const Case& c);

/// The coil as it has turned in this frame.
std::string coilFile(const Frame& frame, const geometry::Coil& coil);

}  // namespace vkdose
