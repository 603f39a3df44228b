#include "host/sim/runner.h"

#include <cmath>
#include <set>

#include "host/core/memory_limit.h"
#include "tests/sim/fake_backend.h"
#include "tests/support/catch.h"
#include "tests/support/limited_memory.h"

using namespace vkdose;
using namespace vkdose::test;

namespace {

std::uint64_t stepsAt(const FakeBackend& backend, std::uint64_t from, std::uint64_t to) {
    std::uint64_t n = 0;
    for (const FakeBackend::Call& call : backend.calls) {
        if (call.firstStep >= from && call.firstStep < to) n += call.steps;
    }
    return n;
}

}  // namespace

TEST_CASE("a run makes every phase's steps at its rate and under its law") {
    FakeBackend backend;
    Notebook notes;
    const RunResult r = play(smallCase(), backend, notes);
    CHECK(backend.loads == 1);
    CHECK(r.reason == StopReason::Doses);
    CHECK(backend.step == 100 + 3 * 70);
    for (const FakeBackend::Call& call : backend.calls) {
        CAPTURE(call.firstStep);
        const bool settling = call.firstStep < 100;
        const bool turning = !settling && (call.firstStep - 100) % 70 < 50;
        CHECK(call.kc == (settling ? 3 : 7));
        CHECK(call.rate == Approx(turning ? 4 : 0));
    }
    CHECK(stepsAt(backend, 0, 100) == 100);
    CHECK(stepsAt(backend, 100, 150) == 50);
    CHECK(stepsAt(backend, 150, 170) == 20);
    CHECK(r.particleSteps == 10 * 310);
    CHECK(r.endState);
}

TEST_CASE("a call makes as many steps as the backend wants, between samples, and at least 64") {
    Case c = smallCase();  // ten particles, 100 steps of settling
    c.sensorInterval = 1;
    for (const auto& [perCall, steps] : {std::pair(4e6, 100U), std::pair(800.0, 80U), std::pair(10.0, 64U)}) {
        FakeBackend backend;
        backend.perCall = perCall;
        Notebook notes;
        play(c, backend, notes);
        CHECK(backend.calls.front().steps == steps);
    }
}

TEST_CASE("a run settles under the gravity of its settling and doses under that of the case") {
    Case c = smallCase();
    c.world.gravity = Vec3(0, -8, 0);
    c.schedule.settleGravityFactor = 0.25;
    FakeBackend backend;
    Notebook notes;
    play(c, backend, notes);
    std::set<double> settling, dosing;
    for (const FakeBackend::Call& call : backend.calls) (call.firstStep < 100 ? settling : dosing).insert(call.gravity);
    CHECK(settling == std::set<double>{-2});
    CHECK(dosing == std::set<double>{-8});
}

TEST_CASE("a run that goes on knows the gravity under which it was interrupted") {
    Case c = smallCase();
    c.world.gravity = Vec3(0, -8, 0);
    c.schedule.settleGravityFactor = 0.25;
    c.checkpoint.wall = 0;
    c.checkpoint.simulated = 0.03;
    FakeBackend whole;
    CheckpointKeeper keeper;
    play(c, whole, keeper);
    REQUIRE(keeper.kept.size() > 5);
    const std::atomic<bool> stop{false};
    for (const RunCheckpoint& from : keeper.kept) {
        FakeBackend rest;
        Notebook notes;
        runFilled(c, smallFilling(), {}, rest, notes, stop, &from);
        for (const FakeBackend::Call& call : rest.calls) CHECK(call.gravity == (call.firstStep < 100 ? -2 : -8));
        CHECK(rest.step == whole.step);
    }
}

