// Powder that is added to a run: by the case, by an order, and by a run that goes on from a state.
#include <filesystem>

#include "host/backend/reference/reference.h"
#include "host/output/run_folder.h"
#include "tests/play/led.h"
#include "tests/sim/fake_backend.h"
#include "tests/support/catch.h"
#include "tests/support/folder.h"

using namespace vkdose;
using namespace vkdose::test;

namespace {

namespace fs = std::filesystem;

/// The small canister with two short doses, and these refills.
Case refilled(const std::string& refills) {
    const Folder folder;
    const fs::path mini = fs::path(VKDOSE_SOURCE_DIR) / "cases/mini.toml";
    return loadCase(folder.write("case.toml", "base = \"" + mini.string() + "\"\n" + R"(
[particles]
mass_g = 0.3
[coil]
speed_rpm = 400
[settle]
time_s = 0.05
[dose]
rotate_s = 0.04
rest_s = 0.01
[stop]
max_doses = 3
[sensors]
interval_s = 0.004
energy = true
)" + refills));
}

const std::string kSpoon = "[[refill]]\nname = \"spoon\"\nmass_g = 0.2\n";

struct Refills : Notebook {
    std::vector<AddedPowder> added;
    void onRefill(const AddedPowder& p) override { added.push_back(p); }
};

RunResult run(const Case& c, RunObserver& notes) {
    const std::atomic<bool> stop{false};
    return runCase(c, *makeReferenceBackend(), notes, stop);
}

Led ledReference(const Case& c) {
    return {nullptr, std::make_unique<Simulation>(c, makeReferenceBackend())};
}

void checkSameFiles(const fs::path& a, const fs::path& b) {
    for (const char* name : {"timeseries.csv", "doses.csv", "particles.csv"}) {
        INFO(name);
        REQUIRE(fs::exists(a / name));
        CHECK(readText(a / name) == readText(b / name));
    }
}

/// Goes on with what was stored, to its end.
void finish(const fs::path& folder, const Case& c) {
    FolderLock lock = lockRun(folder);
    const Checkpoint from = readCheckpoint(folder / kCheckpointName);
    RunFolder out(folder, std::move(lock), from, c, "reference");
    const std::atomic<bool> stop{false};
    Insertion filled = insertParticles(c);
    Derived derived = derive(c, filled);
    const auto backend = makeReferenceBackend();
    out.finish(c, runFilled(c, std::move(filled), std::move(derived), *backend, out, stop, &from.run));
}

}  // namespace

TEST_CASE("a refill comes at its time or before its dose, and the books of mass and energy hold") {
    const bool byTime = GENERATE(true, false);
    const Case c = refilled(kSpoon + (byTime ? "time_s = 0.0701\n" : "before_dose = 2\n"));
    Refills notes;
    const RunResult r = run(c, notes);
    REQUIRE(r.error.empty());
    REQUIRE(notes.added.size() == 1);
    REQUIRE(r.added.size() == 1);
    const AddedPowder& powder = r.added[0];
    CHECK(powder.name == "spoon");
    // 0.0701 s is between two readings; the first dose begins at 0.05 s and takes 0.05 s.
    CHECK(powder.time == Approx(byTime ? 0.072 : 0.1).margin(5e-5));
    CHECK(std::abs(powder.mass - 0.2e-3) < 0.01e-3);
    CHECK(r.ledger.filledMass() == Approx(r.filled.mass + powder.mass));
    for (const Sample& s : notes.samples) {
        double mass = 0;
        for (const double m : s.sensors.mass) mass += m;
        CHECK(mass == Approx(r.filled.mass + (s.time > powder.time + 1e-9 ? powder.mass : 0)));
        REQUIRE(s.energy);
        CHECK(std::abs(s.energy->residual()) < 1e-9 * s.energy->sum.loaded);
    }
    // It reached the powder that was there.
    const std::size_t first = r.filled.firstOf(0);
    CHECK(r.particles.status[first] != Status::Waiting);
    CHECK(r.particles.position[first].y < r.filled.waiting[0].particles.position[0].y + 0.01);
}

TEST_CASE("an order adds powder as the case that says the time does") {
    const Folder folder;
    const Led told = ledReference(refilled(kSpoon));
    CHECK_THROWS_AS(told.simulation->addPowder("fork"), std::invalid_argument);
    told.advance(0.072);
    CHECK(told.simulation->time() == Approx(0.072).margin(5e-5));
    told.simulation->addPowder("spoon");
    CHECK_THROWS_AS(told.simulation->addPowder("spoon"), std::logic_error);
    told.advance(kToEnd);
    told.simulation->store(folder / "told", false);
    const Led timed = ledReference(refilled(kSpoon + "time_s = 0.0701\n"));
    timed.advance(kToEnd);
    CHECK_THROWS_AS(timed.simulation->addPowder("spoon"), std::logic_error);
    timed.simulation->store(folder / "timed", false);
    checkSameFiles(folder / "told", folder / "timed");
}

TEST_CASE("stored before or after powder was added, a run goes on to the same end") {
    const Folder folder;
    const Case timed = refilled(kSpoon + "time_s = 0.0701\n"), told = refilled(kSpoon);
    const Led whole = ledReference(timed);
    whole.advance(kToEnd);
    whole.simulation->store(folder / "whole", false);

    const Led before = ledReference(timed);
    before.advance(0.068);
    before.simulation->store(folder / "before", false);
    finish(folder / "before", timed);
    checkSameFiles(folder / "whole", folder / "before");

    for (const double later : {0.0, 0.02}) {
        CAPTURE(later);
        const fs::path out = folder / (later > 0 ? "later" : "at once");
        const Led after = ledReference(told);
        after.advance(0.072);
        after.simulation->addPowder("spoon");
        if (later > 0) after.advance(later);
        after.simulation->store(out, false);
        finish(out, told);
        checkSameFiles(folder / "whole", out);
    }
}

TEST_CASE("a refill that has no room ends the run, and says so") {
    Case c = refilled("[[refill]]\nname = \"spoon\"\nmass_g = 2\nbefore_dose = 2\n");
    c.world.domain.high.y = insertParticles(c).fillHeight;
    Refills notes;
    const RunResult r = run(c, notes);
    CHECK(r.reason == StopReason::RunError);
    CHECK_THAT(r.error, Catch::Contains("refill \"spoon\""));
    CHECK(r.doses.size() == 1);
}
