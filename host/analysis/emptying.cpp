#include "host/analysis/emptying.h"

#include "host/sim/ledger.h"
#include "host/sim/stop_rule.h"

namespace vkdose {

std::optional<int> dosesToFraction(std::span<const double> cumulative, double filled, double fraction) {
    for (std::size_t i = 0; i < cumulative.size(); ++i)
        if (cumulative[i] >= fraction * filled) return static_cast<int>(i) + 1;
    return std::nullopt;
}

std::optional<int> dosesToRule(std::span<const double> dosed, double filled, const StopRule& rule) {
    StopRule massOnly = rule;
    massOnly.maxDoses = std::numeric_limits<int>::max();
    DoseJudge judge(massOnly);
    for (std::size_t i = 0; i < dosed.size(); ++i) {
        const bool some = !(dosed[i] <= kLedgerTolerance * filled);
        if (judge.over(dosed[i], some ? 1 : 0, 1)) return static_cast<int>(i) + 1;
    }
    return std::nullopt;
}

}  // namespace vkdose
