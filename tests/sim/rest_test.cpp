// Settling until the bed rests: when it is judged to rest, and what the run makes of it.
#include "host/sim/rest_watch.h"

#include "tests/sim/fake_backend.h"
#include "tests/support/catch.h"

using namespace vkdose;
using namespace vkdose::test;

namespace {

/// A fill of 20 mm: a fall of 64 ms that ends with 0.63 m/s, so that a bed at rest is slower than 6.3 mm/s.
Insertion fill() {
    Insertion filled;
    for (int i = 0; i < 10; ++i) filled.particles.add(Vec3(0, 0.002 * i, 0), 1e-3);
    filled.mass = filled.targetMass = 10e-3;
    return filled;
}

Case restCase() {
    Case c = smallCase();
    c.world.gravity = Vec3(0, -9.81, 0);
    c.schedule.untilRest = true;
    c.schedule.settleTime = 1;
    c.schedule.stop.maxDoses = 1;
    return c;
}

/// Makes the particles that are not dosed move at this root mean square speed [m/s].
void moveAt(Sensors& s, double speed) {
    s.kineticEnergy = 0.5 * (s.mass[0] + s.mass[1]) * speed * speed;
}

Sensors movingAt(double speed) {
    Sensors s;
    s.mass = {8e-3, 1e-3, 1e-3, 0};
    moveAt(s, speed);
    return s;
}

struct Teller : Notebook {
    std::vector<Settling> settled;
    std::vector<RunCheckpoint> kept;
    void onSettled(const Settling& s, const Case&) override { settled.push_back(s); }
    void onCheckpoint(const RunCheckpoint& c, double) override { kept.push_back(c); }
    bool storesCheckpoints() const override { return true; }
};

RunResult playFill(const Case& c, FakeBackend& backend, RunObserver& notes, const RunCheckpoint* from = nullptr) {
    const std::atomic<bool> stop{false};
    return runFilled(c, fill(), Derived{}, backend, notes, stop, from);
}

/// Slow from step `slow` on, but for a single jolt at `jolt`.
void calm(FakeBackend& backend, std::uint64_t slow, std::uint64_t jolt = 0) {
    backend.spoil = [slow, jolt](std::uint64_t step, Sensors& s) {
        moveAt(s, step >= slow && step != jolt ? 0.001 : 0.2);
    };
}

}  // namespace

TEST_CASE("the fall of a fill reaches from the top of its highest sphere to the bottom of its lowest") {
    Case c = restCase();
    const FillFall fall = fillFall(c, fill().particles);
    CHECK(fall.height == Approx(0.020));
    CHECK(fall.time == Approx(0.063855).epsilon(1e-4));
    CHECK(fall.speed == Approx(0.62642).epsilon(1e-4));
    c.schedule.settleGravityFactor = 0.25;
    CHECK(fillFall(c, fill().particles).time == Approx(2 * fall.time));
    CHECK(fillFall(c, fill().particles).speed == Approx(0.5 * fall.speed));
    c.world.gravity = Vec3(-9.81, 0, 0);  // across the row of spheres
    CHECK(fillFall(c, fill().particles).height == Approx(0.002));
    c.world.gravity = Vec3(0);
    CHECK(fillFall(c, fill().particles).speed == 0);
}

TEST_CASE("the mean speed leaves out what is dosed") {
    CHECK(meanSpeed(movingAt(0.3)) == Approx(0.3));
    CHECK(meanSpeed(Sensors{}) == 0);
}

TEST_CASE("a bed rests when it has been slow for the time of the fall, and not before") {
    RestWatch watch(restCase(), fill().particles);  // 64 steps of 1 ms
    CHECK_FALSE(watch.rests(movingAt(0.1), 30));
    CHECK_FALSE(watch.rests(movingAt(0.006), 60));
    CHECK_FALSE(watch.rests(movingAt(0.0065), 90));  // faster than 1 % of the fall: it begins anew
    CHECK_FALSE(watch.rests(movingAt(0.006), 120));
    CHECK_FALSE(watch.rests(movingAt(0.006), 180));
    CHECK(watch.rests(movingAt(0.006), 184));
    CHECK_FALSE(watch.rests(movingAt(std::numeric_limits<double>::quiet_NaN()), 200));
}

TEST_CASE("settling until at rest ends at the sample that finds the bed at rest, and the doses follow") {
    FakeBackend backend;
    calm(backend, 200, 270);
    backend.dosed = [](std::uint64_t step) { return step < 200 ? 0 : step < 400 ? 2 : 5; };
    Teller notes;
    const RunResult r = playFill(restCase(), backend, notes);
    // Slow at 210 and 240, jolted at 270, slow from 300 on: 64 steps later is the sample at 390.
    REQUIRE(r.settling);
    CHECK(r.settling->step == 390);
    CHECK(r.settling->time == Approx(0.39));
    CHECK(r.settling->atRest);
    CHECK(r.settling->speed == Approx(0.001));
    CHECK(r.settling->spilled == Approx(2e-3));
    REQUIRE(r.settled);
    CHECK(r.settled->time == Approx(0.39));
    REQUIRE(notes.settled.size() == 1);
    REQUIRE(r.doses.size() == 1);
    CHECK(r.doses[0].startTime == Approx(0.39));
    CHECK(r.doses[0].mass == Approx(3e-3));  // without what fell out before
    CHECK(r.doses[0].cumulative == Approx(5e-3));
    CHECK(r.dosedWhileSettling == Approx(2e-3));
    CHECK(backend.step == 390 + 70);
    for (const FakeBackend::Call& call : backend.calls) CHECK(call.kc == (call.firstStep < 390 ? 3 : 7));
    CHECK_THAT(settlingSentence(*r.settling, restCase()),
               Catch::StartsWith("at rest at t = 0.39 s") && Catch::Contains("2.000 g"));
}

