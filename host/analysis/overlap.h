#pragma once
// How deep each particle is pressed in, from the positions alone.

#include <vector>

#include "host/model/particles.h"
#include "host/model/world.h"

namespace vkdose {

/// For each particle the deepest of its overlaps at this instant [-]. An overlap with another particle is divided by
/// the smaller radius of the two; one with a surface, a body (at `time` [s], in phases or freely as `moved` tells) or
/// the coil (turned by `coilAngle` about +z [rad]) by the particle's own. 0 if the particle touches nothing, is dosed
/// or lost.
std::vector<double> overlapRatios(const Particles& particles, const World& world, double coilAngle, double time = 0,
                                  const std::vector<Moved>& moved = {});

}  // namespace vkdose
