#pragma once
// Runs with new seeds at the point that a calibration has chosen. Only they say whether a target is met. A point is
// chosen because its own runs came near the target, and some of that nearness is chance.

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "host/study/gaussian_process.h"
#include "host/study/seed_scatter.h"

namespace vkdose {

/// What the confirming runs gave of one figure, in its unit.
struct Confirmed {
    enum class Verdict {
        Met,        ///< the mean is off the target by no more than the tolerance, and its error is no larger either
        Missed,     ///< the mean is off by more
        Uncertain,  ///< the mean is near enough, but its error is larger than the tolerance, or not known
        Incomplete  ///< some of the runs do not have the figure
    };
    Measured found;        ///< mean over the runs that have the figure, and its standard error; NaN if not known
    std::size_t runs = 0;  ///< that have the figure
    Verdict verdict = Verdict::Incomplete;
};

/// Judges the confirming runs' `values` of one figure, of which there should be `asked`. Their standard error follows
/// from the scatter of single runs.
Confirmed confirmedBy(const std::vector<double>& values, std::size_t asked, const SeedScatter& scatter, double target,
                      double tolerance);

/// The confirmation of one point: a figure for each target.
struct Confirmation {
    std::size_t point = 0;  ///< index of the point among those that were tried
    std::vector<Confirmed> figures;
    bool met() const;  ///< every one of them
};

/// "met", "missed", "uncertain", "incomplete".
std::string verdictText(Confirmed::Verdict verdict);

/// The lowest whole numbers from 1 on that are not among `used`.
std::vector<std::uint64_t> newSeeds(const std::vector<std::uint64_t>& used, std::size_t count);

}  // namespace vkdose
