#include "host/report/run_figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "host/analysis/blockage.h"
#include "host/analysis/cycles.h"
#include "host/analysis/emptying.h"
#include "host/analysis/mass_rate.h"
#include "host/analysis/outlet.h"
#include "host/analysis/targets.h"
#include "host/analysis/work.h"
#include "host/core/grams.h"
#include "host/model/powders.h"
#include "host/output/figure_words.h"
#include "host/output/particle_row.h"
#include "host/sim/added_series.h"
#include "host/sim/density.h"

namespace vkdose::report {

namespace {

/// In the order of the case.
std::vector<AddedPowder> addedPowder(const RunSources& run) {
    std::vector<AddedPowder> list;
    if (!run.summary.is_object()) return list;
    const std::vector<Refill>& all = run.c.refills;
    const Json told = run.summary.value("refills", Json::array());
    for (std::size_t k = 0; k < std::min(all.size(), told.size()); ++k) {
        if (!told[k].value("time_s", Json()).is_number()) continue;
        list.push_back({k, all[k].name, all[k].table, refillsOfTable(all, all[k].table), 0,
                        told[k]["time_s"].get<double>(), 0, told[k].value("mass_kg", 0.0)});
    }
    return list;
}

class Facts {
  public:
    explicit Facts(const RunSources& run) : run_(run), filled_(filledMass(run)) {}

    Json list() {
        how();
        settling();
        measures();
        if (rateLeads(run_)) flow();
        masses();
        emptying();
        drive();
        if (!rateLeads(run_)) flow();
        outlet();
        stops();
        arches();
        settled();
        bed();
        return std::move(list_);
    }

  private:
    void add(const std::string& name, const std::string& value, const std::string& note = "") {
        list_.push_back({{"name", name}, {"value", value}, {"note", note}});
    }

    void flow() {
        rate();
        cycles();
    }

    void how() {
        const Json& s = run_.summary;
        add("fill", fmt::format("{} g", grams(filled_)), fmt::format("seed {}", run_.c.seed));
        if (!s.is_object()) {
            add("state", "still running, or ended without a summary", "the figures are those so far");
            return;
        }
        for (const AddedSeries& added : seriesOf(addedPowder(run_)))
            add(fmt::format("refill {}", added.name()), fmt::format("{} g", grams(added.mass)),
                added.when() + ", counted in the fill");
        if (s.contains("stop_sentence")) add("ended", s.value("stop_sentence", std::string()));
        if (s.contains("error") && s["error"].is_string()) add("error", s["error"].get<std::string>());
        if (s.contains("backend")) add("computed on", s.value("backend", std::string()));
    }

    /// How the settling ended, and the mass that fell out meanwhile.
    void settling() {
        if (!run_.summary.is_object() || !run_.summary.contains("settling")) return;
        const Json& s = run_.summary["settling"];
        for (const char* key : {"time_s", "speed_m_s", "fall_speed_m_s", "spilled_kg"})
            if (!s.is_object() || !s.value(key, Json()).is_number()) return;
        const double time = s["time_s"].get<double>(), speed = s["speed_m_s"].get<double>();
        const double fall = s["fall_speed_m_s"].get<double>(), spilled = s["spilled_kg"].get<double>();
        const bool rested = s.value("at_rest", Json(false)) == Json(true);
        const std::string still =
            fmt::format("{:.2g} % of the speed after a fall from the fill's top", fall > 0 ? 100 * speed / fall : 0.0);
        const std::string mover = rested ? "" : moverOf(run_.c, {0, rested, time, speed, fall, spilled});
        add("bed when settling ended",
            fmt::format("{} at t = {:.4g} s{}", rested ? "at rest" : "not at rest", time,
                        mover.empty() ? "" : ", as " + mover),
            s.value("until_rest", Json(false)) == Json(true) && !rested ? still + "; the longest time was over"
                                                                        : still);
        // With another run's powder this is what had come out there, in its doses too.
        const bool fromOther = run_.summary.contains("from");
        add(fromOther ? "left before this run's first dose" : "fallen out while settling",
            fmt::format("{} g", grams(spilled)), fromOther ? "in no dose of this run" : "in no dose");
    }

