#include "host/analysis/cycles.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/core/grams.h"

namespace vkdose {

namespace {

/// So many intervals the ends of whole-interval cycles may slip by in a run, as rounding of the period makes them.
constexpr double kSlippedIntervals = 0.05;

/// The name of a period of this motion.
const char* strokeOf(const geometry::Motion& motion) {
    return std::holds_alternative<geometry::Turn>(motion) ? "turn" : "stroke";
}

bool isResolved(const CycleRule& rule, std::size_t cycles) {
    const double intervals = rule.period / rule.interval, whole = std::round(intervals);
    if (intervals >= kFewestRateIntervals * (1 - 1e-9)) return true;
    return whole >= 1 && std::abs(intervals - whole) * static_cast<double>(cycles) <= kSlippedIntervals;
}

constexpr CycleFigure kCycleList[] = {
    {"mean_kg", [](const Cycles& c) { return c.all.mean; }, "mean_error_kg"},
    {"mean_error_kg", [](const Cycles& c) { return c.all.error; }},
    {"rsd", [](const Cycles& c) { return c.all.relative; }},
    {"steady_from_s", [](const Cycles& c) { return c.steadyTime(); }},
    {"steady_kg", [](const Cycles& c) { return c.steadyPart.mean; }, "steady_error_kg"},
    {"steady_error_kg", [](const Cycles& c) { return c.steadyPart.error; }},
    {"steady_rsd", [](const Cycles& c) { return c.steadyPart.relative; }},
};

}  // namespace

const std::span<const CycleFigure> kCycleFigures = kCycleList;

double Cycles::steadyTime() const {
    return steady ? list[*steady].start : std::numeric_limits<double>::quiet_NaN();
}

CycleRule cycleRuleOf(const Case& c) {
    const double fastest = c.schedule.fastestSpeed();  // of the drive
    const auto byAngle = [&](std::string what, double angle) {
        return CycleRule{std::move(what), TurningFlow::By::Angle, angle, angle / fastest, c.sensorInterval, {}};
    };
    const auto byTime = [&](std::string what, double time) {
        return CycleRule{std::move(what), TurningFlow::By::Time, time, time, c.sensorInterval, countedFrom(c)};
    };
    const RigidBody* slowest = nullptr;
    double longest = 0;
    for (const RigidBody& body : c.world.bodies) {
        const bool byDrive = body.clock == Clock::Drive;
        const auto period = geometry::periodOf(body.course.motion);  // by the drive [rad], else [s]
        if (!period || (byDrive && !(fastest > 0))) continue;
        if (body.pockets > 0) {
            const std::string what = fmt::format("pocket of {}", body.name);
            return byDrive ? byAngle(what, *period / body.pockets) : byTime(what, *period / body.pockets);
        }
        if (byDrive || *period <= longest) continue;
        longest = *period;
        slowest = &body;
    }
    if (c.world.coil || followsDrive(c.world.bodies))
        return fastest > 0 ? byAngle("turn of the drive", 2 * kPi) : CycleRule{};
    if (slowest == nullptr) return {};
    return byTime(fmt::format("{} of {}", strokeOf(slowest->course.motion), slowest->name), longest);
}

Cycles cyclesOf(const std::vector<FlowSample>& samples, const CycleRule& rule) {
    Cycles cycles;
    cycles.what = rule.what;
    if (!(rule.length > 0)) return cycles;
    const auto parts = TurningFlow(samples, rule.by, rule.from).parts(rule.length);
    if (!isResolved(rule, parts.size())) return cycles;
    std::vector<double> masses;
    for (const TurningFlow::Part& p : parts) {
        masses.push_back(p.mass);
        cycles.list.push_back({static_cast<int>(masses.size()), p.from, p.to, p.mass, p.left});
    }
    static_cast<SteadySeries&>(cycles) = steadySeries(masses);
    return cycles;
}

std::string cycleText(const SeriesFigures& f, const char* plusMinus) {
    const std::string error = std::isfinite(f.error) ? fmt::format(" {} {} g", plusMinus, grams(f.error)) : "";
    return fmt::format("{} g{}", grams(f.mean), error);
}

}  // namespace vkdose
