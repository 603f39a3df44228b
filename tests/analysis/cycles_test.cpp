// The mass of turns, pockets and strokes, by hand.
#include "host/analysis/cycles.h"

#include <cmath>
#include <functional>

#include "tests/support/catch.h"
#include "tests/support/near.h"

using namespace vkdose;
using vkdose::test::near;

namespace {

constexpr double kInterval = 0.01;  // of the sensors [s]
constexpr double kRate = 2e-3;      // [kg/s]
constexpr double kFill = 0.1;       // [kg]
constexpr double kSpeed = 4 * kPi;  // of the drive: a turn in half a second [rad/s]

const CycleRule kTurns{"turn of the drive", TurningFlow::By::Angle, 2 * kPi, 0.5, kInterval};

/// The lines of a run that turns from the first one on; `dosed(t)` is the mass that is out [kg].
std::vector<FlowSample> turning(double time, const std::function<double(double)>& dosed, double speed = kSpeed) {
    std::vector<FlowSample> samples;
    for (int i = 1; i * kInterval < time + kInterval / 2; ++i) {
        const double t = i * kInterval;
        samples.push_back({t, true, 1, -speed * t, dosed(t), kFill - dosed(t)});
    }
    return samples;
}

double evenly(double t) {
    return kRate * t;
}

bool sameMass(double a, double b) {
    return bool(near(a, b, kRate, 1e-9));
}

}  // namespace

TEST_CASE("each turn of the drive has its mass, and what was left when it began") {
    // In each second a quarter of what is left comes out: the feed factor falls with the fill.
    const auto dosed = [](double t) { return kFill * (1 - std::exp(-t / 4)); };
    const Cycles c = cyclesOf(turning(10, dosed), kTurns);
    CHECK(c.what == "turn of the drive");
    REQUIRE(c.list.size() == 20);
    for (const CycleMass& cycle : c.list) {
        const double start = 0.5 * (cycle.number - 1);
        CAPTURE(cycle.number);
        CHECK(near(cycle.start, start, 0.5, 1e-9));
        CHECK(near(cycle.end, start + 0.5, 0.5, 1e-9));
        CHECK(sameMass(cycle.left, kFill * std::exp(-start / 4)));
        CHECK(sameMass(cycle.mass, cycle.left * (1 - std::exp(-0.125))));
    }
    CHECK(sameMass(c.all.mean, dosed(10) / 20));
    CHECK_FALSE(c.steady);  // it falls to the end
}

TEST_CASE("turns are counted by the angle, whatever the speed, over rests and refills") {
    // A turn at one speed, a rest of a second in which a gram falls and ten are filled in, half a turn at half the
    // speed, and so on.
    std::vector<FlowSample> samples;
    double time = 0, angle = 0, out = 0, inside = kFill;
    const auto turn = [&](double turns, double speed) {
        const int lines = int(std::round(2 * kPi * turns / speed / kInterval));
        for (int i = 0; i < lines; ++i) {
            time += kInterval;
            angle -= speed * kInterval;
            const double mass = 1e-3 * speed * kInterval / (2 * kPi);  // a gram in a turn
            out += mass;
            inside -= mass;
            samples.push_back({time, true, 1, angle, out, inside});
        }
    };
    const auto rest = [&] {
        time += 1;
        out += 1e-3;
        inside += 9e-3;
        samples.push_back({time, false, 1, angle, out, inside});
    };
    turn(1, kSpeed);
    rest();
    turn(0.5, kSpeed / 2);
    rest();
    turn(1.5, kSpeed);
    const Cycles c = cyclesOf(samples, kTurns);
    REQUIRE(c.list.size() == 3);
    for (const CycleMass& cycle : c.list) CHECK(sameMass(cycle.mass, 1e-3));
    CHECK(near(c.list[0].end, 0.5, 1, 1e-9));
    CHECK(near(c.list[1].start, 1.5, 1, 1e-9));  // behind the rest
    CHECK(near(c.list[1].end, 3.25, 1, 1e-9));   // half a second, a second of rest, a quarter of a second
    CHECK(sameMass(c.list[1].left, kFill - 1e-3 + 9e-3));
    CHECK(sameMass(c.list[2].left, kFill - 2e-3 + 18e-3));
}

TEST_CASE("a refill within the rotation counts to what is left from its line on") {
    std::vector<FlowSample> samples = turning(1, evenly);
    for (std::size_t i = 50; i < samples.size(); ++i) samples[i].inside += 0.05;  // at 0.5 s, seen at 0.51 s
    const Cycles c = cyclesOf(samples, kTurns);
    REQUIRE(c.list.size() == 2);
    CHECK(sameMass(c.list[0].mass, c.list[1].mass));
    CHECK(sameMass(c.list[1].left, kFill - evenly(0.5) + 0.05));
}