TEST_CASE("a bed that never rests doses after the longest time, and that is told") {
    FakeBackend backend;
    calm(backend, 100000);
    Teller notes;
    const RunResult r = playFill(restCase(), backend, notes);
    REQUIRE(r.settling);
    CHECK(r.settling->step == 1000);
    CHECK_FALSE(r.settling->atRest);
    CHECK(r.doses.size() == 1);
    CHECK_THAT(settlingSentence(*r.settling, restCase()),
               Catch::Contains("longest time is over") && Catch::Contains("not at rest") && Catch::Contains("32 %"));
}

TEST_CASE("powder that a body or an inlet moves is not told as a bed that should rest") {
    Case c = restCase();
    c.schedule.untilRest = false;
    const Settling s{1000, false, 1.0, 0.04, 1.0, 0};
    const std::string bed =
        "not at rest at t = 1 s (speed 4 % of that after a fall from the fill's top; at rest it is below 1 %)";
    CHECK(settlingSentence(s, c) == bed);
    RigidBody belt;
    belt.name = "belt";
    belt.course.motion = geometry::Slide{Vec3(0, 0, 0.06)};
    c.world.bodies = {belt};
    CHECK(settlingSentence(s, c) ==
          "not at rest at t = 1 s, as body \"belt\" moves (speed 4 % of that after a fall from the fill's top)");
    c.schedule.untilRest = true;
    CHECK_THAT(
        settlingSentence(s, c),
        Catch::StartsWith("the longest time is over, and the bed is not at rest at t = 1 s, as body \"belt\" moves"));
    c.schedule.untilRest = false;
    c.world.bodies[0].course.schedule.intervals = {{0.2, 0.9}};  // a cylinder that was lifted: the heap should rest
    CHECK(settlingSentence(s, c) == bed);
    c.world.bodies[0].course.schedule.intervals = {{0.2, 1.0}};
    CHECK_THAT(settlingSentence(s, c), Catch::Contains("\"belt\" moves"));
    c.world.bodies[0].course.schedule.intervals.clear();
    c.world.bodies[0].clock = Clock::Drive;  // it stands while powder settles
    CHECK(settlingSentence(s, c) == bed);
    c.world.bodies[0].clock = Clock::Phases;
    c.world.bodies[0].phases = {Phase::Rotate};
    CHECK(settlingSentence(s, c) == bed);
    c.world.bodies[0].phases = {Phase::Settle, Phase::Rotate};
    CHECK_THAT(settlingSentence(s, c), Catch::Contains("\"belt\" moves"));
    c.world.bodies.clear();
    c.refills.resize(1);
    c.refills[0].time = 0.95;  // it falls for 0.1 s
    CHECK_THAT(settlingSentence(s, c), Catch::StartsWith("not at rest at t = 1 s, as powder comes in (speed 4 %"));
    c.refills[0].time = 0.5;
    CHECK(settlingSentence(s, c) == bed);
}

TEST_CASE("without until_rest a bed at rest changes no step of the schedule") {
    Case c = restCase();
    c.schedule.untilRest = false;
    FakeBackend backend;
    calm(backend, 200);
    Teller notes;
    const RunResult r = playFill(c, backend, notes);
    REQUIRE(r.settling);
    CHECK(r.settling->step == 1000);
    CHECK(r.settling->atRest);
    CHECK(r.doses.at(0).startTime == Approx(1));
}

TEST_CASE("a run without doses ends when its bed rests, with a frame of that time") {
    Case c = restCase();
    c.schedule.rotateTime = c.schedule.restTime = 0;
    c.frames.interval = 0.3;
    FakeBackend backend;
    calm(backend, 200);
    Teller notes;
    const RunResult r = playFill(c, backend, notes);
    CHECK(r.reason == StopReason::Settled);
    CHECK(r.last.step == 300);  // slow from the sample at 210 on
    REQUIRE(notes.frames.size() == 2);
    CHECK(notes.frames.back().step == 300);
}

TEST_CASE("a run that goes on from a checkpoint finds its bed at rest at the same step") {
    Case c = restCase();
    c.checkpoint.simulated = 0.03;
    FakeBackend backend;
    calm(backend, 200);
    Teller notes;
    const RunResult whole = playFill(c, backend, notes);
    REQUIRE(notes.kept.size() > 10);
    for (const RunCheckpoint& from : notes.kept) {
        FakeBackend again;
        again.spoil = backend.spoil;
        Teller rest;
        const RunResult r = playFill(c, again, rest, &from);
        CHECK(again.step == backend.step);
        REQUIRE(r.settling);
        CHECK(r.settling->step == whole.settling->step);
        CHECK(r.settling->atRest);
        CHECK(r.doses.at(0).startTime == whole.doses.at(0).startTime);
    }
}
