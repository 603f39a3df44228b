#include "host/analysis/mass_rate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/core/grams.h"

namespace vkdose {

namespace {

constexpr std::size_t kMostBlocks = 10;
/// So much of the last window may be missing: whole turns are given in rounded seconds, and made in whole steps.
constexpr double kAlmost = 0.01;
constexpr double kTwentieth = 1.0 / 20;
/// A difference of rates by less than this share is rounding: the time series has nine digits of all that is out.
constexpr double kRounding = 1e-6;

/// The least whole multiple of `unit` that is not shorter than `length`, up to rounding.
double roundedUpTo(double unit, double length) {
    return unit * std::max(1.0, std::ceil(length / unit * (1 - 1e-9)));
}

/// Of a motion that repeats [s], or 0.
double periodOf(const geometry::Motion& motion) {
    if (const auto* turn = std::get_if<geometry::Turn>(&motion); turn != nullptr && turn->rate != 0)
        return 2 * kPi / std::abs(turn->rate);
    if (const auto* swing = std::get_if<geometry::Swing>(&motion); swing != nullptr && swing->frequency > 0)
        return 1 / swing->frequency;
    if (const auto* shake = std::get_if<geometry::Shake>(&motion); shake != nullptr && shake->frequency > 0)
        return 1 / shake->frequency;
    return 0;
}

/// What has come out over the time that the drive has turned, line by line.
class Turning {
  public:
    explicit Turning(const std::vector<FlowSample>& samples) {
        FlowSample before;
        for (const FlowSample& s : samples) {
            if (s.turning) add(before, s);
            before = s;
        }
    }

    double time() const { return lines_.empty() ? 0 : lines_.back().turned; }

    /// Windows of this length. A window that begins where a rest ends begins behind the rest.
    std::vector<RateWindow> windows(double length) const {
        std::vector<RateWindow> list;
        std::size_t line = 0;
        Place from = start(0);
        for (int k = 1; k * length <= time() + kAlmost * length; ++k) {
            const double begin = (k - 1) * length, end = std::min(k * length, time());
            // A part in 10^9 is rounding of the sum of lines.
            while (line + 1 < lines_.size() && lines_[line].turned < end * (1 - 1e-9)) ++line;
            const Place to = within(line, end);
            list.push_back({from.time, to.time, (to.mass - from.mass) / (end - begin)});
            const bool atEnd = lines_[line].turned <= end * (1 + 1e-9);
            from = atEnd && line + 1 < lines_.size() ? start(line + 1) : to;
        }
        return list;
    }

  private:
    /// A line in which the drive turned; the sums are those at its end.
    struct Line {
        double from = 0, to = 0;  ///< simulated time [s]
        double turned = 0;        ///< [s]
        double mass = 0;          ///< that came out while turning [kg]
        double own = 0;           ///< of this mass what came out in the line [kg]
    };
    struct Place {
        double time = 0, mass = 0;
    };

    void add(const FlowSample& before, const FlowSample& s) {
        const double own = s.dosed - before.dosed;
        const Line last = lines_.empty() ? Line{} : lines_.back();
        lines_.push_back({before.time, s.time, last.turned + s.time - before.time, last.mass + own, own});
    }
    Place start(std::size_t line) const { return {lines_[line].from, lines_[line].mass - lines_[line].own}; }
    Place within(std::size_t line, double turned) const {
        const Line& l = lines_[line];
        const double share = std::min(1.0, 1 - (l.turned - turned) / (l.to - l.from));
        return {l.from + share * (l.to - l.from), l.mass - (1 - share) * l.own};
    }

