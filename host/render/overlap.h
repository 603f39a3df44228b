#pragma once

#include <vector>

#include "host/model/particles.h"
#include "host/model/world.h"

namespace vkdose::render {

/// Of every particle the largest overlap with another, a surface or the coil, over the smaller radius of the two; 0 for
/// one that touches nothing or is out of the motion. `coilAngle` is the coil's rotation about +z since its start [rad].
std::vector<double> largestOverlaps(const World& world, const Particles& particles, double coilAngle);

}  // namespace vkdose::render