TEST_CASE("pockets take turns, and only whole cycles count") {
    // Four pockets a turn; the second of each four is half full.
    const auto dosed = [](double t) {
        const double pockets = t / 0.125, whole = std::floor(pockets + 1e-9), turns = std::floor(whole / 4);
        const double part = pockets - whole, in = whole - 4 * turns;
        const double before = in <= 1 ? in : in - 0.5, own = in == 1 ? 0.5 : 1;
        return 1e-3 * (3.5 * turns + before + own * part);
    };
    const CycleRule rule{"pocket of wheel", TurningFlow::By::Angle, kPi / 2, 0.125, kInterval};
    const Cycles c = cyclesOf(turning(4.04, dosed), rule);
    REQUIRE(c.list.size() == 32);
    // The ends of pockets lie within lines, where the mass of a line is taken as even.
    CHECK(near(c.list[4].mass, 1e-3, 1e-3, 0.03));
    CHECK(near(c.list[5].mass, 0.5e-3, 1e-3, 0.05));
    CHECK(near(c.all.mean, 0.875e-3, 1e-3, 1e-3));
    CHECK(near(c.all.relative, 0.2165 / 0.875 * std::sqrt(32.0 / 31), 1, 0.02));
    REQUIRE(c.steady);
    CHECK(c.steadyTime() == c.list[*c.steady].start);
}

TEST_CASE("in a run without doses all cycles count, if anything comes out") {
    std::vector<FlowSample> samples = turning(2, evenly);
    for (FlowSample& s : samples) s.turning = false;
    CycleRule rule{"stroke of tray", TurningFlow::By::Time, 0.1, 0.1, kInterval};
    CHECK(cyclesOf(samples, rule).list.empty());
    rule.from = 0.0;
    const Cycles c = cyclesOf(samples, rule);
    CHECK(c.list.size() == 20);
    rule.from = 0.5;  // the tray stood before
    CHECK(cyclesOf(samples, rule).list.size() == 15);
    CHECK(near(cyclesOf(samples, rule).list.front().start, 0.5, 1, 1e-9));
    CHECK(sameMass(c.all.mean, kRate * 0.1));
    for (FlowSample& s : samples) s.dosed = 0;
    CHECK(cyclesOf(samples, rule).list.empty());
}

TEST_CASE("a cycle that the sensors cannot tell has no mass") {
    const auto cycles = [&](double period) {
        return cyclesOf(turning(2, evenly), {"stroke of tray", TurningFlow::By::Time, period, period, kInterval});
    };
    CHECK(cycles(0.05).list.size() == 40);
    CHECK(cycles(0.02).list.size() == 100);  // two whole intervals
    CHECK(cycles(0.01).list.size() == 200);
    CHECK(sameMass(cycles(0.01).all.mean, kRate * 0.01));
    CHECK(cycles(0.025).list.empty());
    CHECK(cycles(0.025).what == "stroke of tray");
    CHECK(cycles(0.005).list.empty());
    CHECK(std::isnan(cycles(0.025).all.mean));
    CHECK(cyclesOf({}, kTurns).list.empty());
    CHECK(cyclesOf(turning(2, evenly), {}).list.empty());
}

