// The frames that a run takes.

#include "tests/sim/fake_backend.h"
#include "tests/support/catch.h"

using namespace vkdose;
using namespace vkdose::test;

namespace {

std::vector<std::uint64_t> framed(const Notebook& notes) {
    std::vector<std::uint64_t> at;
    for (const Frame& f : notes.frames) at.push_back(f.step);
    return at;
}

}  // namespace

TEST_CASE("frames show the state at their instant, the first and the last of the run included") {
    Case c = smallCase();
    c.frames.interval = 0.06;
    FakeBackend backend;
    Notebook notes;
    play(c, backend, notes);
    CHECK(framed(notes) == std::vector<std::uint64_t>{0, 60, 100, 120, 180, 240, 300, 310});
    for (const Frame& f : notes.frames) {
        CAPTURE(f.step);
        CHECK(f.particles.size() == 10);
        CHECK(f.contacts.at(0).maxOverlap == double(f.step));
        CHECK(f.time == double(f.step) * 1e-3);
    }
    CHECK(notes.frames[1].phase == Phase::Settle);
    CHECK(notes.frames[2].dose == 0);
    CHECK(notes.frames[3].phase == Phase::Rotate);
    CHECK(notes.frames[3].dose == 1);
    CHECK(notes.frames[3].coilAngle == Approx(4 * 0.02));
    CHECK(notes.frames.back().phase == Phase::Rest);
    CHECK(notes.frames.back().dose == 3);

    SECTION("nobody wants them") {
        FakeBackend other;
        Notebook none;
        none.wantsFrames = false;
        play(c, other, none);
        CHECK(none.frames.empty());
    }
    SECTION("the case wants none") {
        FakeBackend other;
        Notebook none;
        play(smallCase(), other, none);
        CHECK(none.frames.empty());
        // And whether it does changes no call of the backend.
        REQUIRE(other.calls.size() == backend.calls.size());
        for (std::size_t i = 0; i < other.calls.size(); ++i) CHECK(other.calls[i].steps == backend.calls[i].steps);
    }
}

TEST_CASE("a run that ends early: a frame of its end, but none of an interruption or a failure") {
    Case c = smallCase();
    c.frames.interval = 0.06;
    FakeBackend backend;
    Notebook notes;
    SECTION("end time") {
        c.schedule.stop.endTime = 0.125;
        play(c, backend, notes);
        CHECK(framed(notes) == std::vector<std::uint64_t>{0, 60, 100, 120, 125});
    }
    SECTION("no doses") {
        c.schedule.rotateTime = 0;
        play(c, backend, notes);
        CHECK(framed(notes) == std::vector<std::uint64_t>{0, 60, 100});
    }
    SECTION("interrupted") {
        play(c, backend, notes, true);
        CHECK(framed(notes) == std::vector<std::uint64_t>{0});
    }
    SECTION("failed") {
        backend.runErrorAt = 90;
        play(c, backend, notes);
        CHECK(framed(notes) == std::vector<std::uint64_t>{0, 60});
    }
}

TEST_CASE("a run that goes on from any checkpoint takes the frames after it, once each") {
    Case c = smallCase();
    c.frames.interval = 0.06;
    c.checkpoint.wall = 0;
    c.checkpoint.simulated = 0.001;  // after every call
    FakeBackend backend;
    CheckpointKeeper notes;
    play(c, backend, notes);
    const std::vector<std::uint64_t> all = framed(notes);
    REQUIRE(notes.kept.size() > 10);
    for (const RunCheckpoint& from : notes.kept) {
        FakeBackend second;
        Notebook after;
        const std::atomic<bool> stop{false};
        Derived derived;
        derived.massPerDose = 2e-3;
        runFilled(c, smallFilling(), derived, second, after, stop, &from);
        const std::uint64_t begin = from.backend.one<std::uint64_t>("step");
        CAPTURE(begin);
        std::vector<std::uint64_t> expected;
        for (const std::uint64_t s : all)
            if (s > begin) expected.push_back(s);
        CHECK(framed(after) == expected);
    }
}
