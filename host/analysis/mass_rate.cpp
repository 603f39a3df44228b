#include "host/analysis/mass_rate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/analysis/turning_flow.h"
#include "host/core/grams.h"

namespace vkdose {

namespace {

constexpr double kTwentieth = 1.0 / 20;

/// The least whole multiple of `unit` that is not shorter than `length`, up to rounding.
double roundedUpTo(double unit, double length) {
    return unit * std::max(1.0, std::ceil(length / unit * (1 - 1e-9)));
}

constexpr RateFigure kFigures[] = {
    {"window_s", [](const MassRate& r) { return r.window; }},
    {"mean_kg_s", [](const MassRate& r) { return r.all.mean; }, "mean_error_kg_s"},
    {"mean_error_kg_s", [](const MassRate& r) { return r.all.error; }},
    {"rsd", [](const MassRate& r) { return r.all.relative; }},
    {"steady_from_s", [](const MassRate& r) { return r.steadyTime(); }},
    {"steady_kg_s", [](const MassRate& r) { return r.steadyPart.mean; }, "steady_error_kg_s"},
    {"steady_error_kg_s", [](const MassRate& r) { return r.steadyPart.error; }},
    {"steady_rsd", [](const MassRate& r) { return r.steadyPart.relative; }},
};

}  // namespace

const std::span<const RateFigure> kRateFigures = kFigures;

WindowRule windowRuleOf(const Case& c) {
    WindowRule rule;
    rule.asked = c.rateWindow;
    rule.interval = c.sensorInterval;
    rule.from = countedFrom(c);
    const bool driven = c.world.coil || followsDrive(c.world.bodies);
    if (driven && c.schedule.coilSpeed > 0) rule.period = 2 * kPi / c.schedule.coilSpeed;
    if (driven) return rule;
    for (const RigidBody& body : c.world.bodies)
        rule.period = std::max(rule.period, geometry::periodOf(body.course.motion).value_or(0));
    return rule;
}

double windowLength(const WindowRule& rule, double turning) {
    if (rule.asked > 0) return rule.asked;
    const double least = kFewestRateIntervals * rule.interval;
    if (rule.period > 0) return roundedUpTo(rule.period, least);
    return roundedUpTo(rule.interval, std::max(turning * kTwentieth, least));
}

double MassRate::steadyTime() const {
    return steady ? windows[*steady].from : std::numeric_limits<double>::quiet_NaN();
}

std::string rateText(const SeriesFigures& f, const char* plusMinus) {
    const std::string error = std::isfinite(f.error) ? fmt::format(" {} {} g/s", plusMinus, grams(f.error)) : "";
    return fmt::format("{} g/s{}", grams(f.mean), error);
}

bool comesInPortions(const MassRate& rate) {
    return rate.steady && rate.steadyPart.relative > 1;
}

MassRate massRate(const std::vector<FlowSample>& samples, const WindowRule& rule) {
    MassRate r;
    const TurningFlow turning(samples, TurningFlow::By::Time, rule.from);
    if (!(turning.length() > 0)) return r;
    r.window = windowLength(rule, turning.length());
    std::vector<double> rates;
    for (const TurningFlow::Part& p : turning.parts(r.window)) {
        rates.push_back(p.mass / p.length);
        r.windows.push_back({p.from, p.to, rates.back()});
    }
    static_cast<SteadySeries&>(r) = steadySeries(rates);
    return r;
}

}  // namespace vkdose
