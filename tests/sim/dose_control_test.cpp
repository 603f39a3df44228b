// Doses to a mass, in stages, with ramps, a largest torque and a turn back: what the coil is told, and when.
#include <cmath>

#include "host/sim/dose_book.h"
#include "tests/sim/fake_backend.h"
#include "tests/support/catch.h"

using namespace vkdose;
using namespace vkdose::test;

namespace {

/// smallCase with one dose of at most 500 steps, to 5 g, at a speed of 4 rad/s; sensors every 30 steps.
Case massCase() {
    Case c = smallCase();
    c.schedule.targetMass = 4.5e-3;
    c.schedule.rotateTime = 0.5;
    c.schedule.stop.maxDoses = 1;
    return c;
}

/// A gram every 40 steps from step 100 on.
std::uint64_t steady(std::uint64_t step) {
    return step < 100 ? 0 : std::min<std::uint64_t>(10, (step - 100) / 40);
}

/// Speed of the coil in the call that makes a step, in the conveying sense (the coil of smallCase turns about +z then).
double speedAt(const FakeBackend& backend, std::uint64_t step) {
    for (const FakeBackend::Call& call : backend.calls)
        if (step >= call.firstStep && step < call.firstStep + call.steps) return call.rate;
    return std::numeric_limits<double>::quiet_NaN();
}

double turned(const FakeBackend& backend, std::uint64_t from, std::uint64_t to) {
    double angle = 0;
    for (std::uint64_t s = from; s < to; ++s) angle += speedAt(backend, s) * 1e-3;
    return angle;
}

RunResult playFrom(const Case& c, FakeBackend& backend, RunObserver& notes, const RunCheckpoint* from = nullptr) {
    const std::atomic<bool> stop{false};
    Derived derived;
    derived.massPerDose = 2e-3;
    derived.massPerTurn = 1e-3;
    return runFilled(c, smallFilling(), derived, backend, notes, stop, from);
}

}  // namespace

TEST_CASE("a ramp takes the coil through equal parts of its speed, and as far as a linear one") {
    Case c = smallCase();
    c.schedule.rampTime = 0.02;  // 20 steps: a part each
    const Timeline t(c);
    CHECK(t.at(100).rate == Approx(4 * 0.5 / 20));
    CHECK(t.at(119).rate == Approx(4 * 19.5 / 20));
    CHECK(t.at(120).rate == 4);
    CHECK(t.at(120).pieceEnd == 130);
    CHECK(t.at(120).stop == 130);
    CHECK(t.at(130).rate == Approx(4 * 19.5 / 20));
    CHECK(t.at(149).rate == Approx(4 * 0.5 / 20));
    CHECK(t.at(149).phase == Phase::Rotate);
    CHECK(t.at(150).rate == 0);
    CHECK(t.at(150).phase == Phase::Rest);
    CHECK(t.at(170 + 20).rate == 4);  // the same in the next dose
    FakeBackend backend;
    Notebook notes;
    play(c, backend, notes);
    CHECK(turned(backend, 100, 150) == Approx(4 * (0.05 - 0.02)));
    CHECK(backend.step == 310);
}

TEST_CASE("a long ramp has no more than its number of parts") {
    Case c = smallCase();
    c.schedule.rotateTime = 1;
    c.schedule.rampTime = 0.1;
    const Timeline t(c);
    std::uint64_t parts = 0;
    double angle = 0;
    for (std::uint64_t step = 100; step < 200; step = t.at(step).pieceEnd) {
        angle += t.at(step).rate * double(t.at(step).pieceEnd - step) * 1e-3;
        ++parts;
    }
    CHECK(parts == Timeline::kRampPieces);
    CHECK(angle == Approx(4 * 0.1 / 2));
}

TEST_CASE("power is the mean of torque times speed where the speed changes between two samples") {
    Case c = smallCase();
    c.schedule.rampTime = 0.02;
    FakeBackend backend;
    backend.torque = [](std::uint64_t) { return -0.5; };
    Notebook notes;
    play(c, backend, notes);
    REQUIRE(notes.samples[4].step == 120);
    CHECK(notes.samples[4].coilTorque == Approx(0.5));
    CHECK(notes.samples[4].coilPower == Approx(0.5 * 4 / 2));  // of a ramp from 0 to 4
}

