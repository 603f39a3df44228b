// The motion of a device before it runs, against a run.

#include "host/sim/planned_motion.h"

#include <cmath>

#include "tests/sim/fake_backend.h"
#include "tests/support/catch.h"
#include "tests/support/mini_case.h"

using namespace vkdose;
using namespace vkdose::test;

namespace {

/// A canister whose coil turns, with a flap that opens while it does.
Case flapCase() {
    Case c = mini();
    c.frames.interval = c.sensorInterval;
    RigidBody flap;
    flap.name = "flap";
    flap.shapes = {geometry::Ball{Vec3(0), 1e-3}};
    flap.course.motion = geometry::Slide{Vec3(0.1, 0, 0)};
    flap.clock = Clock::Phases;
    flap.phases = {Phase::Rotate};
    c.world.bodies = {flap};
    return c;
}

}  // namespace

TEST_CASE("the planned motion is that of the run's first dose") {
    const double ramp = GENERATE(0.0, 0.05);
    Case c = flapCase();
    c.schedule.rampTime = ramp;
    FakeBackend backend;
    Notebook notes;
    (void)play(c, backend, notes);
    const std::vector<Frame> planned = plannedMotion(c);
    REQUIRE(planned.size() == 101);
    CHECK(planned.front().time == Approx(0.15));
    CHECK(planned.back().time == Approx(0.55));
    const double rate = c.schedule.coilSpeed, between = (0.55 - 0.15) / 100;
    std::size_t compared = 0;
    for (const Frame& run : notes.frames) {
        if (run.time < 0.15 || run.time > 0.55) continue;
        const auto i = std::size_t(std::lround((run.time - 0.15) / between));
        const Frame& plan = planned.at(i);
        const double off = std::abs(plan.time - run.time) + 1e-9;
        CHECK(std::abs(plan.coilAngle - run.coilAngle) <= rate * off);
        CHECK(std::abs(plan.movedOf(0).time - run.movedOf(0).time) <= off);
        ++compared;
    }
    CHECK(compared > 50);
    CHECK(std::abs(planned.back().coilAngle) == Approx(rate * (0.3 - ramp)));
    CHECK(planned.back().phase == Phase::Rest);
}

TEST_CASE("a case without doses is shown settling, ten seconds at most, and one without time not at all") {
    Case c = flapCase();
    c.schedule.rotateTime = 0;
    const std::vector<Frame> settling = plannedMotion(c);
    REQUIRE_FALSE(settling.empty());
    CHECK(settling.front().time == 0);
    CHECK(settling.back().coilAngle == 0);
    c.schedule.settleTime = 60;
    CHECK(plannedMotion(c).back().time <= 10);
    c.schedule.settleTime = 0;
    CHECK(plannedMotion(c).empty());
}
