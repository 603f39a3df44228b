#pragma once
// How deep each particle is pressed, from where everything stands.

#include <vector>

#include "host/model/particles.h"
#include "host/model/world.h"

namespace vkdose {

/// For each particle the deepest of its overlaps at this instant [-]: with another particle over the smaller radius of
/// the two, with a surface or the coil (turned by `coilAngle` about +z [rad]) over its own. 0 if it touches nothing, is
/// dosed or lost.
std::vector<double> overlapRatios(const Particles& particles, const World& world, double coilAngle);

}  // namespace vkdose
