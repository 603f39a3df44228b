#pragma once
// The surface of the powder as it looks from the side.

#include <limits>
#include <vector>

#include "host/model/case.h"

namespace vkdose {

/// Heights in columns along the canister's axis, all of one length, from the rear wall to the front wall.
struct SurfaceProfile {
    std::vector<double> z;       ///< middles of the columns [m]
    std::vector<double> height;  ///< above the lowest point of the floor [m]
};

/// A strip of the canister along its axis, from one x to another [m].
struct Strip {
    double from = -std::numeric_limits<double>::infinity();
    double to = std::numeric_limits<double>::infinity();
};

/// Over a spot of the floor plan the surface is the highest point of any sphere above it that is neither dosed nor
/// lost, or the floor if there is none (powder in flight counts; the coil is no powder). The profile is its mean over
/// each column and over the part of the canister's width within the strip, taken on a lattice of an eighth of a column
/// or finer. Throws std::invalid_argument without columns, or with a strip beside the canister.
SurfaceProfile surfaceProfile(const Particles& particles, const Canister& canister, std::size_t columns,
                              const Strip& strip = {});

}  // namespace vkdose