    void masses() {
        const DoseStatistics s = statistics(run_.doses);
        if (s.doses > 0) add("complete doses", fmt::format("{}", s.doses));
        if (s.doses > 1)
            add("mass per dose", fmt::format("{} g, standard deviation {} g", grams(s.mean), grams(s.deviation)),
                s.mean > 0 ? fmt::format("RSD {:.1f} %", s.relative * 100) : "no RSD: nothing was dosed");
        else if (s.doses == 1)
            add("mass per dose", fmt::format("{} g", grams(s.mean)), "one dose: no standard deviation");
        const TargetFigures t = targetFigures(run_.doses);
        if (t.doses > 0) {
            add("target of a dose", fmt::format("{} g, met to {} g", grams(t.target), signedGrams(t.error)),
                fmt::format("{} of {} doses stopped by their mass, in {:.3g} s", t.byMass, t.doses, t.rotation));
            add("overshoot after the stop", fmt::format("{} g", grams(t.overshoot)),
                fmt::format("{} g at the stop", grams(t.stopMass)));
        }
        const DosingFigures f = figuresOf(run_.doses, supplyOf(run_), run_.c.schedule.stop);
        if (f.beta.doses > 1) {
            const std::string error = f.beta.doses > 2 ? " ± " + grams(f.beta.standardError) : std::string();
            add("β", fmt::format("{}{} g/dose", grams(f.beta.beta), error),
                fmt::format("slope over {} doses with less than {:.3g} g out", f.beta.doses,
                            f.window.cumulativeBelow * 1e3));
        }
        const bool toMass = run_.c.schedule.targetMass > 0;
        const double closedForm = toMass ? t.closedForm : run_.doses.empty() ? 0.0 : run_.doses.front().closedForm;
        if (closedForm > 0)
            add("closed form", fmt::format("{} g/dose", grams(closedForm)),
                closedFormNote() + (toMass ? ", mean for the turns that the doses made" : ""));
        farFromClosedForm();
    }

    /// A run that goes on has no summary yet.
    std::string closedFormNote() const {
        double density = run_.c.bulkDensity;
        std::string is;
        if (run_.summary.is_object() && run_.summary.contains("closed_form")) {
            const Json& form = run_.summary["closed_form"];
            density = form.value("bulk_density_kg_m3", density);
            if (run_.c.bulkDensityMeasured) is = ", " + form.value("bulk_density_is", std::string("assumed"));
        }
        const char* form = run_.c.world.coil ? "ρ_b p π r_c² n_t" : "ρ_b times pitch and free section";
        return fmt::format("{} with ρ_b = {:.4g} kg/m³{}", form, density, is);
    }

    /// The note that the run ended with, if its doses are far from the closed form.
    void farFromClosedForm() {
        if (!run_.summary.is_object()) return;
        const Json form = run_.summary.value("closed_form", Json());
        if (form.is_object() && form.contains("note") && form["note"].is_string())
            add("far from the closed form", form["note"].get<std::string>());
    }

    void emptying() {
        std::vector<double> dosed;
        for (const Dose& d : run_.doses)
            if (d.complete) dosed.push_back(d.mass);
        if (dosed.empty()) return;
        const DosingFigures f = figuresOf(run_.doses, supplyOf(run_), run_.c.schedule.stop);
        const auto say = [&](const std::string& name, std::optional<int> dose, const std::string& note) {
            add(name, dose ? fmt::format("after dose {}", *dose) : "not reached", note);
        };
        say("99 % of the fill out", f.dosesTo99, "");
        StopRule rule;
        rule.threshold = f.rule.threshold;
        rule.doses = f.rule.doses;
        const std::string doses = fmt::format("{} dose{}", rule.doses, rule.doses == 1 ? "" : "s in a row");
        const std::string little = fmt::format("{} together give at most {:.3g} g", doses, rule.threshold * 1e3);
        if (run_.c.schedule.stop.kind != StopRule::Kind::None) {
            say("experiment's stop rule", dosesToRule(dosed, filled_, rule), little);
            rule.kind = StopRule::Kind::Simulation;
            say("simulation's stop rule", dosesToRule(dosed, filled_, rule), doses + " give nothing");
        }
        add("blocked", f.blocked ? fmt::format("from dose {} on", *f.blocked) : "no",
            little + ", with more than 1 % of the fill inside");
    }

