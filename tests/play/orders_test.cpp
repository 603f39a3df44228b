// Orders to the drive of a simulation: the same as a schedule that says so.
#include <cmath>
#include <stdexcept>

#include "tests/play/led.h"
#include "tests/support/catch.h"

using namespace vkdose;
using namespace vkdose::test;

namespace {

constexpr double kTarget = 4.5e-3, kFast = 4, kSlow = 1;  // [kg], [rad/s]

/// Two doses that turn for half a second at most.
Case orderedCase() {
    Case c = listedCase();
    c.schedule.rotateTime = 0.5;
    c.schedule.coilSpeed = kFast;
    c.schedule.stop.maxDoses = 2;
    return c;
}

/// A gram every 40 steps from step 100 on.
std::uint64_t steady(std::uint64_t step) {
    return step < 100 ? 0 : std::min<std::uint64_t>(10, (step - 100) / 40);
}

/// What a case says with two stages and a target, said from outside at each reading.
void control(const Led& run, double target) {
    for (; !run.simulation->over(); run.advance(0)) {
        if (!run.simulation->takesOrders()) continue;
        const double mass = run.simulation->doseMass();
        if (mass >= target)
            run.simulation->stopDrive();
        else if (mass >= target / 2)
            run.simulation->changeSpeed(kSlow);
    }
}

}  // namespace

TEST_CASE("orders at readings drive the backend as the schedule that says the same") {
    const double ramp = GENERATE(0.0, 0.02), rest = GENERATE(0.02, 0.0);
    CAPTURE(ramp, rest);
    Case outside = orderedCase();
    outside.schedule.rampTime = ramp;
    outside.schedule.restTime = rest;
    Case inside = outside;
    inside.schedule.targetMass = kTarget;
    inside.schedule.stages = {{kFast, 0.5}};
    inside.schedule.coilSpeed = kSlow;
    FakeBackend whole;
    whole.dosed = steady;
    Notebook notes;
    const std::atomic<bool> stop{false};
    const RunResult expected = runCase(inside, whole, notes, stop);
    const Led run = led(outside, [](FakeBackend& b) { b.dosed = steady; });
    control(run, kTarget);
    CHECK(same(run.backend->calls, whole.calls));
    const std::vector<Dose>& doses = run.simulation->doses();
    REQUIRE(doses.size() == 2);
    REQUIRE(expected.doses.size() == 2);
    CHECK(expected.doses[0].stoppedBy == StopCause::Mass);
    CHECK(doses[0].stoppedBy == StopCause::Order);
    for (std::size_t d = 0; d < 2; ++d) {
        CHECK(doses[d].mass == expected.doses[d].mass);
        CHECK(doses[d].stopMass == expected.doses[d].stopMass);
        CHECK(doses[d].rotation == expected.doses[d].rotation);
        CHECK(doses[d].endTime == expected.doses[d].endTime);
        CHECK(doses[d].closedForm == expected.doses[d].closedForm);
        CHECK(doses[d].complete);
    }
}

TEST_CASE("the drive takes orders only while it conveys and has not been told to stop") {
    Case c = orderedCase();
    c.schedule.rampTime = 0.03;
    const Led run = led(c);
    const auto refuses = [&run] {
        CHECK_FALSE(run.simulation->takesOrders());
        CHECK_THROWS_AS(run.simulation->stopDrive(), std::logic_error);
        CHECK_THROWS_AS(run.simulation->changeSpeed(1), std::logic_error);
    };
    refuses();
    run.advance(0.1);
    run.advance(0);  // the settling is over
    REQUIRE(run.simulation->time() == Approx(0.1));
    refuses();
    run.advance(0);
    CHECK(run.simulation->takesOrders());
    CHECK_THROWS_AS(run.simulation->changeSpeed(-1), std::invalid_argument);
    CHECK_THROWS_AS(run.simulation->changeSpeed(std::nan("")), std::invalid_argument);
    run.simulation->changeSpeed(kSlow);
    run.simulation->stopDrive();  // the later order counts
    run.advance(0);
    CHECK(run.simulation->time() == Approx(0.15));  // it slows down until then
    refuses();
    run.toDose();
    CHECK(run.simulation->doses()[0].stoppedBy == StopCause::Order);
    CHECK(run.simulation->doses()[0].rotation == Approx(0.02));
    refuses();
    run.toDose();
    refuses();                                                       // the run is over
    CHECK(run.simulation->doses()[1].stoppedBy == StopCause::Time);  // the next dose is that of the case
}

TEST_CASE("an order counts in the reading at which it was given, and a speed until the end of the rotation") {
    const Led run = led(orderedCase());
    run.advance(0.15);
    REQUIRE(run.simulation->time() == Approx(0.15));
    run.simulation->changeSpeed(kSlow);
    run.advance(std::numeric_limits<double>::infinity());
    for (const FakeBackend::Call& call : run.backend->calls) {
        CAPTURE(call.firstStep);
        if (call.firstStep >= 100 && call.firstStep < 150) CHECK(call.rate == kFast);
        if (call.firstStep >= 150 && call.firstStep < 600) CHECK(call.rate == kSlow);
        if (call.firstStep >= 620 && call.firstStep < 1120) CHECK(call.rate == kFast);
    }
}

TEST_CASE("an order that is said again begins no second ramp") {
    Case c = orderedCase();
    c.schedule.rampTime = 0.06;
    const Led run = led(c);
    run.advance(0.18);
    REQUIRE(run.simulation->time() == Approx(0.18));
    for (int i = 0; i < 3; ++i) {
        run.simulation->changeSpeed(kSlow);
        run.advance(0);
    }
    REQUIRE(run.simulation->time() == Approx(0.27));
    CHECK(run.backend->calls.back().firstStep == 240);
    CHECK(run.backend->calls.back().rate == kSlow);
}