TEST_CASE("samples come at the sensor interval and at phase ends, with the angle about +z") {
    for (const int hand : {-1, 1}) {
        Case c = smallCase();
        c.world.coil->hand = hand;
        FakeBackend backend;
        Notebook notes;
        play(c, backend, notes);
        std::vector<std::uint64_t> at;
        for (const Sample& s : notes.samples) at.push_back(s.step);
        at.resize(9);
        CHECK(at == std::vector<std::uint64_t>{30, 60, 90, 100, 120, 150, 170, 180, 210});
        CHECK(notes.samples[3].phase == Phase::Settle);
        CHECK(notes.samples[3].coilAngle == 0);
        CHECK(notes.samples[5].coilAngle == Approx(-hand * 4 * 0.05));  // a right-handed coil conveys clockwise
        CHECK(notes.samples.back().coilAngle == Approx(-hand * 3 * 4 * 0.05));
        CHECK(notes.samples[5].time == Approx(0.15));
        CHECK(std::isnan(notes.samples[5].outletVelocity));  // the throat is empty
    }
}

TEST_CASE("calls are cut to pieces for many particles without changing the samples") {
    Case c = smallCase();
    c.schedule.settleTime = 1.0;
    c.schedule.rotateTime = 0;
    c.sensorInterval = 0.5;
    FakeBackend backend;
    backend.torque = [](std::uint64_t s) { return s < 250 ? 1.0 : 3.0; };
    Notebook notes;
    const std::atomic<bool> stop{false};
    Insertion filled = smallFilling(20000);  // 4e6 particle-steps are 200 steps
    runFilled(c, filled, Derived{}, backend, notes, stop);
    CHECK(backend.calls.size() == 6);
    REQUIRE(notes.samples.size() == 2);
    // The torque is the mean over all pieces, weighted by their steps; the overlap the largest of them (0.1 at
    // 200+100).
    CHECK(notes.samples[0].sensors.coilTorque == Approx(2.0));
    CHECK(notes.samples[1].sensors.coilTorque == Approx(3.0));
}

TEST_CASE("doses carry their mass, torque while turning and closed form") {
    FakeBackend backend;
    backend.dosed = [](std::uint64_t s) { return s < 50 ? 0 : s < 130 ? 1 : s < 165 ? 3 : s < 200 ? 4 : 9; };
    // Against the conveying sense while turning, something else while resting, which must not count.
    backend.torque = [](std::uint64_t s) { return s >= 100 && (s - 100) % 70 < 50 ? (s < 120 ? -1.0 : -2.0) : 50.0; };
    Notebook notes;
    const RunResult r = play(smallCase(), backend, notes);
    REQUIRE(r.doses.size() == 3);
    REQUIRE(notes.doses.size() == 3);
    CHECK(r.dosedWhileSettling == Approx(1e-3));
    CHECK(r.doses[0].mass == Approx(3e-3));
    CHECK(r.doses[0].particles == 3);
    CHECK(r.doses[0].cumulative == Approx(4e-3));
    CHECK(r.doses[0].startTime == Approx(0.1));
    CHECK(r.doses[0].coilTorque == Approx((20 * 1.0 + 30 * 2.0) / 50));
    CHECK(r.doses[0].closedForm == 2e-3);
    CHECK(r.doses[0].complete);
    CHECK(r.doses[1].mass == Approx(5e-3));
    CHECK(r.doses[1].coilTorque == Approx(2.0));
    CHECK(r.doses[2].mass == Approx(0).margin(1e-15));
    // Mean of 3, 5 and 0 g: 8/3; deviations 1/3, 7/3, -8/3; sample variance (1 + 49 + 64)/9/2.
    CHECK(r.statistics.doses == 3);
    CHECK(r.statistics.mean == Approx(8e-3 / 3));
    CHECK(r.statistics.deviation == Approx(1e-3 * std::sqrt(114.0 / 18)));
    CHECK(r.statistics.relative == Approx(std::sqrt(114.0 / 18) / (8.0 / 3)));
}

TEST_CASE("an incomplete dose is in no statistics, and one dose has no deviation") {
    Dose a, b, cut;
    a.complete = b.complete = true;
    a.mass = 3e-3;
    b.mass = 5e-3;
    cut.mass = 1e-3;
    const DoseStatistics s = statistics({a, b, cut});
    CHECK(s.doses == 2);
    CHECK(s.mean == Approx(4e-3));
    CHECK(s.deviation == Approx(std::sqrt(2.0) * 1e-3));
    CHECK(statistics({a, cut}).deviation == 0);
    CHECK(statistics({cut}).doses == 0);
    CHECK(statistics({cut}).mean == 0);
}

