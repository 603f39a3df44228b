#pragma once
// The figures by which the paper judges a run, from its doses.

#include <optional>
#include <vector>

#include "host/analysis/beta.h"
#include "host/analysis/blockage.h"
#include "host/sim/runner.h"

namespace vkdose {

struct DosingFigures {
    Slope beta;                    ///< over the window below
    Window window;                 ///< cumulative mass below 15 g and below 80 % of the fill, see beta.h
    std::optional<int> dosesTo99;  ///< see emptying.h
    BlockageRule rule;             ///< by which a dose is next to nothing, see blockage.h
    std::optional<int> blocked;    ///< see blockage.h
};

/// What a run was given, with its refills.
Supply supplyOf(const RunResult& result);

/// From the complete ones of `doses`; `stop` is the run's rule, by which a dose counts as nothing.
DosingFigures figuresOf(const std::vector<Dose>& doses, const Supply& supply, const StopRule& stop);

}  // namespace vkdose
