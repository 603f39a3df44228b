#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "host/advice/advice.h"
#include "host/advice/figures.h"
#include "host/app/commands.h"
#include "host/app/exit_code.h"
#include "host/app/speed.h"
#include "host/app/tell.h"
#include "host/app/text.h"
#include "host/core/file.h"
#include "host/core/json.h"
#include "host/core/printable.h"
#include "host/model/bed_weight.h"
#include "host/model/powders.h"
#include "host/model/stability.h"
#include "host/report/player_bodies.h"
#include "host/report/player_data.h"
#include "host/sim/added_series.h"
#include "host/sim/planned_motion.h"
#include "host/sim/runner.h"

namespace vkdose {

namespace {

using Json = nlohmann::ordered_json;

/// A case with everything that check says of it.
struct Checked {
    Case c;
    Insertion filled;
    Derived derived;
    Figures figures;
    std::vector<Warning> warnings;
};

Checked checked(const CaseOptions& input) {
    Case c = loadCase(input.file, input.overrides);
    Insertion filled = insertParticles(c);
    Derived derived = derive(c, filled);
    Figures figures = figuresOf(c, filled);
    std::vector<Warning> warnings = warningsOf(c, filled);
    return {std::move(c), std::move(filled), std::move(derived), std::move(figures), std::move(warnings)};
}

// ---- text ---------------------------------------------------------------------------------------------------------

void printFilling(const Case& c, const Insertion& filled) {
    const auto [low, high] = std::minmax_element(filled.particles.radius.begin(), filled.particles.radius.end());
    tell("particles  {}, {:.4g} g", filled.particles.size(), filled.mass * 1e3);
    if (filled.targetMass > 0) tell(" (target {:.4g} g)", filled.targetMass * 1e3);
    if (low != filled.particles.radius.end()) tell(", radius {:.4g} to {:.4g} mm", *low * 1e3, *high * 1e3);
    if (filled.redrawn > 0) tell(", {} draws outside the bounds drawn again", filled.redrawn);
    tell("\n");
    if (c.furtherPowders.empty()) return;
    const std::vector<PowderOf> powders = powdersOf(c);
    for (std::size_t k = 0; k < powders.size(); ++k) {
        const SizeRange size = powderSizes(c).at(std::size_t(powders[k].material));
        tell("powder     {}: {}, {:.4g} g (target {:.4g} g), {:.4g} kg/m3", powders[k].name,
             filled.powders[k].particles, filled.powders[k].mass * 1e3, filled.powders[k].targetMass * 1e3,
             c.world.density(powders[k].material));
        if (filled.powders[k].particles > 0)
            tell(", radius {:.4g} to {:.4g} mm", size.smallest * 1e3, size.largest * 1e3);
        tell("\n");
    }
}

std::string whenOf(const Case& c, const Refill& r) {
    if (r.time) return fmt::format("at t = {:.4g} s", *r.time);
    if (r.beforeDose) return fmt::format("before dose {}", *r.beforeDose);
    if (!r.below) return "when it is ordered";
    return fmt::format("when {} holds less than {:.4g} g", r.watched ? c.world.regions[*r.watched].name : "the device",
                       *r.below * 1e3);
}

/// The refills of one table, `first` to before `end`, in one line.
void printSeries(const Case& c, const Insertion& filled, std::size_t first, std::size_t end) {
    const Refill &one = c.refills[first], &last = c.refills[end - 1];
    std::size_t spheres = 0;
    double mass = 0;
    for (std::size_t k = first; k < end; ++k) {
        spheres += filled.waiting[k].particles.size();
        mass += filled.waiting[k].mass;
    }
    tell("refill     {} to {}: {}, {:.4g} g in all, {}\n", one.name, last.name, spheres, mass * 1e3,
         one.time ? fmt::format("from t = {:.4g} s to {:.4g} s", *one.time, *last.time) : whenOf(c, one));
}

void printRefills(const Case& c, const Insertion& filled) {
    for (std::size_t k = 0; k < c.refills.size();) {
        const Refill& r = c.refills[k];
        std::size_t end = k + 1;
        while (end < c.refills.size() && c.refills[end].table == r.table) ++end;
        if (end - k > kToldRefills) {
            printSeries(c, filled, k, end);
            k = end;
            continue;
        }
        const Insertion::Waiting& powder = filled.waiting[k];
        tell("refill     {}: {}, {:.4g} g, {}\n", r.name, powder.particles.size(), powder.mass * 1e3, whenOf(c, r));
        ++k;
    }
}

void printSoftening(const Case& c) {
    const ContactParameters& p = c.dosingLaw.of(ContactClass::ParticleParticle);
    tell("softened   {:.4g} times: k = {:.5g} N/m, damping {:.4g} kg/s, plasticity_depth {:.4g} between particles\n",
         c.softened, p.k2Max, p.gamma, p.plasticityDepth);
}

void printDerivations(const Case& c) {
    for (const std::string& line : c.derivations) tell("derived    {}\n", printable(line));
}

void printContacts(const Case& c, const Derived& d, const Figures& f) {
    const NormalLaw law = c.dosingLaw.of(ContactClass::ParticleParticle).law;
    tell("contact duration   {}\n", law == NormalLaw::Luding ? "  mean pair on k1  stiffest pair on k2"
                                    : law == NormalLaw::User
                                        ? "      mean pair        smallest pair   (at the law's largest stiffness)"
                                        : "      mean pair        smallest pair   (as stiff as at max_overlap_ratio)");
    for (const Derived::PairDuration& p : d.durations) {
        tell("  {:<18} {:>13.4g} s  {:>17.4g} s\n", p.name, p.mean, p.stiffest);
    }
    tell("restitution                mean    smallest     largest   ({})\n",
         law == NormalLaw::HertzMindlin ? "of any impact"
         : law == NormalLaw::User       ? "of its damping alone, at its largest stiffness"
                                        : "of damping alone, on k1");
    for (const Restitution& e : f.restitutions)
        tell("  {:<18} {:>10.3g}  {:>10.3g}  {:>10.3g}\n", nameOf(c.world, e.pair), e.mean, e.smallest, e.largest);
    tell("time step  {:.4g} s = 1/{:.3g} of the stiffest; auto is {:.3g} s, limited by {}\n", d.timeStep,
         d.stiffest / d.timeStep, f.automaticStep, f.stepLimit);
}

/// Fall, weight and adhesion of the bed, where they are known.
void printBed(const Checked& all) {
    const Figures& f = all.figures;
    if (!(f.bedDepth > 0)) return;
    tell("bed        {:.3g} mm deep at a volume fraction of {}; the fill falls {:.3g} mm in {:.2g} s\n",
         f.bedDepth * 1e3, kBedFraction, f.fall * 1e3, f.fallTime);
    tell(
        "overlap    {:.2g} of the radius under the bed's weight, {:.2g} in its chains of force, {:.2g} of the fall "
        "(limit {:.3g})\n",
        f.overlapUnderBed, kChain * f.overlapUnderBed, f.overlapOfFall, all.c.world.maxOverlapRatio);
    if (std::isnan(f.bondLargest)) return;  // of a user's law nobody knows it
    tell("Bond       {:.2g} under the bed's weight, at most {:.3g} (pull-off force over weight, mean pair)\n",
         f.bondUnderBed, f.bondLargest);
}

void printGaps(const Checked& all) {
    const Figures& f = all.figures;
    const auto row = [&](const char* what, double width) {
        if (width >= 0)
            tell("{} {:.3g} mm: {:.2g} mean spheres across, {:.2g} of the largest\n", what, width * 1e3,
                 width / (2 * f.mean), width / (2 * f.largest));
    };
    row("coil gap  ", f.coilGap);
    row("clearance ", f.coilClearance);
    if (all.c.canister) row("outlet    ", all.c.canister->outletDiameter);
}

void printPredictions(const Derived& d, const Schedule& schedule, bool coil) {
    const std::string form =
        coil ? "rho_b p pi r_c^2 n_t"
             : fmt::format("rho_b times pitch and free section of {}", fmt::join(d.conveyors, ", "));
    tell("push V_z   {:.4g} mm/s (p Omega / 2 pi)\n", d.pushVelocity * 1e3);
    tell("tip V_t    {:.4g} mm/s (Omega r_c)\n", d.tipVelocity * 1e3);
    tell("rate       {:.4g} g/s by the closed form ({})\n", d.rate(schedule.coilSpeed) * 1e3, form);
    if (schedule.rotateTime == 0) return;
    if (schedule.targetMass > 0 && d.massPerTurn > 0)
        tell("per dose   {:.4g} g, which are {:.3g} turns by the closed form\n", d.massPerDose * 1e3,
             d.massPerDose / d.massPerTurn);
    else if (schedule.targetMass > 0)
        tell("per dose   {:.4g} g, which take {:.3g} s by the closed form\n", d.massPerDose * 1e3,
             d.massPerDose / d.massPerSecond);
    else
        tell("per dose   {:.4g} g by the closed form\n", d.massPerDose * 1e3);
    tell("doses      {:.3g} to empty the canister by the closed form\n", d.doses);
}

void printWarnings(const std::vector<Warning>& warnings) {
    for (const Warning& w : warnings)
        if (!w.accepted) tell("warning    {}\n", w.line());
    for (const Warning& w : warnings)
        if (w.accepted) tell("accepted   {}\n", w.line());
}

void printText(const CheckOptions& options, const Checked& all) {
    const Timeline timeline(all.c);
    tell("case       {}: {}\n", all.c.name, printableLines(all.c.reason));
    printFilling(all.c, all.filled);
    printRefills(all.c, all.filled);
    if (all.c.softened > 1) printSoftening(all.c);
    if (const auto& law = all.c.dosingLaw.user) tell("law        {} ({})\n", printable(law->name), law->hash);
    printDerivations(all.c);
    printContacts(all.c, all.derived, all.figures);
    printBed(all);
    printGaps(all);
    if (all.derived.conveys()) printPredictions(all.derived, all.c.schedule, all.c.world.coil.has_value());
    const Schedule& s = all.c.schedule;
    tell("schedule   settle {}{} steps, rotate {}{}, rest {}; sensors every {} steps\n",
         s.untilRest ? "until at rest, at most " : "", timeline.settleSteps(), s.targetMass > 0 ? "at most " : "",
         timeline.rotateSteps(), timeline.restSteps(), timeline.sensorSteps());
    if (s.targetMass > 0)
        tell("target     {:.4g} g a dose, in {} speed{}\n", s.targetMass * 1e3, s.stages.size() + 1,
             s.stages.empty() ? "" : "s");
    tell("{}", workText(all.derived));
    tell("{}", runTimeText(all.derived, speedOf(all.c, all.filled, options.backend, options.assume)));
    printWarnings(all.warnings);
}

// ---- JSON ---------------------------------------------------------------------------------------------------------

Json errorsOf(const CaseError& error) {
    Json all = Json::array();
    for (const Diagnostic& d : error.faults())
        all.push_back({{"file", printable(d.file)},
                       {"line", d.line},
                       {"key", printable(d.key)},
                       {"value", printable(d.value)},
                       {"text", printable(d.problem)},
                       {"cure", printable(d.remedy)}});
    return all;
}

Json warningsJson(const std::vector<Warning>& warnings) {
    Json all = Json::array();
    for (const Warning& w : warnings)
        all.push_back({{"name", w.name},
                       {"key", w.key},
                       {"value", printable(w.value)},
                       {"text", printable(w.text)},
                       {"cure", printable(w.cure)},
                       {"accepted", w.accepted}});
    return all;
}

Json figuresJson(const Checked& all) {
    const Figures& f = all.figures;
    const Derived& d = all.derived;
    Json e = Json::object();
    for (const Restitution& r : f.restitutions)
        e[nameOf(all.c.world, r.pair)] = {{"mean", r.mean}, {"smallest", r.smallest}, {"largest", r.largest}};
    return {{"particles", d.particles},
            {"fill_kg", jsonNumber(d.fillMass)},
            {"radius_min_m", jsonNumber(f.smallest)},
            {"radius_mean_m", jsonNumber(f.mean)},
            {"radius_max_m", jsonNumber(f.largest)},
            {"time_step_s", jsonNumber(d.timeStep)},
            {"automatic_step_s", jsonNumber(f.automaticStep)},
            {"step_limit", f.stepLimit},
            {"restitution", e},
            {"bed_depth_m", jsonNumber(f.bedDepth)},
            {"fall_m", jsonNumber(f.fall)},
            {"fall_s", jsonNumber(f.fallTime)},
            {"overlap_under_bed", jsonNumber(f.overlapUnderBed)},
            {"overlap_of_fall", jsonNumber(f.overlapOfFall)},
            {"bond_under_bed", jsonNumber(f.bondUnderBed)},
            {"bond_largest", jsonNumber(f.bondLargest)},
            {"coil_gap_m", jsonNumber(f.coilGap)},
            {"coil_clearance_m", jsonNumber(f.coilClearance)},
            {"rate_kg_s", jsonPositive(d.rate(all.c.schedule.coilSpeed))},
            {"dose_kg", jsonPositive(d.massPerDose)},
            {"doses", jsonPositive(d.doses)},
            {"steps", jsonNumber(d.steps)},
            {"simulated_s", jsonNumber(f.runTime)}};
}

Json runTimeJson(const CheckOptions& options, const Checked& all) {
    const double work = all.derived.work;
    const Speed speed = speedOf(all.c, all.filled, options.backend, options.assume);
    return {{"particle_steps", jsonNumber(work)},
            {"particle_steps_per_second", jsonNumber(speed.rate)},
            {"seconds", jsonNumber(work / speed.rate)},
            {"measured", speed.measured},
            {"told", printable(speed.told)}};
}

/// The powder as it is filled in, the device around it, and how that will move.
Json sceneOf(const Checked& all) {
    Frame frame;
    frame.particles = all.filled.particles;
    const report::FrameSource only{{FrameEntry{}}, [&](const FrameEntry&) { return frame; }};
    Json scene = report::playerJson(all.c, only, 0);
    scene["motion"] = report::motionJson(all.c, plannedMotion(all.c));
    return scene;
}

int checkAsJson(const CheckOptions& options) {
    Json out{{"case", printable(options.input.file.string())},
             {"file", std::filesystem::absolute(options.input.file).string()},
             {"errors", Json::array()},
             {"warnings", Json::array()}};
    ExitCode code = kOk;
    try {
        const Checked all = checked(options.input);
        out["case"] = all.c.name;
        out["warnings"] = warningsJson(all.warnings);
        out["figures"] = figuresJson(all);
        out["run_time"] = runTimeJson(options, all);
        Json derivations = Json::array();
        for (const std::string& line : all.c.derivations) derivations.push_back(printable(line));
        out["derived"] = derivations;
        out["resolved"] = all.c.resolved;
        if (options.scene) out["scene"] = sceneOf(all);
    } catch (const CaseError& error) {
        out["errors"] = errorsOf(error);
        code = kBadInput;
    } catch (const ReadError& error) {
        out["errors"] = errorsOf(CaseError({{"", 0, "", "", error.what(), ""}}));
        code = kBadInput;
    }
    tell("{}\n", out.dump(2));
    return code;
}

}  // namespace

int checkCommand(const CheckOptions& options) {
    if (options.json) return checkAsJson(options);
    printText(options, checked(options.input));
    return kOk;
}

}  // namespace vkdose