TEST_CASE("the drive's torque and power do not depend on the coil's hand") {
    for (const int hand : {-1, 1}) {
        Case c = smallCase();
        c.world.coil->hand = hand;
        FakeBackend backend;
        backend.torque = [hand](std::uint64_t) { return hand * 0.5; };  // opposes the conveying sense -hand
        Notebook notes;
        play(c, backend, notes);
        const Sample& turning = notes.samples[5];
        REQUIRE(turning.phase == Phase::Rotate);
        CHECK(turning.coilTorque == Approx(0.5));
        CHECK(turning.coilPower == Approx(2.0));
        CHECK(notes.samples[6].coilPower == 0);  // resting
    }
}

TEST_CASE("an empty canister and the rules end a run") {
    Case c = smallCase();
    c.schedule.stop.maxDoses = 1000;
    FakeBackend backend;
    Notebook notes;
    SECTION("empty") {
        backend.dosed = [](std::uint64_t s) { return s < 200 ? 0 : 10; };
        const RunResult r = play(c, backend, notes);
        CHECK(r.reason == StopReason::Empty);
        CHECK(r.doses.size() == 2);
    }
    SECTION("simulation rule") {
        c.schedule.stop.kind = StopRule::Kind::Simulation;
        backend.dosed = [](std::uint64_t s) { return s < 120 ? 0 : 4; };
        const RunResult r = play(c, backend, notes);
        CHECK(r.reason == StopReason::Simulation);
        CHECK(r.doses.size() == 4);
    }
    SECTION("end time, in the middle of a dose") {
        c.schedule.stop.endTime = 0.200;
        const RunResult r = play(c, backend, notes);
        CHECK(r.reason == StopReason::EndTime);
        CHECK(backend.step == 200);
        REQUIRE(r.doses.size() == 2);
        CHECK(r.doses[0].complete);
        CHECK_FALSE(r.doses[1].complete);
        CHECK(r.statistics.doses == 1);
        CHECK(notes.samples.back().step == 200);
    }
    SECTION("end time, exactly at the end of a dose") {
        c.schedule.stop.endTime = 0.170;
        const RunResult r = play(c, backend, notes);
        CHECK(r.reason == StopReason::EndTime);
        REQUIRE(r.doses.size() == 1);
        CHECK(r.doses[0].complete);
    }
    SECTION("no doses asked for") {
        c.schedule.rotateTime = 0;
        const RunResult r = play(c, backend, notes);
        CHECK(r.reason == StopReason::Settled);
        CHECK(backend.step == 100);
        CHECK(r.doses.empty());
    }
    SECTION("no rest") {
        c.schedule.restTime = 0;
        c.schedule.stop.maxDoses = 2;
        const RunResult r = play(c, backend, notes);
        CHECK(r.doses.size() == 2);
        CHECK(backend.step == 200);
    }
}

TEST_CASE("the stop flag ends a run cleanly with what there is") {
    FakeBackend backend;
    Notebook notes;
    SECTION("before the first step") {
        const RunResult r = play(smallCase(), backend, notes, true);
        CHECK(r.reason == StopReason::Interrupted);
        CHECK(backend.step == 0);
        CHECK(r.endState);
    }
    SECTION("within a dose") {
        std::atomic<bool> stop{false};
        backend.dosed = [&stop](std::uint64_t s) {
            if (s >= 190) stop = true;
            return s >= 180 ? 2 : 0;
        };
        const RunResult r = runFilled(smallCase(), smallFilling(), Derived{}, backend, notes, stop);
        CHECK(r.reason == StopReason::Interrupted);
        REQUIRE(r.doses.size() == 2);
        CHECK_FALSE(r.doses[1].complete);
        CHECK(r.doses[1].mass == Approx(2e-3));
        CHECK(r.statistics.doses == 1);
    }
}