TEST_CASE("a dose to a mass stops at the first sample that finds it, and what falls later is overshoot") {
    const Case c = massCase();
    FakeBackend backend;
    backend.dosed = [](std::uint64_t step) {
        return step <= 300 ? steady(step) : std::min<std::uint64_t>(step / 10 - 25, 7);
    };
    Notebook notes;
    const RunResult r = playFrom(c, backend, notes);
    // Five grams are out at step 300, which is a sample.
    CHECK(r.reason == StopReason::Doses);
    REQUIRE(r.doses.size() == 1);
    const Dose& d = r.doses[0];
    CHECK(d.complete);
    CHECK(d.target == 4.5e-3);
    CHECK(d.stopMass == Approx(5e-3));
    CHECK(d.mass == Approx(7e-3));
    CHECK(d.overshoot() == Approx(2e-3));
    CHECK(d.rotation == Approx(0.2));
    CHECK(d.stoppedBy == StopCause::Mass);
    CHECK(d.endTime == Approx(0.32));
    CHECK(d.closedForm == Approx(1e-3 * 4 * 0.2 / (2 * kPi)));
    CHECK(backend.step == 320);
    CHECK(speedAt(backend, 299) == 4);
    CHECK(speedAt(backend, 300) == 0);
}

TEST_CASE("a dose that does not reach its mass stops at its longest time, and the next one begins anew") {
    Case c = massCase();
    c.schedule.stop.maxDoses = 2;
    FakeBackend backend;
    backend.dosed = [](std::uint64_t step) {
        return step < 640 ? steady(step) / 3 : std::min<std::uint64_t>(10, step / 90);
    };
    Notebook notes;
    const RunResult r = playFrom(c, backend, notes);
    REQUIRE(r.doses.size() == 2);
    CHECK(r.doses[0].stoppedBy == StopCause::Time);
    CHECK(r.doses[0].rotation == Approx(0.5));
    CHECK(r.doses[0].endTime == Approx(0.62));
    CHECK(r.doses[1].startTime == Approx(0.62));
    CHECK(r.doses[1].stoppedBy == StopCause::Mass);
    CHECK(r.doses[1].stopMass == Approx(5e-3));
}

TEST_CASE("stages set the speed by the mass that is out, and the coil's own speed follows the last") {
    Case c = massCase();
    c.schedule.targetMass = 10e-3;
    c.schedule.stages = {{9, 0.3}, {6, 0.5}};
    FakeBackend backend;
    backend.dosed = steady;
    Notebook notes;
    const RunResult r = playFrom(c, backend, notes);
    CHECK(speedAt(backend, 100) == 9);
    CHECK(speedAt(backend, 239) == 9);  // three grams are out at 220, the sample is at 240
    CHECK(speedAt(backend, 240) == 6);
    CHECK(speedAt(backend, 299) == 6);
    CHECK(speedAt(backend, 300) == 4);
    CHECK(speedAt(backend, 509) == 4);
    CHECK(r.doses.at(0).rotation == Approx(0.41));  // ten grams at 500, the sample at 510

    SECTION("a jump over a stage takes the speed after it") {
        FakeBackend jumps;
        jumps.dosed = [](std::uint64_t step) { return step < 200 ? 0 : step < 400 ? 8 : 10; };
        playFrom(c, jumps, notes);
        CHECK(speedAt(jumps, 209) == 9);
        CHECK(speedAt(jumps, 210) == 4);
    }
}

TEST_CASE("with ramps the coil goes from stage to stage and slows down after the stop, which is overshoot") {
    Case c = massCase();
    c.schedule.targetMass = 4e-3;
    c.schedule.stages = {{8, 0.5}};
    c.schedule.rampTime = 0.01;
    FakeBackend backend;
    backend.dosed = steady;
    Notebook notes;
    const RunResult r = playFrom(c, backend, notes);
    CHECK(speedAt(backend, 109) == Approx(8 * 0.95));
    CHECK(speedAt(backend, 110) == 8);
    // Two grams are out at the sample at 180.
    CHECK(speedAt(backend, 180) == Approx(8 - 4 * 0.05));
    CHECK(speedAt(backend, 189) == Approx(8 - 4 * 0.95));
    CHECK(speedAt(backend, 190) == 4);
    // Four grams at 260, the sample at 270.
    const Dose& d = r.doses.at(0);
    CHECK(speedAt(backend, 269) == 4);
    CHECK(speedAt(backend, 270) == Approx(4 * 0.95));
    CHECK(speedAt(backend, 279) == Approx(4 * 0.05));
    CHECK(speedAt(backend, 280) == 0);
    CHECK(d.rotation == Approx(0.17));
    CHECK(d.endTime == Approx(0.3));
    CHECK(d.stopMass == Approx(4e-3));
    CHECK(d.overshoot() == Approx(1e-3));  // the fifth gram, at 300
    CHECK(d.closedForm == Approx(1e-3 * turned(backend, 100, 280) / (2 * kPi)));
}

