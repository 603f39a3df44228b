#include "host/analysis/figures.h"

#include <algorithm>

#include "host/analysis/emptying.h"

namespace vkdose {

namespace {

/// The mass of a dose by which the rule for a blockage goes [kg], or 0 where nothing tells it. A dose to a mass turns
/// until the mass is out. The closed form of its turns is the greater the longer that took, and is no measure of what
/// should come.
double expectedDose(const std::vector<Dose>& doses) {
    if (doses.empty()) return 0;
    const Dose& first = doses.front();
    const bool known = first.closedForm > 0;  // not where the device has no closed form
    if (first.target > 0) return known ? std::min(first.closedForm, first.target) : first.target;
    return known ? first.closedForm : 0;
}

}  // namespace

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
    f.rule = blockageRule(stop, expectedDose(doses));
    f.blocked = blockedAt(doses, supply, f.rule);
    return f;
}

}  // namespace vkdose