TEST_CASE("an error of the backend keeps what was computed and is reported") {
    FakeBackend backend;
    Notebook notes;
    SECTION("run error") {
        backend.runErrorAt = 200;
        const RunResult r = play(smallCase(), backend, notes);
        CHECK(r.reason == StopReason::RunError);
        CHECK_THAT(r.error, Catch::Contains("particle 3 is gone"));
        REQUIRE(r.doses.size() == 2);
        CHECK(r.doses[0].complete);
        CHECK_FALSE(r.doses[1].complete);
        CHECK(r.last.step > 170);
        CHECK(r.endState);
    }
    SECTION("device error") {
        backend.deviceErrorAt = 50;
        const RunResult r = play(smallCase(), backend, notes);
        CHECK(r.reason == StopReason::DeviceError);
        CHECK(r.error == "device lost" + memoryLimitText());
        CHECK(r.doses.empty());
    }
    SECTION("device error of a process whose memory is limited") {
        const LimitedMemory limited;
        backend.deviceErrorAt = 50;
        const RunResult r = play(smallCase(), backend, notes);
        CHECK_THAT(r.error, Catch::StartsWith("device lost") && Catch::Contains("(ulimit -v)"));
    }
}

TEST_CASE("a ledger that does not close stops the run, the bad sample is on record, the result keeps the good one") {
    FakeBackend backend;
    backend.spoil = [](std::uint64_t step, Sensors& s) {
        if (step >= 120) s.count[0] -= 1;
    };
    Notebook notes;
    const RunResult r = play(smallCase(), backend, notes);
    CHECK(r.reason == StopReason::RunError);
    CHECK_THAT(r.error, Catch::Contains("mass ledger") && Catch::Contains("9 particles are accounted for"));
    CHECK(notes.samples.back().step == 120);
    CHECK(r.last.step == 100);
    CHECK(r.last.sensors.count[0] == 10);
}

TEST_CASE("a lost particle stops the run") {
    FakeBackend backend;
    backend.spoil = [](std::uint64_t step, Sensors& s) {
        if (step < 60) return;
        s.count[0] -= 1;
        s.count[3] += 1;
        s.mass[0] -= 1e-3;
        s.mass[3] += 1e-3;
    };
    Notebook notes;
    CHECK(play(smallCase(), backend, notes).reason == StopReason::RunError);
}

TEST_CASE("the expected length follows the doses so far and never lies behind the run") {
    Case c = smallCase();
    c.schedule.stop.maxDoses = 1000;
    FakeBackend backend;
    backend.dosed = [](std::uint64_t s) { return s < 170 ? 0 : std::min<std::uint64_t>(10, (s - 100) / 70); };
    Notebook notes;
    play(c, backend, notes);
    CHECK(notes.progress.front().expectedSteps == 100 + 5 * 70);  // 10 g by the closed form of 2 g a dose
    CHECK(notes.progress.back().expectedSteps == 100 + 10 * 70);  // 1 g a dose
    for (const Progress& p : notes.progress) CHECK((p.expectedSteps == 0 || p.expectedSteps >= p.step));
}

TEST_CASE("a run that goes on tells its pace by what it did itself") {
    Case c = smallCase();
    c.checkpoint.wall = 0;
    c.checkpoint.simulated = 0.001;
    FakeBackend backend;
    CheckpointKeeper notes;
    play(c, backend, notes);
    REQUIRE(notes.kept.size() > 10);
    const RunCheckpoint& from = notes.kept[10];
    const std::uint64_t begin = from.backend.one<std::uint64_t>("step");
    REQUIRE(begin > 0);
    FakeBackend second;
    Notebook after;
    const std::atomic<bool> stop{false};
    runFilled(c, smallFilling(), {}, second, after, stop, &from);
    const double whole = notes.progress.back().particleSteps;
    double done = 0;
    for (const Progress& p : notes.progress)
        if (p.step == begin) done = p.particleSteps;
    for (const Progress& p : after.progress) CHECK(p.steps == p.step - begin);
    REQUIRE(done > 0);
    CHECK(after.progress.back().particleSteps == whole - done);
    CHECK(notes.progress.back().steps == notes.progress.back().step);
}
