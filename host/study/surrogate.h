#pragma once
// The search of a calibration for one figure or several at once. It makes a few runs spread out over the ranges. Then
// it runs one point after the other where Gaussian processes through all results expect the largest improvement.

#include <functional>
#include <optional>
#include <vector>

#include "host/study/calibration_aim.h"
#include "host/study/confirmation.h"
#include "host/study/leave_one_out.h"
#include "host/study/posterior.h"
#include "host/study/sampled_points.h"

namespace vkdose {

/// The goals of a calibration: its targets, or its mass per dose [kg].
std::vector<Goal> goalsOf(const CalibrationAim& aim);

/// What became of one goal, in the unit of its figure.
struct GoalResult {
    std::vector<Measured> values;  ///< of each point, as SampledPoints has them; confirmations are included
    double mean = 0;               ///< that is believed at the best point
    double deviation = 0;          ///< standard deviation of this belief
    LeaveOneOut leaveOneOut;       ///< of its process
    /// For each parameter the change that is believed from one bound to the other, by the slope at the best point, over
    /// the tolerance. The goal constrains the parameters for which this is large.
    std::vector<double> sensitivity;
};

struct SearchResult {
    std::vector<Parameters> points;  ///< all points that were tried, in order
    std::vector<GoalResult> goals;
    std::size_t best = 0;  ///< index of the confirmed point; without one, of that with the least believed misfit
    double misfit = 0;     ///< there: sum over the goals of weight (distance / tolerance)^2
    bool met = false;      ///< the last confirmation says that the best point meets every goal
    std::vector<Confirmation> confirmations;  ///< in order, each of another point
    Processes processes;                      ///< through all that was tried, one for each goal: for the posterior
};

/// Looks for the point at which `tryPoints` gives the targets. A tried point is believed to meet them when of every
/// goal both the distance to the target and the deviation are within the tolerance. Then `confirmPoint` runs it with
/// new seeds. If these do not meet the targets, what they gave is taken into the belief, and the search goes on at
/// other points. It ends when a point is confirmed, when `aim.maxRuns` points and confirmations have been made or when
/// there is nothing to gain. A point that is believed to meet the targets at the end is confirmed all the same. The
/// search is repeatable: the same results lead to the same points. Returns nothing if it was interrupted. Throws
/// RunError if fewer than two of the first points have all figures.
std::optional<SearchResult> search(const CalibrationAim& aim, const TryPoints& tryPoints,
                                   const ConfirmPoint& confirmPoint);

/// The points with which a search begins, whatever they give.
std::vector<Parameters> firstPoints(const CalibrationAim& aim);

/// Expected improvement on `best`, the least distance to the target so far, by a value that is believed to be `mean` +-
/// `deviation` from the target: the mean of max(0, best - |y|) over a normal distribution, in closed form.
double expectedImprovement(double mean, double deviation, double best);

/// The same of several figures: the mean of max(0, best - sqrt(sum y_i^2)). It is a mean over a fixed set of points of
/// the normal distribution, so that the same beliefs give the same figure; good to a few percent.
double expectedImprovement(const std::vector<Belief>& beliefs, double best);

}  // namespace vkdose