    void drive() {
        const DriveWork w = driveWork(run_.series.column("coil_angle_rad"), run_.series.column("coil_torque_Nm"));
        if (!(w.turns > 0)) return;
        // The coil did nothing for what fell out while the powder settled.
        double spilled = 0;
        for (std::size_t i = 0; i < run_.series.rows() && run_.series.text(i, "phase") == "settle"; ++i)
            spilled = run_.series.number(i, "dosed_mass_kg");
        const double dosed = run_.series.number(run_.series.rows() - 1, "dosed_mass_kg") - spilled;
        add(run_.c.world.coil ? "mass per turn of the coil" : "mass per turn of the drive",
            fmt::format("{:.4g} g", w.massPerTurn(dosed) * 1e3), fmt::format("{:.4g} turns", w.turns));
        add("work of the drive", fmt::format("{:.4g} mJ", w.work * 1e3),
            w.work > 0 ? fmt::format("{:.4g} g/J", w.massPerJoule(dosed) * 1e3) : "");
    }

    static std::string scatter(const SeriesFigures& f) {
        return std::isfinite(f.relative) ? rsdText(f) : std::string("no RSD: nothing was dosed");
    }

    void rate() {
        const MassRate r = massRate(flowSamples(run_.series), windowRuleOf(run_.c));
        if (r.windows.size() < kFewestWindows) return;
        add("mass rate", rateText(r.all, "±"),
            fmt::format("{} over {} windows of {:.3g} s", scatter(r.all), r.windows.size(), r.window));
        if (comesInPortions(r))
            add("steady mass rate", "none", "the powder comes in portions");
        else if (r.steady)
            add("steady mass rate", rateText(r.steadyPart, "±"),
                fmt::format("{}, from t = {:.4g} s on by MSER-5", scatter(r.steadyPart), r.steadyTime()));
        else if (r.windows.size() >= kFewestForSteady && r.all.mean > 0)
            add("steady mass rate", "none", "the rate still changes in the second half, by MSER-5");
    }

    void cycles() {
        const Cycles c = cyclesOf(flowSamples(run_.series), cycleRuleOf(run_.c));
        if (c.list.size() < kFewestWindows) return;
        add("mass of a " + c.what, cycleText(c.all, "±"),
            fmt::format("{} over {} cycles", scatter(c.all), c.list.size()));
        if (c.steady)
            add("steady mass of a " + c.what, cycleText(c.steadyPart, "±"),
                fmt::format("{}, from t = {:.4g} s on by MSER-5", scatter(c.steadyPart), c.steadyTime()));
    }

    /// Means by time. Values while the throat is nearly empty come from few particles, but count like the rest.
    void outlet() {
        double turning = 0, turns = 0;
        double peak = -std::numeric_limits<double>::infinity(), lowest = -peak;
        for (std::size_t i = 0; i < run_.series.rows(); ++i) {
            const double v = run_.series.number(i, "outlet_velocity_m_s");
            if (std::isnan(v) || run_.series.text(i, "phase") != "rotate") continue;
            turning += v;
            ++turns;
            peak = std::max(peak, v);
            lowest = std::min(lowest, v);
        }
        if (turns > 0)
            add("outlet velocity while dosing", fmt::format("{:.3g} mm/s", turning / turns * 1e3),
                fmt::format("from {:.3g} to {:.3g} mm/s", lowest * 1e3, peak * 1e3));
        const std::vector<double> overlap = run_.series.column("max_overlap_ratio");
        if (!overlap.empty())
            add("deepest overlap",
                fmt::format("{:.3g} of the smaller radius", *std::max_element(overlap.begin(), overlap.end())));
    }

