#pragma once
// How much a figure scatters from seed to seed.

#include <limits>
#include <vector>

namespace vkdose {

/// Standard deviation of a single value about the mean of its point, as few values tell it.
struct SeedScatter {
    double deviation = std::numeric_limits<double>::quiet_NaN();  ///< in the unit of the values; NaN without freedom
    int freedom = 0;                                              ///< degrees of it: values less points

    /// Standard error of the mean of `count` values, widened for what is not known of the deviation itself: two such
    /// errors hold the truth as often as two errors of a normal distribution do (Student 1908). NaN without freedom.
    double errorOfMean(int count) const;
};

/// How many deviations off the mean a value of Student's distribution lies at most with this chance, below 1 [-]: 2.262
/// for 0.95 and 9 degrees of freedom.
double studentFactor(double chance, int freedom);

/// Pooled over all points. Each point is a list of the values of its seeds; those that are not finite are left out. Two
/// or three seeds of one point say next to nothing about their scatter. Those of all points together do, if the scatter
/// is much the same everywhere.
SeedScatter scatterOfSeeds(const std::vector<std::vector<double>>& points);

}  // namespace vkdose
