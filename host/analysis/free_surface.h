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

/// The height that stands for the width: the mean over it, or its highest point, as seen from the side.
enum class Across { Mean, Highest };

/// Over a spot of the floor plan the surface is the highest point of any sphere above it that is neither dosed nor
/// lost. Powder in flight counts; the coil does not. Where there is no powder the surface is the floor, and for Highest
/// the floor's lowest point. The surface is taken on a lattice of an eighth of a column or finer. Across the part of
/// the canister's width within the strip, its mean or its highest point counts. The profile is the mean of these over
/// each column. Throws std::invalid_argument without columns, or with a strip beside the canister.
SurfaceProfile surfaceProfile(const Particles& particles, const Canister& canister, std::size_t columns, Across width,
                              const Strip& strip = {});

}  // namespace vkdose
