#pragma once
// Figures of the settled bed: how strongly its contacts hold, how deep they are, how densely it lies.

#include <optional>
#include <vector>

#include "host/sim/density.h"
#include "host/sim/settled_bed.h"

namespace vkdose {

/// Three points of a distribution: 10 % and half of the values are no more than `low` and `median`, 90 % no more than
/// `high`. NaN if there are no values.
struct Spread {
    double low, median, high;
};

/// Between two values the points are interpolated (the first value is at 0 %, the last at 100 %).
Spread spreadOf(std::vector<double> values);

struct SettledFigures {
    std::size_t pairs = 0;            ///< of particles in contact
    double coordination = 0;          ///< mean number of spheres that touch one; NaN without particles
    Spread pullOff{};                 ///< over the lighter sphere's weight
    Spread overlap{};                 ///< over the smaller radius
    Spread largestOverlap{};          ///< the contact's largest so far
    std::optional<BulkDensity> bulk;  ///< bedDensity (density.h); in a canister only
};

SettledFigures settledFigures(const Case& c, const SettledBed& bed);

}  // namespace vkdose
