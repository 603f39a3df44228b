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

/// The first body on a hinge that starts at one of two stops.
CycleRule tipRuleOf(const Case& c) {
    std::size_t place = 0;
    for (const RigidBody& body : c.world.bodies) {
        const geometry::Hinge* hinge = body.hinge();
        if (hinge == nullptr) continue;
        const double far = hinge->high == 0 ? hinge->low : hinge->low == 0 ? hinge->high : 0;
        if (far != 0 && std::isfinite(far)) {
            CycleRule rule;
            rule.what = "tip of " + body.name;
            rule.tips = TippingBody{place, far};
            return rule;
        }
        ++place;
    }
    return {};
}

/// The lines at which the body leaves its stop to go beyond the middle between its stops. Less is no tip: it trembles
/// under what falls on it.
std::vector<std::size_t> tipsOf(const std::vector<FlowSample>& samples, const TippingBody& body) {
    constexpr double kAtStop = 0.01, kTipped = 0.5;  // of the way to the other stop
    std::vector<std::size_t> tips;
    std::size_t atStop = 0;
    bool over = false;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        if (body.hinge >= samples[i].hinges.size()) return {};
        const double way = samples[i].hinges[body.hinge] / body.far;
        if (way > kTipped && !over) tips.push_back(atStop);
        over = way > kTipped || (over && way > kAtStop);
        if (way <= kAtStop) atStop = i;
    }
    return tips;
}

/// From each tip to the next. Their ends are lines of the time series, where the mass is known.
std::vector<CycleMass> fromTipToTip(const std::vector<FlowSample>& samples, const TippingBody& body) {
    std::vector<CycleMass> list;
    const std::vector<std::size_t> tips = tipsOf(samples, body);
    for (std::size_t k = 1; k < tips.size(); ++k) {
        const FlowSample &from = samples[tips[k - 1]], &to = samples[tips[k]];
        list.push_back({static_cast<int>(k), from.time, to.time, to.dosed - from.dosed, from.inside});
    }
    return list;
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
    if (slowest == nullptr) return tipRuleOf(c);
    return byTime(fmt::format("{} of {}", strokeOf(slowest->course.motion), slowest->name), longest);
}

Cycles cyclesOf(const std::vector<FlowSample>& samples, const CycleRule& rule) {
    Cycles cycles;
    cycles.what = rule.what;
    if (rule.tips) {
        cycles.list = fromTipToTip(samples, *rule.tips);
    } else if (rule.length > 0) {
        const auto parts = TurningFlow(samples, rule.by, rule.from).parts(rule.length);
        if (!isResolved(rule, parts.size())) return cycles;
        for (const TurningFlow::Part& p : parts)
            cycles.list.push_back({static_cast<int>(cycles.list.size() + 1), p.from, p.to, p.mass, p.left});
    }
    std::vector<double> masses;
    for (const CycleMass& cycle : cycles.list) masses.push_back(cycle.mass);
    static_cast<SteadySeries&>(cycles) = steadySeries(masses);
    return cycles;
}

std::string cycleText(const SeriesFigures& f, const char* plusMinus) {
    const std::string error = std::isfinite(f.error) ? fmt::format(" {} {} g", plusMinus, grams(f.error)) : "";
    return fmt::format("{} g{}", grams(f.mean), error);
}

}  // namespace vkdose