TEST_CASE("a torque beyond the largest ends the rotation, or the run") {
    Case c = massCase();
    c.schedule.maxTorque = 2;
    FakeBackend backend;
    backend.torque = [](std::uint64_t step) { return step >= 200 && step < 260 ? -3.0 : -1.0; };
    Notebook notes;
    SECTION("the rotation") {
        const RunResult r = playFrom(c, backend, notes);
        CHECK(r.reason == StopReason::Doses);
        REQUIRE(r.doses.size() == 1);
        CHECK(r.doses[0].complete);
        CHECK(r.doses[0].stoppedBy == StopCause::Torque);
        CHECK(r.doses[0].rotation == Approx(0.14));  // mean of 180 to 210 is 5/3, of 210 to 240 it is 3
        CHECK(backend.step == 260);
    }
    SECTION("the run") {
        c.schedule.torqueEndsRun = true;
        const RunResult r = playFrom(c, backend, notes);
        CHECK(r.reason == StopReason::Torque);
        CHECK(stopKeyword(r.reason) == "torque");
        REQUIRE(r.doses.size() == 1);
        CHECK_FALSE(r.doses[0].complete);
        CHECK(r.doses[0].stoppedBy == StopCause::Torque);
        CHECK(backend.step == 240);
        CHECK(r.endState);
    }
    SECTION("of either sign") {
        backend.torque = [](std::uint64_t) { return 2.5; };
        CHECK(playFrom(c, backend, notes).doses.at(0).rotation == Approx(0.02));
    }
}

TEST_CASE("after a rotation the coil turns back by its turns, and then rests") {
    Case c = smallCase();
    c.schedule.reverseTurns = 0.04;  // at 4 rad/s: 63 steps
    c.schedule.stop.maxDoses = 2;
    FakeBackend backend;
    backend.torque = [](std::uint64_t) { return -0.5; };
    Notebook notes;
    SECTION("at once") {
        const RunResult r = playFrom(c, backend, notes);
        CHECK(speedAt(backend, 149) == 4);
        CHECK(speedAt(backend, 150) == -4);
        CHECK(speedAt(backend, 212) == -4);
        CHECK(speedAt(backend, 213) == 0);
        CHECK(speedAt(backend, 232) == 0);
        CHECK(speedAt(backend, 233) == 4);
        CHECK(r.doses.at(0).endTime == Approx(0.233));
        CHECK(r.doses.at(0).rotation == Approx(0.05));
        for (const Sample& s : notes.samples)
            if (s.phase == Phase::Reverse) CHECK(s.coilPower == Approx(-0.5 * 4));  // the powder drives the coil
    }
    SECTION("with ramps") {
        c.schedule.rampTime = 0.01;
        playFrom(c, backend, notes);
        CHECK(speedAt(backend, 150) == Approx(-4 * 0.05));
        CHECK(turned(backend, 150, 223) == Approx(-4 * 0.063));
        CHECK(speedAt(backend, 223) == 0);
    }
}

TEST_CASE("a run under control that goes on from any checkpoint makes the same calls and the same doses") {
    Case c = massCase();
    c.schedule.targetMass = 2.5e-3;
    c.schedule.stages = {{9, 0.3}, {6, 0.8}};
    c.schedule.rampTime = 0.013;
    c.schedule.reverseTurns = 0.03;
    c.schedule.stop.maxDoses = 3;
    c.checkpoint.simulated = 0.001;
    const auto dosed = [](std::uint64_t step) {
        return std::min<std::uint64_t>(10, step < 100 ? 0 : (step - 100) / 70);
    };
    const auto torque = [](std::uint64_t step) { return std::sin(double(step)); };
    FakeBackend backend;
    backend.dosed = dosed;
    backend.torque = torque;
    CheckpointKeeper notes;
    const RunResult whole = playFrom(c, backend, notes);
    REQUIRE(whole.doses.size() == 3);
    REQUIRE(notes.kept.size() > 100);
    for (const RunCheckpoint& from : notes.kept) {
        FakeBackend again;
        again.dosed = dosed;
        again.torque = torque;
        Notebook rest;
        const RunResult r = playFrom(c, again, rest, &from);
        REQUIRE(again.step == backend.step);
        CHECK(again.coilAngle() == backend.coilAngle());
        REQUIRE(r.doses.size() == whole.doses.size());
        for (std::size_t i = 0; i < r.doses.size(); ++i)
            CHECK(csvRow(kDoseColumns, r.doses[i]) == csvRow(kDoseColumns, whole.doses[i]));
        REQUIRE(!rest.samples.empty());
        const std::size_t behind = notes.samples.size() - rest.samples.size();
        for (std::size_t i = 0; i < rest.samples.size(); ++i)
            CHECK(csvRow(kSampleColumns, rest.samples[i]) == csvRow(kSampleColumns, notes.samples[behind + i]));
    }
}