    std::vector<Line> lines_;
};

double meanOf(std::span<const RateWindow> windows) {
    double sum = 0;
    for (const RateWindow& w : windows) sum += w.rate;
    return sum / static_cast<double>(windows.size());
}

/// Sum of the squares of the rates about their mean [kg2/s2].
double squaresOf(std::span<const RateWindow> windows) {
    const double mean = meanOf(windows);
    double sum = 0;
    for (const RateWindow& w : windows) sum += (w.rate - mean) * (w.rate - mean);
    return sum;
}

double errorOf(std::span<const RateWindow> windows) {
    const std::size_t blocks = std::min(windows.size(), kMostBlocks);
    std::vector<RateWindow> means;
    for (std::size_t b = 0; b < blocks; ++b) {
        const std::size_t from = b * windows.size() / blocks, to = (b + 1) * windows.size() / blocks;
        means.push_back({0, 0, meanOf(windows.subspan(from, to - from))});
    }
    const auto n = static_cast<double>(blocks);
    return std::sqrt(squaresOf(means) / (n - 1) / n);
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

const RateFigure* rateFigureNamed(const std::string& target) {
    for (const RateFigure& f : kFigures)
        if (target == fmt::format("{}.{}", kRateName, f.name)) return &f;
    return nullptr;
}

WindowRule windowRuleOf(const Case& c) {
    WindowRule rule;
    rule.asked = c.rateWindow;
    rule.interval = c.sensorInterval;
    const bool driven = c.world.coil || followsDrive(c.world.bodies);
    if (driven && c.schedule.coilSpeed > 0) rule.period = 2 * kPi / c.schedule.coilSpeed;
    if (driven) return rule;
    for (const RigidBody& body : c.world.bodies) rule.period = std::max(rule.period, periodOf(body.course.motion));
    return rule;
}

double windowLength(const WindowRule& rule, double turning) {
    if (rule.asked > 0) return rule.asked;
    const double least = kFewestRateIntervals * rule.interval;
    if (rule.period > 0) return roundedUpTo(rule.period, least);
    return roundedUpTo(rule.interval, std::max(turning * kTwentieth, least));
}

RateFigures rateFigures(std::span<const RateWindow> windows) {
    RateFigures f;
    if (windows.empty()) return f;
    f.mean = meanOf(windows);
    if (windows.size() < kFewestWindows) return f;
    f.error = errorOf(windows);
    const double deviation = std::sqrt(squaresOf(windows) / static_cast<double>(windows.size() - 1));
    if (f.mean > 0) f.relative = deviation / f.mean;
    return f;
}

std::optional<std::size_t> steadyFrom(std::span<const RateWindow> windows) {
    const std::size_t half = windows.size() / 2;
    if (windows.size() < kFewestForSteady || !(meanOf(windows) > 0)) return std::nullopt;
    const double rounding = kRounding * meanOf(windows);
    std::size_t best = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t d = 0; d <= half; ++d) {
        const auto rest = windows.subspan(d);
        const auto n = static_cast<double>(rest.size());
        const double squares = squaresOf(rest);
        const double judged = squares <= n * rounding * rounding ? 0 : squares / (n * n);
        if (judged >= least) continue;
        least = judged;
        best = d;
    }
    return best < half ? std::optional(best) : std::nullopt;
}

double MassRate::steadyTime() const {
    return steady ? windows[*steady].from : std::numeric_limits<double>::quiet_NaN();
}

std::string rateText(const RateFigures& f, const char* plusMinus) {
    const std::string error = std::isfinite(f.error) ? fmt::format(" {} {} g/s", plusMinus, grams(f.error)) : "";
    return fmt::format("{} g/s{}", grams(f.mean), error);
}

MassRate massRate(const std::vector<FlowSample>& samples, const WindowRule& rule) {
    MassRate r;
    const Turning turning(samples);
    if (!(turning.time() > 0)) return r;
    r.window = windowLength(rule, turning.time());
    r.windows = turning.windows(r.window);
    r.all = rateFigures(r.windows);
    r.steady = steadyFrom(r.windows);
    if (r.steady) r.steadyPart = rateFigures(std::span(r.windows).subspan(*r.steady));
    return r;
}

}  // namespace vkdose
