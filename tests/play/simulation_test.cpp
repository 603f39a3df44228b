// A run that its caller leads: the same as one in one go, wherever it rests.
#include "host/play/simulation.h"

#include <limits>

#include "tests/play/led.h"
#include "tests/support/catch.h"

using namespace vkdose;
using namespace vkdose::test;

TEST_CASE("a simulation rests before its first step") {
    const Led run = led(listedCase());
    CHECK(run.backend->loads == 1);
    CHECK(run.backend->calls.empty());
    CHECK_FALSE(run.simulation->over());
    CHECK(run.simulation->time() == 0);
    CHECK(run.simulation->last().sensors.count[0] == 10);
    CHECK(run.simulation->particles()->size() == 10);
    CHECK(run.simulation->doseMass() == 0);
}

TEST_CASE("however often it rests, the backend is asked for the same") {
    FakeBackend whole;
    whole.dosed = someDosed;
    Notebook notes;
    const std::atomic<bool> stop{false};
    const Case c = listedCase();
    const RunResult expected = runCase(c, whole, notes, stop);
    const Led run = led(c);
    std::size_t rests = 0;
    for (; !run.simulation->over(); ++rests) run.advance(0);
    CHECK(rests == notes.samples.size());
    CHECK(same(run.backend->calls, whole.calls));
    CHECK(run.simulation->reason() == expected.reason);
    CHECK(run.simulation->time() == Approx(0.31));
    REQUIRE(run.simulation->doses().size() == 3);
    for (std::size_t d = 0; d < 3; ++d) {
        CHECK(run.simulation->doses()[d].mass == expected.doses[d].mass);
        CHECK(run.simulation->doses()[d].complete);
    }
    const std::size_t calls = run.backend->calls.size();
    run.advance(1);  // it is over
    CHECK(run.backend->calls.size() == calls);
}

TEST_CASE("it goes on for the time asked for, to within half an interval of the sensors") {
    const Led run = led(listedCase());  // readings each 0.03 s, and at the ends of phases
    run.advance(0.01);
    CHECK(run.simulation->time() == Approx(0.03));  // the next at least
    run.advance(0.046);
    CHECK(run.simulation->time() == Approx(0.09));
    CHECK(run.simulation->last().time == run.simulation->time());
    run.advance(0.01);
    CHECK(run.simulation->time() == Approx(0.1));  // the settling ends
    CHECK(run.simulation->last().phase == Phase::Settle);
    CHECK_THROWS_AS(run.simulation->advance(-1), std::invalid_argument);
    CHECK_THROWS_AS(run.simulation->advance(std::numeric_limits<double>::quiet_NaN()), std::invalid_argument);
    run.advance(kToEnd);
    CHECK(run.simulation->over());
}

TEST_CASE("it goes on from dose to dose, and a dose is there when it has ended") {
    const Led run = led(listedCase());
    for (const double end : {0.17, 0.24}) {
        run.toDose();
        CHECK(run.simulation->time() == Approx(end));
        CHECK(run.simulation->doses().back().endTime == Approx(end));
        CHECK_FALSE(run.simulation->over());
    }
    CHECK(run.simulation->doses()[1].mass == Approx(2e-3));  // the second and the fourth of its particles
    CHECK(run.simulation->doseMass() == Approx(2e-3));
    run.toDose();
    CHECK(run.simulation->over());
    CHECK(run.simulation->doses().size() == 3);
    run.toDose();
    CHECK(run.simulation->doses().size() == 3);
}

TEST_CASE("an end in the middle of a dose leaves it incomplete") {
    Case c = listedCase();
    c.schedule.stop.endTime = 0.13;
    const Led run = led(c);
    run.advance(kToEnd);
    CHECK(run.simulation->reason() == StopReason::EndTime);
    REQUIRE(run.simulation->doses().size() == 1);
    CHECK_FALSE(run.simulation->doses()[0].complete);
}