TEST_CASE("a cycle is a pocket, else a turn of the drive, else the slowest motion of a body") {
    Case c;
    c.sensorInterval = kInterval;
    CHECK(cycleRuleOf(c).what.empty());
    RigidBody tray, wheel;
    tray.name = "tray";
    tray.course.motion = geometry::Shake{{0, 0, 1}, 1e-3, 25, 0};
    wheel.name = "wheel";
    wheel.course.motion = geometry::Turn{{0, 1, 0}, {}, -kPi};
    c.world.bodies = {tray};
    CHECK(cycleRuleOf(c).from == 0.0);
    c.world.bodies[0].course.schedule.intervals = {{0.5, geometry::kEndless}};
    CHECK(cycleRuleOf(c).from == 0.5);
    c.world.bodies.push_back(wheel);  // it moves from the start
    CHECK(cycleRuleOf(c).from == 0.0);
    c.world.bodies[1].course.schedule.intervals = {{0.2, 0.3}};
    CHECK(cycleRuleOf(c).from == 0.2);
    c.world.bodies[1].clock = Clock::Forces;  // nobody knows when it moves
    CHECK(cycleRuleOf(c).from == 0.0);
    c.world.bodies = {tray};
    c.schedule.rotateTime = 1;
    CHECK_FALSE(cycleRuleOf(c).from);
    CHECK(cycleRuleOf(c).what == "stroke of tray");
    CHECK(near(cycleRuleOf(c).length, 0.04, 1, 1e-12));
    c.world.bodies = {tray, wheel};
    CHECK(cycleRuleOf(c).what == "turn of wheel");
    c.world.bodies[1].pockets = 8;
    CHECK(cycleRuleOf(c).what == "pocket of wheel");
    CHECK(near(cycleRuleOf(c).length, 0.25, 1, 1e-12));
    // By the drive, of which it makes half a turn in each.
    c.world.bodies[1].clock = Clock::Drive;
    std::get<geometry::Turn>(c.world.bodies[1].course.motion).rate = 0.5;
    CHECK(cycleRuleOf(c).what.empty());  // a drive without a speed, and a tray beside it
    c.schedule.coilSpeed = kSpeed;
    CHECK(cycleRuleOf(c).by == TurningFlow::By::Angle);
    CHECK(near(cycleRuleOf(c).length, kPi / 2, 1, 1e-12));
    CHECK(near(cycleRuleOf(c).period, 0.125, 1, 1e-12));
    c.world.bodies[1].pockets = 0;
    CHECK(cycleRuleOf(c).what == "turn of the drive");
    CHECK(near(cycleRuleOf(c).length, 2 * kPi, 1, 1e-12));
}

TEST_CASE("a body that tips between two stops has a cycle from tip to tip") {
    Case c;
    RigidBody flap, bucket;
    flap.course.motion = geometry::Hinge{};  // it swings freely: nothing tells one of its swings from another
    bucket.name = "bucket";
    geometry::Hinge hinge;
    hinge.low = -2;
    hinge.high = 0;
    bucket.course.motion = hinge;
    flap.clock = bucket.clock = Clock::Forces;
    c.world.bodies = {flap};
    CHECK(cycleRuleOf(c).what.empty());
    c.world.bodies.push_back(bucket);
    const CycleRule rule = cycleRuleOf(c);
    CHECK(rule.what == "tip of bucket");
    REQUIRE(rule.tips);
    CHECK(rule.tips->hinge == 1);
    CHECK(rule.tips->far == -2);

    // It trembles, tips at 0.5 s, 1.4 s and 2.6 s, and each time 3, 4 and 5 g come out while it is over. At a bounce on
    // its way back it goes over the middle again.
    std::vector<FlowSample> samples;
    double out = 0;
    const auto line = [&](double angle, double mass) {
        out += mass;
        samples.push_back({kInterval * double(samples.size() + 1), false, 0, 0, out, kFill - out, {0.3, angle}});
    };
    double mass = 3e-3;
    for (const double start : {0.5, 1.4, 2.6}) {
        while (kInterval * double(samples.size()) < start - kInterval / 2)
            line(samples.size() % 20 == 7 ? -0.4 : 0, samples.size() % 20 == 9 ? 1e-5 : 0);
        for (const double angle : {-0.3, -0.9, -1.6, -2.0, -1.1, -0.9, -1.2, -0.5}) line(angle, mass / 8);
        mass += 1e-3;
    }
    const Cycles cycles = cyclesOf(samples, rule);
    CHECK(cycles.what == "tip of bucket");
    REQUIRE(cycles.list.size() == 2);
    CHECK(near(cycles.list[0].start, 0.5, 1, 1e-9));
    CHECK(near(cycles.list[0].end, 1.4, 1, 1e-9));
    CHECK(near(cycles.list[1].end, 2.6, 1, 1e-9));
    CHECK(near(cycles.list[0].mass, 3e-3, 1e-3, 0.05));  // and what fell past it
    CHECK(near(cycles.list[1].mass, 4e-3, 1e-3, 0.07));
    CHECK(sameMass(cycles.list[0].left, kFill - samples[49].dosed));
    CHECK(sameMass(cycles.all.mean, (cycles.list[0].mass + cycles.list[1].mass) / 2));
}

TEST_CASE("the angle of each hinge comes from the time series") {
    Table series({"time_s", "phase", "dose", "coil_angle_rad", "dosed_mass_kg", "canister_mass_kg", "throat_mass_kg",
                  "flap.angle_rad", "bucket.angle_rad"});
    series.add({"0.1", "settle", "0", "0", "0", "1", "0", "0.25", "-2"});
    const auto samples = flowSamples(series);
    REQUIRE(samples.size() == 1);
    CHECK(samples[0].hinges == std::vector<double>{0.25, -2});
}
