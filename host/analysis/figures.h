#pragma once
// The figures by which the paper judges a run, from its doses.

#include <optional>
#include <vector>

#include "host/analysis/beta.h"
#include "host/analysis/blockage.h"

namespace vkdose {

struct DosingFigures {
    Slope beta;                    ///< over the window below
    Window window;                 ///< cumulative mass below 15 g and below 80 % of the fill, see beta.h
    std::optional<int> dosesTo99;  ///< see emptying.h
    BlockageRule rule;             ///< by which a dose is next to nothing, see blockage.h
    std::optional<int> blocked;    ///< see blockage.h
};

/// From the complete ones of `doses`; `filled` is what the canister held [kg], `stop` the run's rule, by which a dose
/// counts as nothing.
DosingFigures figuresOf(const std::vector<Dose>& doses, double filled, const StopRule& stop);

}  // namespace vkdose
