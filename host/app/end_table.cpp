#include "host/app/end_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "host/analysis/closed_form.h"
#include "host/analysis/figures.h"
#include "host/analysis/targets.h"
#include "host/app/text.h"
#include "host/sim/added_series.h"
#include "host/sim/density.h"

namespace vkdose {

namespace {

/// Of a device without a drive there is no torque.
std::string doseTable(const std::vector<Dose>& doses, bool driven) {
    std::string text = fmt::format("{:>5} {:>10} {:>14} {:>16} {:>15}\n", "dose", "mass [g]", "cumulative [g]",
                                   "torque [mN m]", "closed form [g]");
    for (const Dose& d : doses) {
        text += fmt::format("{:>5} {:>10} {:>14} {:>16} {:>15}{}\n", d.index, grams(d.mass), grams(d.cumulative),
                            driven ? fmt::format("{:.3f}", d.coilTorque * 1e3) : "none",
                            d.closedForm > 0 ? grams(d.closedForm) : "none",
                            d.complete ? "" : "  incomplete, not in the mean");
    }
    return text;
}

/// What stopped the coil, of doses that not only the time can stop.
std::string stopTable(const std::vector<Dose>& doses) {
    std::string text = fmt::format("{:>5} {:>10} {:>14} {:>16} {:>15}  stopped by\n", "dose", "target [g]",
                                   "at stop [g]", "overshoot [g]", "turned [s]");
    for (const Dose& d : doses)
        text += fmt::format("{:>5} {:>10} {:>14} {:>16} {:>15.3f}  {}\n", d.index, grams(d.target), grams(d.stopMass),
                            grams(d.overshoot()), d.rotation, cellText(d.stoppedBy, kAllDigits));
    return text;
}

std::string targetLine(const std::vector<Dose>& doses) {
    const TargetFigures f = targetFigures(doses);
    if (f.doses == 0) return "";
    return fmt::format(
        "target   {} g; {} of {} doses stopped by their mass, on average {} g from the target ({} g fell "
        "after the stop) in {:.3g} s\n",
        grams(f.target), f.byMass, f.doses, signedGrams(f.error), grams(f.overshoot), f.rotation);
}

/// The figures by which the paper judges a run; those that need more doses are left out.
std::string figureLines(const RunResult& r, const StopRule& stop) {
    const DosingFigures f = figuresOf(r.doses, supplyOf(r), stop);
    std::string text;
    if (f.beta.doses > 1) {
        text += fmt::format("beta     {} g/dose", grams(f.beta.beta));
        if (f.beta.doses > 2) text += fmt::format(" +- {}", grams(f.beta.standardError));
        text += fmt::format(", the slope over {} doses with less than {:.3g} g out\n", f.beta.doses,
                            f.window.cumulativeBelow * 1e3);
    }
    if (f.dosesTo99) text += fmt::format("emptied  99 % of the fill is out after dose {}\n", *f.dosesTo99);
    if (f.blocked)
        text += fmt::format(
            "blocked  {} doses from dose {} on gave no more than {:.3g} g together, though powder is left\n",
            f.rule.doses, *f.blocked, f.rule.threshold * 1e3);
    return text;
}

/// The bulk density of the closed form, where the case lets the run measure it.
std::string densityLine(const Case& c, const RunResult& r) {
    if (!c.bulkDensityMeasured || !c.world.coil) return "";
    const double density = closedFormDensity(r.derived, *c.world.coil);
    return fmt::format("density  {:.4g} kg/m3 in the closed form, {}\n", density,
                       wasMeasured(c, density)
                           ? "measured in the settled bed"
                           : "assumed: the bed has not settled, or is too small to measure its density");
}

std::string ledgerLine(const Case& c, const RunResult& r) {
    const Sensors& s = r.last.sensors;
    const auto entry = [&s](Region region) {
        const auto i = static_cast<std::size_t>(region);
        return fmt::format("{} g ({})", grams(s.mass[i]), s.count[i]);
    };
    // A device that is made of bodies has neither a canister nor a throat.
    const std::string inside =
        c.canister ? fmt::format("canister {} + throat {}", entry(Region::Canister), entry(Region::Throat))
                   : fmt::format("inside {}", entry(Region::Canister));
    const bool closed = r.ledger.closings() > 0 && r.reason != StopReason::RunError;
    return fmt::format(
        "ledger   {} + dosed {} + lost {} = filled {} g ({}): {}\n", inside, entry(Region::Dosed), entry(Region::Lost),
        grams(r.ledger.filledMass()), r.ledger.filledCount(),
        closed ? fmt::format("closed {} times, worst error {:.1e}", r.ledger.closings(), r.ledger.worstMassError())
               : std::string("as of the last sample"));
}

std::string closedFormLine(const Case& c, const RunResult& r) {
    const std::string note = closedFormNote(c, r);
    return note.empty() ? "" : fmt::format("note     {}\n", note);
}

/// Always shown: a deep overlap is a result to distrust, not a detail.
std::string overlapLine(const RunResult& r) {
    std::string text = fmt::format("overlap  at most {:.3g} of the smaller radius, at t = {:.4g} s", r.maxOverlapRatio,
                                   r.maxOverlapTime);
    if (r.maxOverlapRatio > kMaxOverlapRatio)
        text += fmt::format("; beyond {} (a particle that a body pinches) the contact law is extrapolated",
                            kMaxOverlapRatio);
    return text + "\n";
}

/// Shares are relative to the work of coil and bodies if they did any, else to the losses.
std::string energyLine(const EnergyLedger& ledger) {
    const EnergyBook& b = ledger.sum;
    const double work = b.coilWork + b.bodyWork;
    const double whole = work != 0 ? work : ledger.losses();
    const std::string bodies = b.bodyWork != 0 ? fmt::format(" + body work {:.4g} mJ", b.bodyWork * 1e3) : "";
    const auto share = [whole](double x) { return whole != 0 ? 100 * x / whole : 0.0; };
    return fmt::format(
        "energy   coil work {:.4g} mJ{} + loaded {:.4g} mJ = present {:.4g} + left {:.4g} + plastic {:.4g} + adhesive "
        "{:.4g} + viscous {:.4g} + sliding {:.4g} + rolling {:.4g} + torsion {:.4g} + numerical {:.4g} ({:.2g} %) + "
        "residual {:.2g} ({:.2g} % of the {})\n",
        b.coilWork * 1e3, bodies, b.loaded * 1e3, ledger.present() * 1e3, b.left * 1e3, b.plastic * 1e3,
        b.adhesive * 1e3, b.viscous * 1e3, b.sliding * 1e3, b.rolling * 1e3, b.torsion * 1e3, b.numerical * 1e3,
        share(b.numerical), ledger.residual() * 1e3, share(ledger.residual()),
        work == 0         ? "losses"
        : b.bodyWork == 0 ? "coil's work"
                          : "work");
}

}  // namespace

std::string reportText(const Case& c, const RunResult& r, const std::string& backend) {
    std::string text;
    if (!r.doses.empty()) text += doseTable(r.doses, c.world.coil || followsDrive(c.world.bodies));
    const bool controlled = c.schedule.targetMass > 0 || std::isfinite(c.schedule.maxTorque);
    if (controlled && !r.doses.empty()) text += stopTable(r.doses);
    const DoseStatistics& s = r.statistics;
    if (s.doses > 1) {
        const std::string rsd =
            s.mean > 0 ? fmt::format("RSD {:.1f} %", s.relative * 100) : "no RSD: nothing was dosed";
        text += fmt::format("mean {} g, standard deviation {} g, {} over {} doses\n", grams(s.mean), grams(s.deviation),
                            rsd, s.doses);
    } else if (s.doses == 1) {
        text += fmt::format("mean {} g (one dose: no standard deviation, no RSD)\n", grams(s.mean));
    }
    text += targetLine(r.doses);
    for (const AddedSeries& a : seriesOf(r.added)) text += fmt::format("refill   {}: {}\n", a.name(), a.text());
    if (r.settling) text += fmt::format("settled  {}\n", settlingSentence(*r.settling, c));
    text += densityLine(c, r) + closedFormLine(c, r);
    text += figureLines(r, c.schedule.stop) + ledgerLine(c, r);
    if (r.last.energy) text += energyLine(*r.last.energy);
    text += overlapLine(r);
    text += fmt::format("stopped  {} at t = {:.4g} s\n", stopSentence(r.reason, c.schedule.stop), r.last.time);
    text += fmt::format("speed    {}particle-steps/s ({}particle-steps in {}) on {}\n",
                        large(r.particleStepsPerSecond()), large(r.particleSteps), duration(r.wallTime), backend);
    return text;
}

namespace {

/// Whether a run is that of a feeder: it made one dose, or doses without a closed form.
bool feeds(const RunResult& r) {
    const auto hasForm = [](const Dose& d) { return d.closedForm > 0; };
    return r.doses.size() <= 1 || std::none_of(r.doses.begin(), r.doses.end(), hasForm);
}

std::string scatter(const SeriesFigures& f) {
    return std::isfinite(f.relative) ? ", " + rsdText(f) : std::string();
}

}  // namespace

std::string cycleLine(const RunResult& r, const Cycles& cycles) {
    if (!feeds(r) || cycles.list.size() < kFewestWindows) return "";
    std::string text = fmt::format("cycle    {}{} over {} cycles, each a {}", cycleText(cycles.all, "+-"),
                                   scatter(cycles.all), cycles.list.size(), cycles.what);
    if (cycles.steady)
        text += fmt::format("; steady from t = {:.4g} s: {}{}", cycles.steadyTime(), cycleText(cycles.steadyPart, "+-"),
                            scatter(cycles.steadyPart));
    return text + "\n";
}

std::string rateLine(const RunResult& r, const MassRate& rate) {
    if (!feeds(r) || rate.windows.size() < kFewestWindows) return "";
    std::string text = fmt::format("rate     {}{} over {} windows of {:.3g} s", rateText(rate.all, "+-"),
                                   scatter(rate.all), rate.windows.size(), rate.window);
    if (comesInPortions(rate))
        text += "; the powder comes in portions, so that no rate is steady";
    else if (rate.steady)
        text += fmt::format("; steady from t = {:.4g} s: {}{}", rate.steadyTime(), rateText(rate.steadyPart, "+-"),
                            scatter(rate.steadyPart));
    return text + "\n";
}

}  // namespace vkdose
