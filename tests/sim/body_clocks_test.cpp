// Bodies that move in phases of the schedule: for which time each has moved, against the phases counted by hand.

#include "host/sim/body_clocks.h"

#include "tests/sim/fake_backend.h"
#include "tests/support/catch.h"

using namespace vkdose;
using namespace vkdose::test;

namespace {

RigidBody inPhases(const char* name, geometry::Motion motion, std::vector<Phase> phases, bool anew = false) {
    RigidBody body;
    body.name = name;
    body.shapes = {geometry::Ball{Vec3(0), 1e-3}};
    body.course.motion = std::move(motion);
    body.clock = Clock::Phases;
    body.phases = std::move(phases);
    body.anew = anew;
    return body;
}

/// A flap that opens and closes in `duration` [s].
geometry::Table flap(double duration) {
    return {Vec3(1, 0, 0), Vec3(0), {{0, 0, Vec3(0)}, {duration / 2, 1, Vec3(0)}, {duration, 0, Vec3(0)}}};
}

enum Body : std::size_t { kAlways, kStirrer, kTapper, kFlap };

/// Settles 100 steps, then rotates 50 and rests 20 in each of three doses; a frame every 10 steps of a millisecond.
Case phasedCase(double flapDuration) {
    Case c = smallCase();
    c.sensorInterval = 0.01;
    c.frames.interval = 0.01;
    RigidBody always = inPhases("always", geometry::Slide{Vec3(1, 0, 0)}, {});
    always.clock = Clock::Time;
    c.world.bodies = {always, inPhases("stirrer", geometry::Turn{Vec3(0, 0, 1), Vec3(0), 3.0}, {Phase::Rotate}),
                      inPhases("tapper", geometry::Shake{Vec3(0, 1, 0), 1e-3, 40, 0.3}, {Phase::Settle}),
                      inPhases("flap", flap(flapDuration), {Phase::Rotate, Phase::Reverse, Phase::Rest}, true)};
    return c;
}

/// Steps in rotation before the end of step `n` of the plan.
std::uint64_t rotating(std::uint64_t n) {
    return n < 100 ? 0 : 50 * ((n - 100) / 70) + std::min<std::uint64_t>(50, (n - 100) % 70);
}

double secondsOf(std::uint64_t steps) {
    return double(steps) * 1e-3;
}

}  // namespace

TEST_CASE("bodies move in their phases, and stand in all others") {
    const Case c = phasedCase(0.07);
    FakeBackend backend;
    Notebook notes;
    const RunResult r = play(c, backend, notes);
    REQUIRE(notes.frames.size() > 30);
    for (const Frame& f : notes.frames) {
        CAPTURE(f.step);
        REQUIRE(f.bodiesMoved.size() == 4);
        CHECK(f.movedOf(kAlways) == 0);
        CHECK(f.movedOf(kStirrer) == secondsOf(rotating(f.step)));
        CHECK(f.movedOf(kTapper) == secondsOf(std::min<std::uint64_t>(f.step, 100)));
        // The flap's table is as long as a dose, and begins with it. At the end of a dose it is closed.
        const std::uint64_t inDose = f.step <= 100 ? 0 : (f.step - 101) % 70 + 1;
        CHECK(f.movedOf(kFlap) == secondsOf(inDose));

        const auto poseOf = [&](Body b) { return c.world.bodies[b].pose(f.time, f.coilAngle, f.movedOf(b)); };
        const double turned = 3.0 * secondsOf(rotating(f.step));
        CHECK(std::abs(poseOf(kStirrer).toWorld(Vec3(1, 0, 0)).x - std::cos(turned)) < 1e-12);
        const double shaken = 1e-3 * std::sin(2 * kPi * 40 * secondsOf(std::min<std::uint64_t>(f.step, 100)) + 0.3);
        CHECK(std::abs(poseOf(kTapper).origin.y - shaken) < 1e-12);
        const double open = inDose <= 35 ? double(inDose) / 35 : 2 - double(inDose) / 35;
        CHECK(std::abs(poseOf(kFlap).toWorld(Vec3(0, 1, 0)).y - std::cos(open)) < 1e-12);
        CHECK(std::abs(poseOf(kAlways).origin.x - f.time) < 1e-12);
    }
    CHECK(r.bodiesMoved == notes.frames.back().bodiesMoved);
    // The backend was told before each of its calls, and counts as the run does.
    std::vector<BodyClock> last = backend.clocks;
    advanceClocks(last, backend.calls.back().steps);
    CHECK(last.at(kStirrer).steps == 150);
    CHECK(last.at(kFlap).steps == 70);
}

