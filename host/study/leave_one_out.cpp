#include "host/study/leave_one_out.h"

#include <algorithm>
#include <cmath>

namespace vkdose {

namespace {

// Of 14 honest errors the root mean square is above 1.5 once in a thousand times. Errors of points that share
// neighbours are not independent, hence the factor of two.
constexpr double kMuchMore = 2, kMuchLess = 0.5;
constexpr double kLeastR2 = 0.5;

}  // namespace

LeaveOneOut leaveOneOut(const std::vector<LeftOut>& observations) {
    const double n = double(observations.size());
    double mean = 0, errors = 0, standardised = 0, spread = 0;
    for (const LeftOut& o : observations) mean += o.observed / n;
    LeaveOneOut all;
    all.points = observations.size();
    all.largest = 0;
    for (const LeftOut& o : observations) {
        errors += std::pow(o.observed - o.predicted.mean, 2);
        standardised += std::pow(o.standardised(), 2);
        spread += std::pow(o.observed - mean, 2);
        all.largest = std::max(all.largest, std::abs(o.standardised()));
    }
    all.error = std::sqrt(errors / n);
    all.standardised = std::sqrt(standardised / n);
    if (spread > 0) all.predictiveR2 = 1 - errors / spread;
    return all;
}

LeaveOneOut::Verdict LeaveOneOut::verdict() const {
    if (!(standardised <= kMuchMore)) return Verdict::Overconfident;
    if (!(predictiveR2 >= kLeastR2)) return Verdict::Blind;
    return standardised < kMuchLess ? Verdict::Cautious : Verdict::Honest;
}

}  // namespace vkdose
