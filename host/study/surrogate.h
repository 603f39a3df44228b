#pragma once
// The search of a calibration. It makes a few runs spread out over the ranges. Then it runs one point after the other
// where a Gaussian process through all results expects the largest improvement.

#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "host/study/calibration_aim.h"
#include "host/study/gaussian_process.h"

namespace vkdose {

using Parameters = std::vector<double>;  ///< a value for each free parameter, in the units of their keys

/// The masses per dose that runs at one point gave.
struct Trial {
    std::vector<double> values;  ///< mass per dose, one for each seed; seeds without one are left out [kg]
    double error = 0;            ///< standard error of a single seed's value [kg]; NaN if it is not known
};

/// Tries a few points. Returns nothing if the search was interrupted.
using TryPoints = std::function<std::optional<std::vector<Trial>>(const std::vector<Parameters>&)>;

struct SearchResult {
    std::vector<Parameters> points;  ///< all points that were tried, in order
    /// Their masses per dose, mean over the seeds [kg], NaN where there is none. The errors are the scatter from seed
    /// to seed, pooled over all points, or with a single seed the trial's own; NaN if neither is known.
    std::vector<Measured> values;
    std::size_t best = 0;  ///< index of the point whose mass is believed nearest to the target
    double mean = 0;       ///< mass per dose that is believed there [kg]
    double deviation = 0;  ///< standard deviation of this belief [kg]
    bool met = false;      ///< both the distance to the target and the deviation are within the tolerance
    /// For each parameter the range of its values that may meet the target. A value may meet it if, for some values of
    /// the others, the mean is within two deviations and the tolerance of the target. If two parameters compensate each
    /// other, their ranges are wide.
    std::vector<std::pair<double, double>> compatible;
};

/// Looks for the point at which `tryPoints` gives the target. Ends when the target is met, when `aim.maxRuns` points
/// have been tried or when there is nothing to gain. The search is repeatable: the same results lead to the same
/// points. Returns nothing if it was interrupted. Throws RunError if fewer than two of the first points have a mass per
/// dose.
std::optional<SearchResult> search(const CalibrationAim& aim, const TryPoints& tryPoints);

/// Expected improvement on `best`, the least distance to the target so far, by a value that is believed to be `mean` +-
/// `deviation` from the target: the mean of max(0, best - |y|) over a normal distribution, in closed form.
double expectedImprovement(double mean, double deviation, double best);

}  // namespace vkdose
