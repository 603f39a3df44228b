#pragma once
// How much a figure scatters from seed to seed.

#include <vector>

namespace vkdose {

/// Standard deviation of a value about the mean of its point, pooled over all points. Each point is a list of the
/// values of its seeds; those that are not finite are left out. NaN if no point has two values. Two or three seeds of
/// one point say next to nothing about their scatter. Those of all points together do, if the scatter is much the same
/// everywhere.
double scatterOfSeeds(const std::vector<std::vector<double>>& points);

}  // namespace vkdose
