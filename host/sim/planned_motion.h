#pragma once
// How the device will move, before anything runs.

#include <vector>

#include "host/sim/frame.h"

namespace vkdose {

/// The device as the schedule moves it, in frames without powder: through the first dose, or through the settling of a
/// case without doses, but no longer than ten seconds. Bodies that the powder moves rest. None if there is no such
/// time.
std::vector<Frame> plannedMotion(const Case& c);

}  // namespace vkdose