TEST_CASE("errors of a run are thrown to the caller, who can still look at it") {
    const Led run = led(listedCase(), [](FakeBackend& b) { b.runErrorAt = 60; });
    run.advance(0.06);
    run.simulation->advance(kToEnd);
    CHECK_THROWS_AS(run.wait(), RunError);
    CHECK(run.simulation->over());
    CHECK(run.simulation->time() == Approx(0.06));
    CHECK(run.simulation->particles()->size() == 10);
    run.simulation->advance(1);
    CHECK_THROWS_AS(run.wait(), RunError);
    const Led lost = led(listedCase(), [](FakeBackend& b) { b.deviceErrorAt = 0; });
    lost.simulation->advance(0);
    CHECK_THROWS_AS(lost.wait(), DeviceError);
    Case wrong = listedCase();
    wrong.schedule.restTime = 1e-9;
    CHECK_THROWS_AS(led(wrong), CaseError);
}

TEST_CASE("the particles of a rest are read once and stay, and contacts and fields are those of now") {
    const Led run = led(listedCase(), [](FakeBackend& b) {
        b.field = [](std::uint64_t step) {
            FieldPoint p;
            p.density = double(step);
            return p;
        };
    });
    run.advance(0.03);
    const auto first = run.simulation->particles();
    CHECK(run.simulation->particles() == first);
    FieldRequest request;
    request.grid.cells = {1, 1, 3};
    for (const std::uint64_t step : {30, 60}) {
        const Frame frame = run.simulation->frame();
        CHECK(frame.step == step);
        CHECK(frame.time == run.simulation->time());
        CHECK(frame.phase == Phase::Settle);
        CHECK(frame.particles.size() == 10);
        REQUIRE(frame.contacts.size() == 1);
        CHECK(frame.contacts[0].maxOverlap == double(step));
        REQUIRE(run.simulation->field(request).size() == 3);
        CHECK(run.simulation->field(request)[2].density == double(step));
        run.advance(0);
    }
    CHECK(run.simulation->particles() != first);
    CHECK(first->size() == 10);
}

TEST_CASE("a frame tells for which time a body has moved that moves in phases") {
    Case c = listedCase();
    RigidBody body;
    body.course.motion = geometry::Turn{};
    body.clock = Clock::Phases;
    body.phases = {Phase::Settle};
    c.world.bodies = {body};
    const Led run = led(c);
    run.advance(0.03);
    REQUIRE(run.simulation->frame().bodiesMoved.size() == 1);
    CHECK(run.simulation->frame().movedOf(0).time == Approx(run.simulation->time()));
}

TEST_CASE("a halt makes it rest between two readings, and it goes on as if it had not") {
    FakeBackend whole;
    Notebook notes;
    const std::atomic<bool> stop{false};
    Case c = listedCase();
    c.schedule.rampTime = 0.02;  // several calls between two readings
    runCase(c, whole, notes, stop);
    Simulation* simulation = nullptr;
    bool looked = false;
    const Led run = led(c, [&](FakeBackend& b) {
        b.dosed = [](std::uint64_t) { return 0; };
        b.spoil = [&](std::uint64_t step, Sensors&) {
            if (step != 110) return;
            simulation->halt();
            try {
                (void)simulation->time();
            } catch (const std::logic_error&) {
                looked = true;
            }
        };
    });
    simulation = run.simulation.get();
    run.advance(kToEnd);
    CHECK(looked);  // refused while the run went on
    CHECK(simulation->time() == Approx(0.11));
    CHECK(simulation->last().time == Approx(0.1));
    run.advance(kToEnd);
    CHECK(simulation->over());
    CHECK(same(run.backend->calls, whole.calls));
}

TEST_CASE("a simulation can be left at any time") {
    Led run = led(listedCase());
    run.simulation.reset();
    run = led(listedCase());
    run.advance(0.1);
    run.simulation.reset();
    run = led(listedCase());
    run.simulation->advance(kToEnd);
    run.simulation.reset();
    SUCCEED();
}
