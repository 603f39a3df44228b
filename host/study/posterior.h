#pragma once
// The parameters that fit the targets, as a distribution and not as one point. Before, every point within the bounds is
// as probable as any other. A target that was measured as y +- u, where its surrogate says f +- s at a point, has the
// likelihood of a normal distribution, exp(-(f - y)^2 / (2 (u^2 + s^2))) / sqrt(u^2 + s^2), and those of all targets
// are multiplied. So where the surrogate knows little, less is excluded.
// Source: Kennedy and O'Hagan, "Bayesian calibration of computer models", J. R. Stat. Soc. B 63 (2001) 425-464, without
// their term for what the model itself cannot do.

#include <cstddef>
#include <vector>

#include "host/study/calibration_aim.h"
#include "host/study/sampled_points.h"
#include "host/study/tempered_sample.h"

namespace vkdose {

/// A figure to be brought to its target, in its own unit.
struct Goal {
    double target = 0;
    double tolerance = 0;  ///< what a match may be off by; as the target's standard error
    double weight = 1;     ///< of its square in the misfit of a search; the likelihood has none
};

/// The middle of a distribution, and the ends of the part that holds 95 % of it with 2.5 % on each side.
struct Interval {
    double median = 0, low = 0, high = 0;
};

struct Posterior {
    std::vector<Parameters> draws;     ///< all of the same probability, in an order that says nothing
    std::vector<Interval> parameters;  ///< of each, in the unit of its key
    /// Pearson's correlation of each parameter with each [-]; 0 with one that does not vary.
    std::vector<std::vector<double>> correlation;
    /// What the surrogates say of each figure, over all draws: a mean, and a standard deviation with their own in it.
    std::vector<Belief> figures;
    std::size_t sampled = 0;  ///< points that all of this was computed from
    int steps = 0;            ///< these and the next as in TemperedSample
    double acceptance = 0;
    double rHat = 1;       ///< the largest of any parameter
    double effective = 0;  ///< the least of any parameter
};

/// Of the parameters of `aim`, by a process for each goal over the unit cube of their bounds. Keeps `draws` of the
/// points of the sample. The same call gives the same draws.
Posterior posteriorOf(const CalibrationAim& aim, const std::vector<Goal>& goals, const Processes& processes,
                      std::size_t draws = 200, const SampleSize& size = {});

/// What a surrogate says of its figure over points of the unit cube, by the law of total variance: the variance of the
/// means, and the mean of the surrogate's own.
Belief figureOver(const std::vector<UnitPoint>& points, const GaussianProcess& process);

/// Quantiles between the values are interpolated (Hyndman and Fan 1996, type 7).
Interval intervalOf(std::vector<double> values);

}  // namespace vkdose
