#include "host/analysis/closed_form.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "host/analysis/figures.h"
#include "host/analysis/settled_figures.h"
#include "host/core/grams.h"
#include "host/sim/density.h"

namespace vkdose {

namespace {

constexpr double kOtherDensity = 1.25;  // a bed so much denser, or looser, than the closed form takes it is a reason
constexpr double kTelling = 0.25;       // a throat with this part of the missing mass is a reason

double massIn(const RunResult& r, Region region) {
    return r.last.sensors.mass[static_cast<std::size_t>(region)];
}

/// "the settled bed has 610 kg/m3, the closed form 471" if that is a reason for doses of more, or of less; or empty.
std::string densityReason(const Case& c, const RunResult& r, bool more) {
    if (!r.settled) return "";
    const auto bulk = settledFigures(c, *r.settled).bulk;
    if (!bulk) return "";
    const double taken = c.world.coil ? closedFormDensity(r.derived, *c.world.coil) : c.bulkDensity;
    const double ratio = more ? bulk->density / taken : taken / bulk->density;
    if (!(ratio > kOtherDensity)) return "";
    return fmt::format("the settled bed has {:.3g} kg/m3, the closed form {:.3g}", bulk->density, taken);
}

std::vector<std::string> reasonsForLess(const Case& c, const RunResult& r, const ClosedFormComparison& beside) {
    const char* carrier = c.world.coil ? "coil" : "body";
    std::vector<std::string> reasons;
    const double throat = massIn(r, Region::Throat), left = massIn(r, Region::Canister);
    if (throat > kTelling * beside.doses * (beside.closedForm - beside.mean))
        reasons.push_back(fmt::format("filling the throat took up to {} g", grams(throat)));
    if (left < beside.closedForm)
        reasons.push_back(fmt::format("the canister runs empty, {} g are left in it", grams(left)));
    reasons.push_back(
        fmt::format("powder turns with the {0}, or passes it by (friction of {0} and wall, clearance)", carrier));
    const auto blocked = figuresOf(r.doses, supplyOf(r), c.schedule.stop).blocked;
    reasons.push_back(blocked ? fmt::format("the outlet is blocked from dose {} on", *blocked)
                              : fmt::format("an arch keeps powder off the {}", carrier));
    return reasons;
}

std::vector<std::string> reasonsForMore(const Case& c, const RunResult& r) {
    std::vector<std::string> reasons;
    const std::string itself = "powder runs out by itself (throat too short, outlet too high, little friction)";
    // In a run with the powder of another this is what had come out there, in its doses too.
    reasons.push_back(r.dosedWhileSettling > 0 ? fmt::format("{}, and {} g had left before the first dose", itself,
                                                             grams(r.dosedWhileSettling))
                                               : itself);
    reasons.push_back(fmt::format("powder above and beside the {} is dragged along", c.world.coil ? "coil" : "body"));
    return reasons;
}

}  // namespace

ClosedFormComparison besideClosedForm(const std::vector<Dose>& doses, double filled) {
    ClosedFormComparison sum;
    for (const Dose& d : doses) {
        const bool emptied = d.cumulative > 0.99 * filled;
        if (emptied && sum.doses > 0) break;
        if (!d.complete || !(d.closedForm > 0)) continue;
        ++sum.doses;
        sum.mean += d.mass;
        sum.closedForm += d.closedForm;
        if (emptied) break;
    }
    if (sum.doses == 0) return {};
    return {sum.doses, sum.mean / sum.doses, sum.closedForm / sum.doses};
}

std::string closedFormNote(const Case& c, const RunResult& r) {
    const ClosedFormComparison beside = besideClosedForm(r.doses, r.ledger.filledMass());
    if (!beside.isFar()) return "";
    const bool more = beside.mean > beside.closedForm;
    std::vector<std::string> reasons = more ? reasonsForMore(c, r) : reasonsForLess(c, r, beside);
    if (const std::string density = densityReason(c, r, more); !density.empty()) reasons.push_back(density);
    return fmt::format("{}, {} g, is {:.2g} times the {} g of the closed form; likely reasons: {}",
                       beside.doses == 1 ? "the dose" : fmt::format("the mean of {} doses", beside.doses),
                       grams(beside.mean), beside.mean / beside.closedForm, grams(beside.closedForm),
                       fmt::join(reasons, "; "));
}

}  // namespace vkdose
