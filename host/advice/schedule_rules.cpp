// Warnings about times, doses and the ends of a run.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "host/advice/advice.h"
#include "host/advice/rules.h"
#include "host/core/closest_word.h"
#include "host/model/overlaps.h"

namespace vkdose {
namespace {

/// Times of the fall after which the kinetic energy of the shipped beds is down to some hundredths of the fall's.
/// Their last motion ends after about twice as long.
constexpr double kFalls = 2.5;
constexpr double kSpheresInDose = 20;
/// The first dose of a cohesive powder, which fills the throat too, took 1.8 times as long as by the closed form.
constexpr double kDoseTime = 2;
constexpr double kSampledPeriod = 0.25;  ///< longest interval of sensors, in periods of a motion
constexpr double kSlip = 0.05;           ///< periods that sensors of whole periods may slip by in a run
constexpr double kShortStep = 0.1;       ///< of the automatic step
constexpr double kLongRun = 1e9;         ///< steps
constexpr double kTwoFloats = 0x1p-48;   ///< of a number, lost in a step
constexpr double kCreep = 1e-3;          ///< of the speed after a fall of a sphere's own diameter
constexpr double kCoarse = 1e-2;         ///< share of its way that may be lost
/// Steps of a small canister in a second on the fastest devices, in round figures.
constexpr double kFastSteps = 1e4;

/// Whether the particles come from a list and touch one another as those of a settled bed do.
bool isBed(const Case& c) {
    if (!c.filling.list) return false;
    std::size_t contacts = 0;
    forEachOverlap(c.world, *c.filling.list, [&](std::size_t, std::size_t, double) { ++contacts; });
    return contacts >= c.filling.list->size();
}

}  // namespace

Found shortSettling(const Subject& s) {
    const double settle = s.c.schedule.settleTime, needed = kFalls * s.f.fallTime;
    if (s.c.schedule.rotateTime == 0 || !(settle < needed) || isBed(s.c)) return {};
    return Finding{"settle.time_s",
                   fmt::format("the highest sphere falls {:.3g} mm, which takes {:.2g} s, and the bed moves about as "
                               "long again and more; the coil turns before it rests",
                               s.f.fall * 1e3, s.f.fallTime),
                   fmt::format("give at least {:.2g}, better {:.2g}", needed, 2 * needed)};
}

Found longDose(const Subject& s) {
    double given = s.derived.fillMass;
    for (const Refill& refill : s.c.refills)
        if (refill.planned()) given += refill.mass;
    if (!(s.derived.massPerDose > given)) return {};
    return Finding{"dose.rotate_s",
                   fmt::format("by the closed form a dose conveys {:.3g} g, more than the {} of {:.3g} g",
                               s.derived.massPerDose * 1e3,
                               given > s.derived.fillMass ? "fill and its refills" : "fill", given * 1e3),
                   fmt::format("give less than {:.3g} s, or a slower coil",
                               s.c.schedule.rotateTime * given / s.derived.massPerDose)};
}

Found shortLongestTime(const Subject& s) {
    const Schedule& schedule = s.c.schedule;
    const double longest = schedule.rotateTime;
    if (schedule.targetMass == 0 || !(s.derived.rate(schedule.coilSpeed) > 0)) return {};
    double time = schedule.rampTime, done = 0;
    for (const DoseStage& stage : schedule.stages) {
        time += (stage.until - done) * schedule.targetMass / s.derived.rate(stage.speed);
        done = stage.until;
    }
    time += (1 - done) * schedule.targetMass / s.derived.rate(schedule.coilSpeed);
    if (!(longest < kDoseTime * time)) return {};
    return Finding{"dose.max_rotate_s",
                   fmt::format("by the closed form {:.3g} g take {:.3g} s, and powder that slips or a throat that is "
                               "filled first take longer; what is missing then is told, not dosed",
                               schedule.targetMass * 1e3, time),
                   fmt::format("give at least {:.2g}", kDoseTime * time)};
}

Found smallDose(const Subject& s) {
    if (s.derived.massPerDose <= 0) return {};
    const double sphere = s.filled.mass / static_cast<double>(s.filled.particles.size());
    const double count = s.derived.massPerDose / sphere;
    if (count >= kSpheresInDose) return {};
    return Finding{"dose.rotate_s",
                   fmt::format("by the closed form a dose is {:.2g} spheres, so that one sphere is {:.2g} % of it",
                               count, 100 / count),
                   fmt::format("turn {:.2g} times longer, or give spheres {:.2g} times smaller", kSpheresInDose / count,
                               std::cbrt(kSpheresInDose / count))};
}

Found earlyStop(const Subject& s) {
    const StopRule& stop = s.c.schedule.stop;
    if (stop.kind != StopRule::Kind::Experiment) return {};
    const double expected = stop.doses * s.derived.massPerDose;
    if (s.derived.massPerDose <= 0 || stop.threshold < 0.5 * expected) return {};
    return Finding{
        "stop.threshold_g",
        fmt::format("the run ends when {} doses together give no more than this, and by the closed form they "
                    "give {:.3g} g",
                    stop.doses, expected * 1e3),
        fmt::format("give about {:.2g}, a hundredth of a dose for each", 1e3 * expected / 100)};
}

Found lateRefill(const Subject& s) {
    const Schedule& plan = s.c.schedule;
    const StopRule& stop = plan.stop;
    const bool counted = plan.rotateTime > 0 && stop.maxDoses < std::numeric_limits<int>::max();
    const double dose = plan.rotateTime + plan.reverseTime() + plan.restTime;
    const double end = std::min(stop.endTime, counted ? plan.settleTime + stop.maxDoses * dose : stop.endTime);
    for (const Refill& refill : s.c.refills) {
        if (refill.time && *refill.time > end)
            return Finding{
                fmt::format("refill[{}].time_s", refill.table),
                fmt::format("refill \"{}\" never comes: the run ends after {:.4g} s at the latest", refill.name, end),
                "give an earlier time, or let the run go on for longer"};
        if (refill.beforeDose && counted && *refill.beforeDose > stop.maxDoses)
            return Finding{
                fmt::format("refill[{}].before_dose", refill.table),
                fmt::format("refill \"{}\" never comes: the run ends after {} doses", refill.name, stop.maxDoses),
                "give an earlier dose, or a larger stop.max_doses"};
        if (refill.below && !refill.watched && s.filled.mass <= *refill.below)
            return Finding{fmt::format("refill[{}].below_g", refill.table),
                           fmt::format("refill \"{}\" never comes: the fill of {:.4g} g is never above its mark",
                                       refill.name, s.filled.mass * 1e3),
                           "give a mark below the mass of the fill"};
    }
    return {};
}

Found longWindow(const Subject& s) {
    const Schedule& plan = s.c.schedule;
    const double turning = plan.rotateTime > 0 ? plan.rotateTime * plan.stop.maxDoses : s.f.runTime;
    if (!(s.c.rateWindow > turning)) return {};
    return Finding{
        "sensors.rate_window_s",
        fmt::format("the feeder works for {:.3g} s in all, so that no window is whole, and no mass rate is told",
                    turning),
        fmt::format("give about {:.2g}, for twenty windows, or leave it out", turning / 20)};
}

Found fewFrames(const Subject& s) {
    if (s.c.frames.interval == 0 || s.c.frames.interval <= s.f.runTime) return {};
    return Finding{"frames.interval_s", fmt::format("is longer than the run, which takes some {:.3g} s", s.f.runTime),
                   fmt::format("give about {:.2g}, for a hundred frames", s.f.runTime / 100)};
}

Found fewSensors(const Subject& s) {
    const double rotate = s.c.schedule.rotateTime;
    const double shortest = rotate > 0 ? rotate : s.f.runTime;
    if (s.c.sensorInterval <= 0.5 * shortest) return {};
    return Finding{"sensors.interval_s",
                   fmt::format("leaves no more than a line or two of the time series in {} of {:.3g} s",
                               rotate > 0 ? "a rotation" : "the run", shortest),
                   fmt::format("give about {:.2g}", shortest / 50)};
}

Found aliasedSensors(const Subject& s) {
    for (const RigidBody& body : s.c.world.bodies) {
        const std::optional<double> period = geometry::periodOf(body.course.motion);
        if (!period || std::holds_alternative<geometry::Turn>(body.course.motion)) continue;
        const double periods = s.c.sensorInterval / *period, whole = std::round(periods);
        if (periods <= kSampledPeriod) continue;
        if (whole >= 1 && std::abs(periods - whole) * s.f.runTime <= kSlip * s.c.sensorInterval) continue;
        return Finding{
            "sensors.interval_s",
            fmt::format("is {:.3g} periods of body \"{}\", which moves at {:.4g} Hz; the time series then shows "
                        "a slow motion that does not exist",
                        periods, body.name, 1 / *period),
            fmt::format("give {:.3g} or less, or whole periods: {:.6g}", kSampledPeriod * *period,
                        std::max(whole, 1.0) * *period)};
    }
    return {};
}

Found shortStep(const Subject& s) {
    if (s.c.world.timeStep >= kShortStep * s.f.automaticStep) return {};
    return Finding{"time.step_s",
                   fmt::format("is {:.2g} of what stability asks for, so that the run takes {:.2g} times as long",
                               s.c.world.timeStep / s.f.automaticStep, s.f.automaticStep / s.c.world.timeStep),
                   fmt::format("give \"auto\", which is {:.3g}", s.f.automaticStep)};
}

/// What two floats lose of a place in a step, beside the way of a sphere that creeps (shaders/README.md, Quantities
/// that grow by small steps). What they lose of a speed, beside what gravity adds to it, is far less: a fall's speed
/// over g is a second at most, and the distance from the origin over the speed of creeping some hundred.
Found coarseNumbers(const Subject& s) {
    const double dt = s.c.world.timeStep, g = glm::length(s.c.world.gravity);
    double far = 0;
    for (const Vec3& x : s.filled.particles.position) far = std::max(far, glm::length(x));
    const double creep = kCreep * std::sqrt(4 * g * s.f.smallest), lost = kTwoFloats * far / dt;
    if (!(lost > kCoarse * creep) || g == 0) return {};
    return Finding{
        "time.step_s",
        fmt::format("is so short that a device moves spheres {:.2g} m from the origin at speeds that are off "
                    "by up to {:.2g} m/s, {:.2g} of what a sphere has after a fall of its own diameter",
                    far, lost, kCreep * lost / creep),
        fmt::format("give at least {:.2g}, with softer or larger spheres, place the device nearer to the "
                    "origin, or use --backend reference",
                    kTwoFloats * far / (kCoarse * creep))};
}

Found longRun(const Subject& s) {
    if (!(s.derived.steps > kLongRun)) return {};
    const bool settling = s.c.schedule.settleTime > 0.5 * s.f.runTime;
    return Finding{settling ? "settle.time_s" : "dose.rotate_s",
                   fmt::format("{:.3g} s of powder are {:.2g} steps, {:.2g} days even at {:.0f} steps a second",
                               s.f.runTime, s.derived.steps, s.derived.steps / kFastSteps / 86400, kFastSteps),
                   "give a shorter time, an end (stop.max_doses, stop.end_time_s), or larger and softer spheres"};
}

Found unknownAcceptance(const Subject& s) {
    const std::vector<std::string> names = warningNames();
    for (const std::string& word : s.accepted()) {
        if (std::find(names.begin(), names.end(), word) != names.end()) continue;
        const std::string meant = closestWord(word, names);
        return Finding{"accepted_warnings", fmt::format("there is no warning {}", word),
                       meant.empty() ? "give the name that stands behind a warning in brackets"
                                     : fmt::format("did you mean {}?", meant)};
    }
    return {};
}

}  // namespace vkdose
