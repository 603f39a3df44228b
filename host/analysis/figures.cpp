#include "host/analysis/figures.h"

#include "host/analysis/emptying.h"

namespace vkdose {

Supply supplyOf(const RunResult& result) {
    Supply supply = result.ledger.filledMass();
    for (const AddedPowder& p : result.added) supply.refills.push_back({p.time, p.mass});
    return supply;
}

DosingFigures figuresOf(const std::vector<Dose>& doses, const Supply& supply, const StopRule& stop) {
    DosingFigures f;
    // A canister of less than 19 g saturates within the paper's 15 g.
    f.window = windowOf(supply.mass);
    const std::vector<double> cumulative = cumulativeMasses(doses);
    f.beta = betaOf(cumulative, f.window);
    f.dosesTo99 = dosesToFraction(cumulative, supply.mass);
    f.rule = blockageRule(stop, doses.empty() ? 0.0 : doses.front().closedForm);
    f.blocked = blockedAt(doses, supply, f.rule);
    return f;
}

}  // namespace vkdose
