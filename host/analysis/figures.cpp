#include "host/analysis/figures.h"

#include "host/analysis/emptying.h"

namespace vkdose {

DosingFigures figuresOf(const std::vector<Dose>& doses, double filled, const StopRule& stop) {
    DosingFigures f;
    // A canister of less than 19 g saturates within the paper's 15 g.
    f.window = windowOf(filled);
    const std::vector<double> cumulative = cumulativeMasses(doses);
    f.beta = betaOf(cumulative, f.window);
    f.dosesTo99 = dosesToFraction(cumulative, filled);
    const double before = doses.empty() ? 0.0 : doses.front().cumulative - doses.front().mass;
    f.rule = blockageRule(stop, doses.empty() ? 0.0 : doses.front().closedForm);
    f.blocked = blockedAt(cumulative, filled, f.rule, before);
    return f;
}

}  // namespace vkdose
