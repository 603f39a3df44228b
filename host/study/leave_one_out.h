#pragma once
// How honest a surrogate is about itself: each observation against what all others predict of it.
// Source: Bastos and O'Hagan, "Diagnostics for Gaussian process emulators", Technometrics 51 (2009) 425-438.

#include <cstddef>
#include <limits>
#include <vector>

#include "host/study/gaussian_process.h"

namespace vkdose {

struct LeaveOneOut {
    static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    std::size_t points = 0;
    double error = kNone;         ///< root mean square of observed less predicted, in the unit of the figure
    double standardised = kNone;  ///< the same of the errors over their predicted deviations [-]; 1 if these are true
    double largest = kNone;       ///< of the standardised errors, by amount [-]
    /// 1 - sum (observed - predicted)^2 / sum (observed - mean)^2 [-]; NaN if all observations are equal. 1: the others
    /// tell each point. 0 or less: their mean would tell it as well.
    double predictiveR2 = kNone;

    enum class Verdict {
        Honest,         ///< none of the following
        Overconfident,  ///< the errors are more than twice what is predicted of them
        Cautious,       ///< they are less than half of it
        Blind           ///< the surrogate predicts less than half of the variance
    };
    Verdict verdict() const;
};

LeaveOneOut leaveOneOut(const std::vector<LeftOut>& observations);

}  // namespace vkdose
