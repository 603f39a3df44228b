#include "host/analysis/settled_figures.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vkdose {

Spread spreadOf(std::vector<double> values) {
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    if (values.empty()) return {kNone, kNone, kNone};
    std::sort(values.begin(), values.end());
    const auto at = [&](double share) {
        const double place = share * static_cast<double>(values.size() - 1);
        const auto below = static_cast<std::size_t>(place), above = std::min(below + 1, values.size() - 1);
        return values[below] + (place - std::floor(place)) * (values[above] - values[below]);
    };
    return {at(0.1), at(0.5), at(0.9)};
}

SettledFigures settledFigures(const Case& c, const SettledBed& bed) {
    SettledFigures f;
    f.pairs = bed.overlap.size();
    const auto active = std::count(bed.particles.status.begin(), bed.particles.status.end(), Status::Active);
    f.coordination = 2.0 * static_cast<double>(f.pairs) / static_cast<double>(active);
    f.pullOff = spreadOf(bed.pullOff);
    f.overlap = spreadOf(bed.overlap);
    f.largestOverlap = spreadOf(bed.largestOverlap);
    const geometry::Coil* coil = c.world.coil ? &*c.world.coil : nullptr;
    if (c.canister) f.bulk = bedDensity(c.world, bed.particles, *c.canister, coil, bed.bodies);
    return f;
}

}  // namespace vkdose
