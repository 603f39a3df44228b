// Refills and the rules that end a run.

#include "tests/sim/fake_backend.h"
#include "tests/support/catch.h"

using namespace vkdose;
using namespace vkdose::test;

namespace {

/// All ten particles are out after the first dose; five more come before the third.
RunResult playRefilled(std::optional<int> beforeDose) {
    Case c = smallCase();
    c.schedule.stop.maxDoses = 5;
    c.refills = {{.name = "spoon", .mass = 5e-3, .time = {}, .beforeDose = beforeDose}};
    Insertion filled = smallFilling();
    Insertion::Waiting& spoon = filled.waiting.emplace_back();
    spoon.particles = smallFilling(5).particles;
    for (Vec3& x : spoon.particles.position) x.y = 0.5;  // far from the coil
    c.filling.region.low.y = 0;
    spoon.particles.status.assign(5, Status::Waiting);
    spoon.mass = 5e-3;
    FakeBackend backend;
    backend.dosed = [](std::uint64_t step) { return step < 120 ? 0 : step < 250 ? 10 : 15; };
    Notebook notes;
    const std::atomic<bool> stop{false};
    return runFilled(c, filled, Derived{}, backend, notes, stop);
}

}  // namespace

TEST_CASE("an empty canister ends a run, unless the case will refill it") {
    const RunResult never = playRefilled(std::nullopt);
    CHECK(never.reason == StopReason::Empty);
    CHECK(never.doses.size() == 1);
    CHECK(never.added.empty());
    const RunResult later = playRefilled(3);
    REQUIRE(later.error.empty());
    CHECK(later.reason == StopReason::Empty);
    REQUIRE(later.doses.size() == 3);
    CHECK(later.doses[1].mass == 0);
    CHECK(later.doses[2].particles == 5);
    REQUIRE(later.added.size() == 1);
    CHECK(later.added[0].step == 240);
    CHECK(later.ledger.filledCount() == 15);
}
