#pragma once
// What a region has counted.

#include <cstdint>

#include "host/core/columns.h"

namespace vkdose {

/// What has come into a region, since the start of the run or of a dose.
struct RegionCount {
    double mass = 0;  ///< [kg]
    std::uint64_t particles = 0;
};

/// The columns of timeseries.csv and doses.csv for each region, behind all others. The name of the region and a dot
/// stand before each.
inline constexpr auto kRegionColumns =
    columns(column<&RegionCount::mass>(
                "mass_kg", "kg", "Mass that has come into the region: since the start of the run, or of the dose."),
            column<&RegionCount::particles>("count", "1", "Number of particles of that mass."));

}  // namespace vkdose
