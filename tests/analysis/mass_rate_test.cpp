// Rates by hand: constant, with a start-up, pulsating.
#include "host/analysis/mass_rate.h"

#include <cmath>
#include <functional>
#include <numbers>

#include "tests/support/catch.h"
#include "tests/support/near.h"

using namespace vkdose;
using vkdose::test::near;
using vkdose::test::Verdict;

namespace {

constexpr double kInterval = 0.01;  // of the sensors [s]
constexpr double kRate = 2e-3;      // [kg/s]
constexpr WindowRule kTenthSecond{0.1, 0, kInterval};

/// The lines of a run that turns from the first one on; `dosed(t)` is the mass that is out [kg].
std::vector<FlowSample> turning(double time, const std::function<double(double)>& dosed) {
    std::vector<FlowSample> samples;
    for (int i = 1; i * kInterval < time + kInterval / 2; ++i) {
        FlowSample s;
        s.time = i * kInterval;
        s.turning = true;
        s.dose = 1;
        s.dosed = dosed(s.time);
        s.inside = 1;
        samples.push_back(s);
    }
    return samples;
}

double evenly(double t) {
    return kRate * t;
}

/// Sums of lines: rounding.
Verdict sameRate(double a, double b) {
    return near(a, b, kRate, 1e-9);
}

}  // namespace

TEST_CASE("a constant rate has its mean, no scatter and no start-up") {
    const MassRate r = massRate(turning(2.05, evenly), kTenthSecond);
    CHECK(r.window == 0.1);
    REQUIRE(r.windows.size() == 20);  // half a window is left over
    CHECK(sameRate(r.all.mean, kRate));
    CHECK(sameRate(r.all.error, 0));
    CHECK(near(r.all.relative, 0, 1, 1e-9));
    CHECK(r.steady == 0);
    CHECK(r.steadyTime() == 0);
    CHECK(sameRate(r.steadyPart.mean, kRate));
}

TEST_CASE("a last window that lacks up to a hundredth counts, over the time that it has") {
    std::vector<FlowSample> samples = turning(1.99, evenly);
    FlowSample last = samples.back();
    last.time = 1.9991;
    last.dosed = evenly(last.time);
    samples.push_back(last);
    const MassRate r = massRate(samples, kTenthSecond);
    REQUIRE(r.windows.size() == 20);
    CHECK(r.windows.back().to == 1.9991);
    CHECK(sameRate(r.windows.back().rate, kRate));
    samples.back().time = 1.9989;
    CHECK(massRate(samples, kTenthSecond).windows.size() == 19);
}

TEST_CASE("MSER-5 cuts where a start-up ends, and the steady part has its own figures") {
    // The rate rises for 0.4 s. From there windows of 0.95 and 1.05 of the rate take turns.
    constexpr double kRamp = 0.4;
    const auto dosed = [](double t) {
        if (t < kRamp) return kRate * t * t / (2 * kRamp);
        const double half = std::floor((t - kRamp) / 0.1 + 1e-9), part = t - kRamp - 0.1 * half;
        const double low = std::fmod(half, 2) == 0 ? 0.95 : 1.05;
        return kRate * (kRamp / 2 + 0.1 * (half - 0.05 * std::fmod(half, 2)) + low * part);
    };
    const MassRate r = massRate(turning(2, dosed), kTenthSecond);
    REQUIRE(r.windows.size() == 20);
    CHECK(sameRate(r.windows[0].rate, kRate / 8));
    CHECK(sameRate(r.windows[3].rate, kRate * 7 / 8));
    CHECK(sameRate(r.windows[4].rate, kRate * 0.95));
    REQUIRE(r.steady == 4);
    CHECK(near(r.steadyTime(), kRamp, kInterval, 1e-9));
    CHECK(sameRate(r.steadyPart.mean, kRate));
    CHECK(near(r.steadyPart.relative, 0.05 * std::sqrt(16.0 / 15), 0.05, 1e-9));
    CHECK(sameRate(r.all.mean, kRate * 0.9));  // 0.2 + 1.6 s of the rate, in 2 s
    CHECK(r.all.relative > 4 * r.steadyPart.relative);
}

TEST_CASE("a rate that pulsates with the drive has no scatter over whole turns") {
    constexpr double kTurn = 0.25;
    const auto dosed = [](double t) {
        const double w = 2 * std::numbers::pi / kTurn;
        return kRate * (t + 0.8 * (1 - std::cos(w * t)) / w);
    };
    const MassRate r = massRate(turning(3, dosed), {0, kTurn, kInterval});
    CHECK(r.window == kTurn);
    CHECK(r.windows.size() == 12);
    CHECK(near(r.all.relative, 0, 1, 1e-9));
    CHECK(r.steady == 0);
    // Two and a half windows a turn see the pulsation.
    CHECK(massRate(turning(3, dosed), kTenthSecond).all.relative > 0.1);
}

