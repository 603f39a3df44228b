#pragma once
// The walls and the coil as VTKHDF files of triangles, to stand beside the frames of a run.

#include <string>

#include "host/model/case.h"
#include "host/sim/frame.h"

namespace vkdose {

/// The walls: of a canister as high as it is, of other boundaries as far as the domain reaches. Empty if there are
/// none.
std::string wallsFile(const Case& c);

/// The coil as it has turned in this frame.
std::string coilFile(const Frame& frame, const geometry::Coil& coil);

}  // namespace vkdose
