// A simulation that is stored, and what goes on from there.
#include <filesystem>

#include "host/output/run_folder.h"
#include "tests/play/led.h"
#include "tests/support/catch.h"
#include "tests/support/folder.h"

using namespace vkdose;
using namespace vkdose::test;

namespace {

namespace fs = std::filesystem;

/// Three doses, with a field at every second reading.
Case storedCase() {
    Case c = listedCase();
    FieldSensor s;
    s.name = "f";
    s.request.grid = {Vec3(0), Vec3(0.01, 0.06, 0.03), {1, 1, 3}};
    s.request.width = 0.01;
    s.interval = 0.06;
    c.fields.push_back(s);
    c.schedule.rampTime = 0.02;  // several calls between two readings
    return c;
}

void prepare(FakeBackend& fake) {
    fake.dosed = someDosed;
    fake.field = [](std::uint64_t step) {
        FieldPoint p;
        p.density = double(step);
        return p;
    };
}

/// The run of the program, from its start or from the state in the folder.
void runIn(const fs::path& folder, const Case& c, FakeBackend& fake, bool resume) {
    Insertion filled = insertParticles(c);
    Derived derived = derive(c, filled);
    const std::atomic<bool> stop{false};
    prepare(fake);
    std::optional<Checkpoint> from;
    std::optional<RunFolder> out;
    if (resume) {
        FolderLock lock = lockRun(folder);
        from = readCheckpoint(folder / kCheckpointName);
        out.emplace(folder, std::move(lock), *from, c, "fake");
    } else {
        out.emplace(folder, false, c, "fake");
    }
    const RunResult result =
        runFilled(c, std::move(filled), std::move(derived), fake, *out, stop, from ? &from->run : nullptr);
    out->finish(c, result);
}

void checkSameFiles(const fs::path& a, const fs::path& b) {
    for (const char* name : {"timeseries.csv", "doses.csv", "fields/f.csv", "particles.csv", "case.toml"}) {
        INFO(name);
        REQUIRE(fs::exists(a / name));
        CHECK(readText(a / name) == readText(b / name));
    }
}

}  // namespace

TEST_CASE("stored at any reading, it goes on as if it had not been, and so does the program from there") {
    const Case c = storedCase();
    const Folder folder;
    FakeBackend whole;
    runIn(folder / "whole", c, whole, false);
    std::size_t rests = 0;
    for (bool over = false; !over; ++rests) {
        CAPTURE(rests);
        const Led run = led(c, prepare);
        for (std::size_t i = 0; i < rests; ++i) run.advance(0);
        over = run.simulation->over();
        const double time = run.simulation->time();
        const std::size_t made = run.backend->calls.size();
        const fs::path stored = folder / std::to_string(rests);
        run.simulation->store(stored, false);
        CHECK(run.simulation->time() == time);
        CHECK(run.backend->calls.size() == made);
        CHECK(run.simulation->over() == over);
        CHECK_FALSE(run.simulation->takesOrders());
        CHECK(fs::exists(stored / kCheckpointName) != over);
        if (!over) {
            FakeBackend rest;
            runIn(stored, c, rest, true);
            std::vector<FakeBackend::Call> calls = run.backend->calls;
            calls.insert(calls.end(), rest.calls.begin(), rest.calls.end());
            CHECK(same(calls, whole.calls));
        }
        checkSameFiles(stored, folder / "whole");
        run.advance(kToEnd);
        CHECK(same(run.backend->calls, whole.calls));
    }
    CHECK(rests > 10);
}

TEST_CASE("it can be stored twice at a reading, and between two readings") {
    const Case c = storedCase();
    const Folder folder;
    FakeBackend whole;
    runIn(folder / "whole", c, whole, false);
    Simulation* simulation = nullptr;
    const Led run = led(c, [&](FakeBackend& b) {
        prepare(b);
        b.spoil = [&](std::uint64_t step, Sensors&) {
            if (step > 100 && step < 120) simulation->halt();  // in the ramp
        };
    });
    simulation = run.simulation.get();
    run.advance(kToEnd);
    REQUIRE(simulation->time() > simulation->last().time);
    simulation->store(folder / "between", false);
    simulation->store(folder / "again", false);
    for (const char* name : {"between", "again"}) {
        FakeBackend rest;
        runIn(folder / name, c, rest, true);
        CHECK(rest.calls.front().firstStep == run.backend->step);
        checkSameFiles(folder / name, folder / "whole");
    }
}

TEST_CASE("an order counts in the dose that goes on from the stored state") {
    Case c = storedCase();
    c.schedule.rampTime = 0;  // without an order the closed form is that of the plan
    c.schedule.rotateTime = 0.5;
    c.schedule.stop.maxDoses = 2;
    c.bulkDensity = 500;
    const bool stops = GENERATE(false, true);
    const Folder folder;
    const Led run = led(c, prepare);
    while (!run.simulation->takesOrders()) run.advance(0);
    if (stops)
        run.simulation->stopDrive();
    else
        run.simulation->changeSpeed(1);
    run.simulation->store(folder / "stored", false);
    FakeBackend rest;
    runIn(folder / "stored", c, rest, true);
    run.advance(kToEnd);
    run.simulation->store(folder / "end", false);
    CHECK(same(rest.calls, {run.backend->calls.end() - std::ptrdiff_t(rest.calls.size()), run.backend->calls.end()}));
    checkSameFiles(folder / "stored", folder / "end");
    CHECK(run.simulation->doses()[0].closedForm > 0);
    CHECK(run.simulation->doses()[0].stoppedBy == (stops ? StopCause::Order : StopCause::Time));
}

TEST_CASE("an order that ends the run leaves its end in the folder") {
    Case c = storedCase();
    c.schedule.rampTime = c.schedule.restTime = 0;
    c.schedule.stop.maxDoses = 1;
    const Folder folder;
    const Led run = led(c, prepare);
    while (!run.simulation->takesOrders()) run.advance(0);
    run.simulation->stopDrive();
    run.simulation->store(folder / "end", false);
    CHECK(run.simulation->over());
    CHECK(fs::exists(folder / "end" / "summary.json"));
    CHECK_FALSE(fs::exists(folder / "end" / kCheckpointName));
}

TEST_CASE("a folder in use is refused, and a former run only replaced if that is wanted") {
    const Folder folder;
    const Led run = led(storedCase(), prepare);
    folder.write("letter.txt", "mine");
    CHECK_THROWS_AS(run.simulation->store(folder.path(), false), FolderError);
    CHECK_THROWS_AS(run.simulation->store(folder.path(), true), FolderError);
    CHECK(readText(folder / "letter.txt") == "mine");
    run.simulation->store(folder / "run", false);
    run.advance(0.1);
    CHECK_THROWS_AS(run.simulation->store(folder / "run", false), FolderError);
    CHECK(readCheckpoint(folder / "run" / kCheckpointName).time == 0);
    run.simulation->store(folder / "run", true);
    CHECK(readCheckpoint(folder / "run" / kCheckpointName).time == run.simulation->time());
    run.advance(kToEnd);
    CHECK(run.simulation->over());
}

TEST_CASE("after an error what there is can be stored") {
    const Folder folder;
    const Led run = led(storedCase(), [](FakeBackend& b) {
        prepare(b);
        b.runErrorAt = 60;
    });
    run.simulation->advance(kToEnd);
    CHECK_THROWS_AS(run.wait(), RunError);
    run.simulation->store(folder / "run", false);
    CHECK(readText(folder / "run" / "summary.json").find("run_error") != std::string::npos);
}
