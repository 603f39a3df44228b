#pragma once
// The search of a design: which points are the best compromises between what is wished of several figures.
// Source: Knowles, ParEGO (IEEE Transactions on Evolutionary Computation 10, 2006): each step weighs the wishes anew
// and goes where the weighted one is expected to gain most; Schonlau, Welch & Jones (1998): times the probability that
// the bounds are kept.

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "host/study/sampled_points.h"

namespace vkdose {

/// A point that was run again with new seeds, because its first runs laid it on the front.
struct FrontPoint {
    enum class Verdict {
        OnFront,      ///< it keeps the bounds, and no other such point is at least as good in all wishes
        Dominated,    ///< another one is
        OutOfBounds,  ///< the mean of a figure is beyond a bound
        Incomplete,   ///< some of the runs do not have all figures
    };
    std::size_t point = 0;          ///< its index among those that were tried
    std::vector<Measured> figures;  ///< of each goal: mean and standard error over the new seeds alone; NaN without
    Verdict verdict = Verdict::Incomplete;
};

struct FrontResult {
    std::vector<Parameters> points;             ///< all that were tried, in order
    std::vector<std::vector<Measured>> values;  ///< of each goal, of each point, by the first runs
    std::vector<FrontPoint> front;              ///< those that were confirmed, along the first wish
};

/// At most so many points of the front are confirmed, spread along it.
inline constexpr std::size_t kMostOnFront = 8;

/// Tries points, `aim.maxRuns` at most, and confirms those that are on the front then. The search is repeatable: the
/// same results lead to the same points. Returns nothing if it was interrupted. Throws RunError if fewer than two of
/// the first points have all figures.
std::optional<FrontResult> searchFront(const CalibrationAim& aim, const TryPoints& tryPoints,
                                       const ConfirmPoint& confirmPoint);

/// "on the front", "dominated", "out of bounds", "incomplete".
std::string verdictText(FrontPoint::Verdict verdict);

}  // namespace vkdose
