#pragma once
// A sample of a distribution over the unit cube whose density is known but for a factor.
// Source: Ching and Chen, "Transitional Markov chain Monte Carlo method for Bayesian model updating, model class
// selection, and model averaging", J. Eng. Mech. 133 (2007) 816-832; Del Moral, Doucet and Jasra, "Sequential Monte
// Carlo samplers", J. R. Stat. Soc. B 68 (2006) 411-436.
//
// Several populations of points do the same apart. Each begins spread evenly over the cube, where it is a sample of
// density^0. Then the exponent rises to 1 in steps. Each step is so long that the weights density^(step) leave half of
// the points effective. The points are drawn anew by their weights. Then each makes some Metropolis moves, whose
// covariance is that of the whole population. So the moves have the shape of the distribution, however narrow a ridge
// it is. Since the points come from all over the cube, several separate regions all keep their share.

#include <cstddef>
#include <functional>
#include <vector>

namespace vkdose {

struct SampleSize {
    std::size_t populations = 8, each = 256;
};

struct TemperedSample {
    std::vector<std::vector<double>> points;  ///< of the first population, then of the second, ...
    int steps = 0;                            ///< of the exponent; the most that a population made
    double acceptance = 0;                    ///< part of the moves at the end that were made [-]
    /// For each coordinate how well the populations agree: R-hat, sqrt((n - 1) / n + B / W), with n points each, B the
    /// variance of the populations' means and W the mean of their variances (Gelman and Rubin 1992). 1 if they are
    /// samples of one distribution.
    std::vector<double> rHat;
    /// For each coordinate the number of independent points whose mean would scatter as that of all does: the number of
    /// populations times W / B, no more than there are points (Gelman et al., Bayesian Data Analysis, section 11.5).
    std::vector<double> effective;
};

/// `logDensity` takes a point of the cube. The same call gives the same points. Takes at least two populations of at
/// least two points, and 1 to kMostTargets dimensions. Throws RunError where the density is not finite.
TemperedSample temperedSample(const std::function<double(const std::vector<double>&)>& logDensity,
                              std::size_t dimensions, const SampleSize& size = {});

}  // namespace vkdose
