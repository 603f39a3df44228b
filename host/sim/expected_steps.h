#pragma once
// How long a run will be, from how it went so far.

#include <cstdint>

#include "host/sim/runner.h"

namespace vkdose {

/// Steps of the whole run if the doses go on as those in `soFar` (before the first: as the closed form says); 0 when
/// nothing can be said.
std::uint64_t expectedSteps(const Case& c, const Timeline& timeline, const RunResult& soFar);

}  // namespace vkdose