TEST_CASE("a table that is longer than its phases comes to its end before it starts anew, without a jump") {
    FakeBackend backend;
    Notebook notes;
    play(phasedCase(0.1), backend, notes);
    for (const Frame& f : notes.frames) {
        CAPTURE(f.step);
        // It begins at 100, is at 70 of 100 when the second dose begins at 170, at its end at 200 and starts anew
        // there; at 240, where the third begins, it is at 40, and it starts anew at 300.
        const std::uint64_t at = f.step <= 100  ? 0
                                 : f.step < 200 ? f.step - 100
                                 : f.step < 300 ? f.step - 200
                                                : f.step - 300;
        CHECK(f.movedOf(kFlap) == secondsOf(at));
    }
    // A table that is over waits for the next dose.
    FakeBackend other;
    Notebook shorter;
    play(phasedCase(0.03), other, shorter);
    const RigidBody body = phasedCase(0.03).world.bodies[kFlap];
    for (const Frame& f : shorter.frames) {
        const std::uint64_t inDose = f.step <= 100 ? 0 : (f.step - 101) % 70 + 1;
        CHECK(f.movedOf(kFlap) == secondsOf(inDose));
        if (inDose >= 30) CHECK(body.pose(0, 0, f.movedOf(kFlap)).toWorld(Vec3(0, 1, 0)).y == 1);
    }
}

TEST_CASE("a dose that ends early ends the motion of its phase") {
    Case c = phasedCase(0.02);
    c.schedule.targetMass = 0.5e-3;
    FakeBackend backend;
    backend.dosed = [](std::uint64_t step) { return step < 115 ? 0 : 1; };
    Notebook notes;
    play(c, backend, notes);
    // The first dose finds its mass at 120, and rests until 140; the others turn for all of their time.
    for (const Frame& f : notes.frames)
        if (f.step >= 120 && f.step <= 140) CHECK(f.movedOf(kStirrer) == secondsOf(20));
    CHECK(notes.frames.back().movedOf(kStirrer) == secondsOf(20 + 50 + 50));
}

TEST_CASE("clocks go on from any checkpoint as if nothing had been") {
    Case c = phasedCase(0.1);
    c.schedule.reverseTurns = 0.02;
    c.checkpoint.simulated = 0.001;
    FakeBackend backend;
    CheckpointKeeper notes;
    const std::atomic<bool> stop{false};
    Derived derived;
    derived.massPerDose = 2e-3;
    const RunResult whole = runFilled(c, smallFilling(), derived, backend, notes, stop);
    REQUIRE(notes.kept.size() > 20);
    for (const RunCheckpoint& from : notes.kept) {
        FakeBackend again;
        Notebook rest;
        const RunResult r = runFilled(c, smallFilling(), derived, again, rest, stop, &from);
        CHECK(r.bodiesMoved == whole.bodiesMoved);
        const std::size_t behind = notes.frames.size() - rest.frames.size();
        for (std::size_t i = 0; i < rest.frames.size(); ++i)
            CHECK(rest.frames[i].bodiesMoved == notes.frames[behind + i].bodiesMoved);
    }
    // A record of a world without such bodies has none.
    Case plain = smallCase();
    FakeBackend other;
    CheckpointKeeper none;
    plain.checkpoint.simulated = 0.001;
    play(plain, other, none);
    REQUIRE(!none.kept.empty());
    CHECK_FALSE(none.kept.front().run.arrays().contains("body_clocks"));
    CHECK(other.clocks.empty());
}

TEST_CASE("another run's bed comes with its bodies where they stood, also with another time step") {
    const Case c = phasedCase(0.07);
    BodyClocks source(c.world);
    source.enter(Phase::Settle, 0);
    source.count(100);
    source.enter(Phase::Rotate, 1);
    source.count(33);
    Record record;
    source.save(record);
    Case finer = c;
    finer.world.timeStep = 2.5e-4;
    BodyClocks taken(finer.world);
    taken.takeOver(record, 4);
    for (std::size_t b = 0; b < 4; ++b) CHECK(taken.times()[b] == Approx(source.times()[b]).epsilon(1e-12));
    CHECK(taken.times()[kTapper] == Approx(0.1));
    taken.enter(Phase::Rotate, 1);  // of this run: the flap, which is not at its end, first goes there
    CHECK(taken.now()[kFlap].anewAt == 280);
    taken.count(148);
    CHECK(taken.times()[kFlap] == 0);
}
