// Refills and the rules that end a run.

#include "tests/sim/fake_backend.h"
#include "tests/support/catch.h"

using namespace vkdose;
using namespace vkdose::test;

namespace {

/// Adds a refill of so many particles to the case, and its powder to the filling.
void addRefill(Case& c, Insertion& filled, const Refill& refill, std::size_t particles) {
    c.refills.push_back(refill);
    c.filling.region.low.y = 0;
    Insertion::Waiting& powder = filled.waiting.emplace_back();
    powder.particles = smallFilling(particles).particles;
    for (Vec3& x : powder.particles.position) x.y = 0.5;  // far from the coil
    powder.particles.status.assign(particles, Status::Waiting);
    powder.mass = 1e-3 * static_cast<double>(particles);
}

/// All ten particles are out after the first dose; five more come before the third.
RunResult playRefilled(std::optional<int> beforeDose) {
    Case c = smallCase();
    c.schedule.stop.maxDoses = 5;
    Insertion filled = smallFilling();
    Refill spoon;
    spoon.name = "spoon";
    spoon.beforeDose = beforeDose;
    addRefill(c, filled, spoon, 5);
    FakeBackend backend;
    backend.dosed = [](std::uint64_t step) { return step < 120 ? 0 : step < 250 ? 10 : 15; };
    Notebook notes;
    const std::atomic<bool> stop{false};
    return runFilled(c, filled, Derived{}, backend, notes, stop);
}

/// Ten particles of 1 g, and two refills of so many when less than `mark` [kg] is there. From step 100 on a particle
/// leaves every ten steps, as long as there is one.
struct Marked {
    Case c = smallCase();
    Insertion filled = smallFilling();

    Marked(double mark, std::size_t particles) {
        Refill topUp;
        topUp.below = mark;
        for (const char* name : {"top-up-1", "top-up-2"}) {
            topUp.name = name;
            addRefill(c, filled, topUp, particles);
            topUp.again = true;
        }
        c.checkpoint.simulated = 0.001;
        c.world.domain.high.y = 10;  // what is in it never falls, and refills stand on each other
    }
    RunResult play(Notebook& notes, const RunCheckpoint* from = nullptr) const {
        FakeBackend backend;
        backend.dosed = [](std::uint64_t step) {
            return step < 100 ? 0 : std::min<std::uint64_t>(20, (step - 100) / 10);
        };
        const std::atomic<bool> stop{false};
        return runFilled(c, filled, Derived{}, backend, notes, stop, from);
    }
};

std::vector<std::uint64_t> stepsOf(const RunResult& r) {
    std::vector<std::uint64_t> steps;
    for (const AddedPowder& p : r.added) steps.push_back(p.step);
    return steps;
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

TEST_CASE("a refill at a mark comes at the first sample below it, and the next one when the powder was above again") {
    const Marked two(6e-3, 5);
    CheckpointKeeper notes;
    const RunResult r = two.play(notes);
    REQUIRE(r.error.empty());
    // Samples are at 120, 150, 170, 180, 210, 240: 8, 5, 8, 7, 4, 6 g before what is added then.
    CHECK(stepsOf(r) == std::vector<std::uint64_t>{150, 210});
    CHECK(r.ledger.filledCount() == 20);

    REQUIRE(notes.kept.size() > 10);
    for (const RunCheckpoint& from : notes.kept) {
        Notebook rest;
        const RunResult again = two.play(rest, &from);
        REQUIRE(again.error.empty());
        REQUIRE(stepsOf(again) == stepsOf(r));
        const std::size_t behind = notes.samples.size() - rest.samples.size();
        for (std::size_t i = 0; i < rest.samples.size(); ++i)
            CHECK(csvRow(kSampleColumns, rest.samples[i]) == csvRow(kSampleColumns, notes.samples[behind + i]));
    }
}

TEST_CASE("powder that was never above the mark brings no refill") {
    Notebook notes;
    CHECK(stepsOf(Marked(12e-3, 5).play(notes)).empty());
    // One particle does not lift it above the mark again: the second refill waits.
    CHECK(stepsOf(Marked(6e-3, 1).play(notes)) == std::vector<std::uint64_t>{150});
}