    void stops() {
        if (run_.series.rows() == 0) return;
        const OutletFlow flow = outletFlow(flowSamples(run_.series), filled_);
        const OutletFlow::Stop& stop = flow.longest;
        const std::string lasted = stop.turns > 0 ? fmt::format("{:.3g} s, {:.3g} turns", stop.time, stop.turns)
                                                  : fmt::format("{:.3g} s", stop.time);
        add("longest stop of the outlet while dosing", stop.dose > 0 ? lasted : "none",
            stop.dose > 0 ? fmt::format("from t = {:.4g} s, in dose {}", stop.start, stop.dose) : "");
        const std::string lead = flow.lead ? fmt::format("{:.3g} s of dosing until something came", *flow.lead)
                                           : std::string("nothing came at all");
        const std::vector<double> angles = run_.series.column("coil_angle_rad");
        if (std::all_of(angles.begin(), angles.end(), [&](double a) { return a == angles.front(); }))
            add("first powder", lead);
        else
            add("outlet stopped for more than a turn",
                flow.stoppedAt ? fmt::format("first in dose {}", *flow.stoppedAt) : "never", lead);
    }

    /// From frames at the doses' ends. The summary of a run that kept frames lists the arches.
    void arches() {
        if (!run_.summary.is_object() || !run_.summary.contains("arches")) return;
        double highest = 0;
        int looked = 0, found = 0;
        for (const Json& arch : run_.summary["arches"]) {
            if (!arch.is_object()) continue;
            const double height = arch.value("height_m", 0.0);
            highest = std::max(highest, height);
            ++looked;
            found += height > 0 ? 1 : 0;
        }
        if (looked > 0)
            add("arches over the coil, at the doses' ends", fmt::format("{} of {}", found, looked),
                found > 0 ? fmt::format("the highest {:.3g} mm", highest * 1e3) : "");
    }

    /// From the summary, because the files of a run hold no contacts of that time.
    void settled() {
        if (!run_.summary.is_object() || !run_.summary.contains("settled")) return;
        const Json& s = run_.summary["settled"];
        if (!s.is_object()) return;
        const auto spread = [&](const char* key, const std::string& name, const std::string& note) {
            const Json points = s.value(key, Json());
            if (!points.is_object()) return;
            for (const char* point : {"p10", "median", "p90"})
                if (!points.value(point, Json()).is_number()) return;
            add(name,
                fmt::format("{:.3g}, 80 % from {:.3g} to {:.3g}", points["median"].get<double>(),
                            points["p10"].get<double>(), points["p90"].get<double>()),
                note);
        };
        if (s.value("bulk_density_kg_m3", Json()).is_number())
            add("bulk density of the bed, settled", fmt::format("{:.4g} kg/m³", s["bulk_density_kg_m3"].get<double>()));
        spread("pull_off_over_weight", "pull-off over weight, settled", "median over pairs; of the lighter sphere");
        spread("overlap_ratio", "overlap over radius, settled", "median over pairs; of the smaller sphere");
        spread("largest_overlap_ratio", "largest overlap so far over radius, settled", "likewise");
    }

    /// The element tests of the case, from the summary.
    void measures() {
        if (!run_.summary.is_object() || !run_.summary.contains("measures")) return;
        for (const auto& [name, measure] : run_.summary["measures"].items()) {
            if (!measure.is_object()) continue;
            if (measure.contains("none_because") && measure["none_because"].is_string())
                add(name, "none", measure["none_because"].get<std::string>());
            for (const auto& [key, value] : measure.items()) {
                if (!value.is_number()) continue;
                const FigureText text = figureText(key, value.get<double>());
                add(name + ", " + text.words, text.value);
            }
        }
    }

