#pragma once
// The paper's beta: mass per dose as the slope of the cumulative dosed mass over the number of doses.

#include <limits>
#include <span>
#include <vector>

#include "host/sim/runner.h"

namespace vkdose {

/// Doses over which the slope is taken: from ... to, as long as the cumulative mass stays below a bound. The default is
/// the paper's for its simulations: "less than 15 grams" (section on parametric studies).
struct Window {
    double cumulativeBelow = 0.015;  ///< [kg]
    int from = 1;                    ///< first dose, counted from 1
    int to = std::numeric_limits<int>::max();
};

/// For experiments the paper takes the slope "before saturation" without saying where that is. Here it means:
/// before 80 % of `filled` [kg] is out.
Window beforeSaturation(double filled);

/// The doses over which a run's slope is taken: less than 15 g, and before saturation.
Window windowOf(double filled);

struct Slope {
    double beta = std::numeric_limits<double>::quiet_NaN();           ///< [kg/dose]; NaN for fewer than two doses
    double standardError = std::numeric_limits<double>::quiet_NaN();  ///< [kg/dose]; NaN for fewer than three
    int doses = 0;                                                    ///< in the window
};

/// Least-squares slope of the points (n, cumulativeMass[n - 1]) in the window; masses in kg after dose 1, 2, ...
///
/// The slope is a weighted mean of the doses between the first and the last point: sum c_j m_j with c_j >= 0 and
/// sum c_j = 1. Its standard error is s sqrt(sum c_j^2), with s the sample standard deviation of these doses. (The
/// usual error of a regression takes the points as independent; cumulative masses carry every earlier dose along, and
/// it would come out too small.)
Slope betaOf(std::span<const double> cumulativeMass, const Window& window = {});

/// Cumulative masses after the complete doses of a run [kg]. They include the powder dosed while settling.
std::vector<double> cumulativeMasses(const std::vector<Dose>& doses);

/// Mean over seeds [the unit of the values] and its standard error s/sqrt(n); values that are not finite are left out.
struct Estimate {
    double mean = std::numeric_limits<double>::quiet_NaN();
    double standardError = std::numeric_limits<double>::quiet_NaN();  ///< NaN for fewer than two values
    int count = 0;
};
Estimate estimateOf(std::span<const double> values);

}  // namespace vkdose