TEST_CASE("a window is asked for, a turn, or a twentieth of the time, and no shorter than five sensor intervals") {
    CHECK(windowLength({0.3, 0.25, kInterval}, 10) == 0.3);
    CHECK(windowLength({0, 0.25, kInterval}, 10) == 0.25);
    CHECK(near(windowLength({0, 0, kInterval}, 10), 0.5, kInterval, 1e-9));
    CHECK(near(windowLength({0, 0.02, kInterval}, 10), 0.06, kInterval, 1e-9));  // three whole periods
    CHECK(near(windowLength({0, 0, kInterval}, 0.5), 0.05, kInterval, 1e-9));
    CHECK(near(windowLength({0, 0, kInterval}, 1.03), 0.06, kInterval, 1e-9));  // whole intervals
}

TEST_CASE("rests are no part of the time, nor is what falls in them part of the mass") {
    // A second of turning at the rate, half a second of rest in which a gram falls, a second of turning.
    std::vector<FlowSample> samples = turning(1, evenly), again = turning(1, evenly);
    FlowSample rest = samples.back();
    rest.turning = false;
    rest.time += 0.5;
    rest.dosed += 1e-3;
    samples.push_back(rest);
    for (FlowSample& s : again) {
        s.time += rest.time;
        s.dosed += rest.dosed;
        s.dose = 2;
        samples.push_back(s);
    }
    const MassRate r = massRate(samples, {0.4, 0, kInterval});
    REQUIRE(r.windows.size() == 5);
    CHECK(sameRate(r.all.mean, kRate));
    CHECK(near(r.all.relative, 0, 1, 1e-9));
    // The third lies around the rest.
    CHECK(near(r.windows[2].from, 0.8, kInterval, 1e-9));
    CHECK(near(r.windows[2].to, 1.7, kInterval, 1e-9));
    // One that begins when the rest ends begins behind it.
    const MassRate halves = massRate(samples, {0.5, 0, kInterval});
    REQUIRE(halves.windows.size() == 4);
    CHECK(near(halves.windows[1].to, 1, kInterval, 1e-9));
    CHECK(near(halves.windows[2].from, 1.5, kInterval, 1e-9));
}

TEST_CASE("an empty device has no rate, until it is filled again") {
    // Empty after a second; a second later powder comes in.
    std::vector<FlowSample> samples =
        turning(3, [](double t) { return kRate * (std::min(t, 1.0) + std::max(t - 2, 0.0)); });
    for (FlowSample& s : samples) s.inside = s.time > 0.995 && s.time < 1.995 ? 0 : 1;
    const MassRate r = massRate(samples, kTenthSecond);
    CHECK(r.windows.size() == 20);
    CHECK(sameRate(r.all.mean, kRate));
    CHECK(near(r.all.relative, 0, 1, 1e-9));
    CHECK(near(r.windows.back().to, 3, kInterval, 1e-9));
}

TEST_CASE("a window that ends within a line has its share of the line's mass") {
    // Lines 2, 4, 6 ... give a milligram each. Windows are five lines and a half long.
    const auto dosed = [](double t) { return 1e-6 * std::floor(std::round(t / kInterval) / 2); };
    const MassRate r = massRate(turning(0.22, dosed), {0.055, 0, kInterval});
    REQUIRE(r.windows.size() == 4);
    CHECK(near(r.windows[0].rate * r.window, 2.5e-6, 1e-6, 1e-9));  // 2, 4 and half of 6
    CHECK(near(r.windows[1].rate * r.window, 2.5e-6, 1e-6, 1e-9));  // the other half, 8, 10
    CHECK(near(r.windows[2].rate * r.window, 3e-6, 1e-6, 1e-9));    // 12, 14, 16 and half of 17, which has none
    CHECK(near(r.windows[0].to, 0.055, kInterval, 1e-9));
}

TEST_CASE("what was out before the drive turned is no rate, nor is the time before") {
    std::vector<FlowSample> samples = turning(1, evenly);
    FlowSample state;  // of another run, or of the settling
    state.time = 7;
    state.dosed = 0.5;
    state.inside = 1;
    for (FlowSample& s : samples) {
        s.time += state.time;
        s.dosed += state.dosed;
    }
    samples.insert(samples.begin(), state);
    const MassRate r = massRate(samples, kTenthSecond);
    CHECK(r.windows.size() == 10);
    CHECK(sameRate(r.all.mean, kRate));
    CHECK(near(r.windows.front().from, 7, kInterval, 1e-9));
}