    void bed() {
        if (!run_.particles || !run_.c.canister) return;
        const World& w = run_.c.world;
        const geometry::Coil* coil = w.coil ? &*w.coil : nullptr;
        if (const auto d = bedDensity(w, *run_.particles, *run_.c.canister, coil, run_.bodies))
            add("bulk density of the bed, at the end", fmt::format("{:.4g} kg/m³", d->density),
                fmt::format("over {:.3g} cm³, a mean diameter from walls, coil, bodies and surface", d->volume * 1e6));
        if (!coil) return;
        if (const auto d = coilDensity(w, *run_.particles, *run_.c.canister, *coil, 0, run_.bodies))
            add("bulk density between the turns, at the end", fmt::format("{:.4g} kg/m³", d->density),
                "wherever powder lies above; voids under arches included");
        const double last = run_.c.canister->length - coil->pitch;
        if (const auto d = coilDensity(w, *run_.particles, *run_.c.canister, *coil, last, run_.bodies)) {
            const Schedule& s = run_.c.schedule;
            const double turns = s.coilSpeed * s.rotateTime / (2 * kPi);  // if nothing but the time ends a dose
            const std::string closed =
                fmt::format("closed form with it: {} g/dose", grams(closedFormMass(d->density, *coil, turns)));
            add("the same, in the last turn before the outlet", fmt::format("{:.4g} kg/m³", d->density),
                s.isPlain() ? closed : "");
        }
        if (const auto arch = archAbove(*coil, *run_.c.canister, *run_.particles, w, run_.bodies))
            add("arch over the coil, at the end", fmt::format("{:.3g} mm high", arch->height * 1e3),
                fmt::format("at z = {:.3g} mm; voids over {:.3g} mm of the coil", arch->z * 1e3, arch->length * 1e3));
        else
            add("arch over the coil, at the end", "none");
    }

    const RunSources& run_;
    double filled_;
    Json list_ = Json::array();
};

}  // namespace

bool rateLeads(const RunSources& run) {
    if (run.doses.size() > 1) return false;
    // One plug in a long time is steady nowhere, though MSER-5 takes it all.
    const MassRate rate = massRate(flowSamples(run.series), windowRuleOf(run.c));
    return rate.steady && !comesInPortions(rate) && rate.steadyPart.mean > 3 * rate.steadyPart.error;
}

Particles endParticles(const std::filesystem::path& file, const Case& c) {
    const Table table = Table::read(file);
    const std::vector<PowderOf> powders = powdersOf(c);
    Particles p;
    for (std::size_t i = 0; i < table.rows(); ++i) {
        p.add({table.number(i, "x_m"), table.number(i, "y_m"), table.number(i, "z_m")}, table.number(i, "radius_m"));
        if (table.has("powder"))
            for (const PowderOf& powder : powders)
                if (powder.name == table.text(i, "powder")) p.material.back() = std::uint8_t(powder.material);
        const std::string& status = table.text(i, "status");
        const auto& names = Words<Status>::kNames;
        const auto word = std::find(names.begin(), names.end(), status);
        p.status.back() = word == names.end() ? Status::Lost : static_cast<Status>(word - names.begin());
    }
    return p;
}

double filledMass(const RunSources& run) {
    if (run.series.rows() == 0) return fillOf(run.c).mass;
    double sum = 0;
    for (const char* name : {"dosed_mass_kg", "canister_mass_kg", "throat_mass_kg", "lost_mass_kg"})
        sum += run.series.number(run.series.rows() - 1, name);
    return sum;
}

Supply supplyOf(const RunSources& run) {
    Supply supply = filledMass(run);
    for (const AddedPowder& p : addedPowder(run)) supply.refills.push_back({p.time, p.mass});
    return supply;
}

Json runFacts(const RunSources& run) {
    return Facts(run).list();
}

}  // namespace vkdose::report
