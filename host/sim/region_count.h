#pragma once
// What is told of a region.

#include <cstdint>
#include <tuple>

#include "host/core/columns.h"

namespace vkdose {

struct RegionCount {
    double mass = 0;  ///< [kg]
    std::uint64_t particles = 0;
};

/// Of a region at a sample.
struct RegionSample {
    RegionCount came;     ///< into it since the start of the run
    RegionCount content;  ///< of it now; dosed powder stays in the region that deleted it
    double most = 0;      ///< the largest content of all samples so far [kg]
};

/// The columns of doses.csv for each region, behind all others. The name of the region and a dot stand before each.
inline constexpr auto kRegionColumns =
    columns(column<&RegionCount::mass>(
                "mass_kg", "kg", "Mass that has come into the region: since the start of the run, or of the dose."),
            column<&RegionCount::particles>("count", "1", "Number of particles of that mass."));

inline constexpr auto kContentColumns = columns(
    column<&RegionCount::mass>("content_kg", "kg",
                               "Mass in the region at the time; dosed powder stays in the region that deleted it."),
    column<&RegionCount::particles>("content_count", "1", "Number of particles of that mass."));

/// The columns of timeseries.csv for each region, likewise.
inline constexpr auto kRegionSampleColumns =
    std::tuple_cat(within<&RegionSample::came>(kRegionColumns), within<&RegionSample::content>(kContentColumns));

}  // namespace vkdose