TEST_CASE("a run without doses has the rate of all its time, if anything came out") {
    std::vector<FlowSample> samples = turning(2, evenly);
    for (FlowSample& s : samples) s.turning = false;
    CHECK(massRate(samples, kTenthSecond).windows.empty());
    const WindowRule always{0.1, 0, kInterval, 0.0};
    const MassRate r = massRate(samples, always);
    CHECK(r.windows.size() == 20);
    CHECK(sameRate(r.all.mean, kRate));
    for (FlowSample& s : samples) s.dosed = 0;
    CHECK(std::isnan(massRate(samples, always).all.mean));
    Case c;
    CHECK(windowRuleOf(c).from == 0.0);
    c.schedule.rotateTime = 1;
    CHECK_FALSE(windowRuleOf(c).from);
}

TEST_CASE("too few windows have no figures") {
    CHECK(std::isnan(massRate({}, kTenthSecond).window));
    CHECK(std::isnan(massRate(std::vector<FlowSample>(3), kTenthSecond).all.mean));  // nothing turns
    const MassRate none = massRate(turning(0.05, evenly), kTenthSecond);
    CHECK(none.window == 0.1);
    CHECK(none.windows.empty());
    CHECK(std::isnan(none.all.mean));
    const MassRate four = massRate(turning(0.4, evenly), kTenthSecond);
    CHECK(sameRate(four.all.mean, kRate));
    CHECK(std::isnan(four.all.error));
    CHECK(std::isnan(four.all.relative));
    const MassRate nine = massRate(turning(0.9, evenly), kTenthSecond);
    CHECK(std::isfinite(nine.all.relative));
    CHECK_FALSE(nine.steady);
    CHECK(std::isnan(nine.steadyTime()));
    CHECK(std::isnan(nine.steadyPart.mean));
}

TEST_CASE("a rate that never comes to rest has no steady part, nothing at all has no RSD") {
    const MassRate rising = massRate(turning(2, [](double t) { return kRate * t * t; }), kTenthSecond);
    CHECK(rising.windows.size() == 20);
    CHECK_FALSE(rising.steady);
    const MassRate nothing = massRate(turning(2, [](double) { return 0; }), kTenthSecond);
    CHECK(nothing.all.mean == 0);
    CHECK(nothing.all.error == 0);
    CHECK(std::isnan(nothing.all.relative));
    CHECK_FALSE(nothing.steady);
}

TEST_CASE("the error is that of the means of ten blocks") {
    // Twenty windows in pairs of equal ones: blocks of 1 and 3, whose means deviate by 1.
    std::vector<double> rates;
    for (int i = 0; i < 20; ++i) rates.push_back(i / 2 % 2 == 0 ? 1 : 3);
    const SeriesFigures f = seriesFigures(rates);
    CHECK(f.mean == 2);
    CHECK(near(f.error, std::sqrt(10.0 / 9 / 10), 1, 1e-12));
    CHECK(near(f.relative, std::sqrt(20.0 / 19) / 2, 1, 1e-12));
    // Windows that take turns are even in blocks of two.
    for (int i = 0; i < 20; ++i) rates[std::size_t(i)] = i % 2 == 0 ? 1 : 3;
    CHECK(seriesFigures(rates).error == 0);
}

TEST_CASE("the period of a case is a turn of its drive, else that of its slowest body") {
    Case c;
    c.sensorInterval = kInterval;
    CHECK(windowRuleOf(c).period == 0);
    RigidBody tray;
    tray.course.motion = geometry::Shake{{0, 0, 1}, 1e-3, 25, 0};
    RigidBody stirrer;
    stirrer.course.motion = geometry::Turn{{0, 1, 0}, {}, -std::numbers::pi};
    c.world.bodies = {tray, stirrer};
    CHECK(near(windowRuleOf(c).period, 2, kInterval, 1e-12));
    c.schedule.coilSpeed = 8 * std::numbers::pi;
    CHECK(near(windowRuleOf(c).period, 2, kInterval, 1e-12));  // a speed that nothing follows
    c.world.bodies[1].clock = Clock::Drive;
    CHECK(near(windowRuleOf(c).period, 0.25, kInterval, 1e-12));
    c.rateWindow = 0.7;
    CHECK(windowRuleOf(c).asked == 0.7);
    CHECK(windowRuleOf(c).interval == kInterval);
}
