#include "host/sim/timeline.h"

#include "host/core/error.h"
#include "tests/sim/fake_backend.h"
#include "tests/support/catch.h"

using namespace vkdose;
using vkdose::test::smallCase;

TEST_CASE("phases follow each other in whole steps") {
    const Timeline t(smallCase());
    CHECK(t.settleSteps() == 100);
    CHECK(t.rotateSteps() == 50);
    CHECK(t.restSteps() == 20);
    struct Expected {
        std::uint64_t step;
        Phase phase;
        int dose;
        std::uint64_t end;
    };
    for (const Expected& e : {Expected{0, Phase::Settle, 0, 100}, Expected{99, Phase::Settle, 0, 100},
                              Expected{100, Phase::Rotate, 1, 150}, Expected{149, Phase::Rotate, 1, 150},
                              Expected{150, Phase::Rest, 1, 170}, Expected{170, Phase::Rotate, 2, 220},
                              Expected{239, Phase::Rest, 2, 240}, Expected{240, Phase::Rotate, 3, 290}}) {
        const Timeline::Stretch s = t.at(e.step);
        CAPTURE(e.step);
        CHECK(s.phase == e.phase);
        CHECK(s.dose == e.dose);
        CHECK(s.end == e.end);
        CHECK((s.rate != 0) == (e.phase == Phase::Rotate));
    }
}

TEST_CASE("the coil turns the way that conveys, whatever its hand") {
    Case c = smallCase();
    const double left = Timeline(c).at(100).rate;
    const double leftSense = Timeline(c).conveyingSense();
    c.world.coil->hand = 1;
    const double right = Timeline(c).at(100).rate;
    CHECK(left == Approx(4));  // a left-handed coil conveys to +z turning anticlockwise about it
    CHECK(right == Approx(-4));
    CHECK(leftSense == 1);
    CHECK(Timeline(c).conveyingSense() == -1);
}

TEST_CASE("durations are rounded to the nearest step, never to nothing") {
    Case c = smallCase();
    c.schedule.settleTime = 0.1004;
    CHECK(Timeline(c).settleSteps() == 100);
    c.schedule.settleTime = 0.1006;
    CHECK(Timeline(c).settleSteps() == 101);
    c.schedule.settleTime = 0.0004;
    CHECK_THROWS_AS(Timeline(c), CaseError);
    c.schedule.settleTime = -1;
    CHECK_THROWS_AS(Timeline(c), CaseError);
    c.schedule.settleTime = std::numeric_limits<double>::quiet_NaN();
    CHECK_THROWS_AS(Timeline(c), CaseError);
    c.schedule.settleTime = 0;
    CHECK(Timeline(c).at(0).phase == Phase::Rotate);
    c.world.timeStep = 0;
    CHECK_THROWS_AS(Timeline(c), CaseError);
}

TEST_CASE("sensors are read at multiples of the interval and at phase ends") {
    const Timeline t(smallCase());
    std::vector<std::uint64_t> at;
    for (std::uint64_t s = 0; s < 170;) at.push_back(s = t.nextSample(s));
    CHECK(at == std::vector<std::uint64_t>{30, 60, 90, 100, 120, 150, 170});
}

TEST_CASE("frames are due at the start, at whole sensor intervals, when settled and at the end") {
    Case c = smallCase();
    CHECK_FALSE(Timeline(c).frameDue(0));
    const auto due = [&c] {
        const Timeline t(c);
        std::vector<std::uint64_t> at;
        for (std::uint64_t s = 0; s <= 240; ++s)
            if (t.frameDue(s)) at.push_back(s);
        return at;
    };
    c.frames.interval = 0.06;
    CHECK(due() == std::vector<std::uint64_t>{0, 60, 100, 120, 180, 240});
    c.frames.interval = 0.07;  // of two sensor intervals of 0.03
    CHECK(due() == std::vector<std::uint64_t>{0, 60, 100, 120, 180, 240});
    c.schedule.stop.endTime = 0.125;
    CHECK(Timeline(c).frameDue(125));
    CHECK_FALSE(Timeline(c).frameDue(124));
    // Each is where a sample ends, so that nothing is cut on its account.
    const Timeline t(c);
    for (std::uint64_t s = 0; s < 125; s = t.nextSample(s))
        for (std::uint64_t between = s + 1; between < t.nextSample(s); ++between) CHECK_FALSE(t.frameDue(between));
}

TEST_CASE("the end time cuts a phase, and a case without doses ends after settling") {
    Case c = smallCase();
    c.schedule.stop.endTime = 0.125;
    const Timeline cut(c);
    CHECK(cut.at(110).end == 125);
    CHECK_FALSE(cut.over(124));
    CHECK(cut.over(125));
    CHECK(cut.cutByEndTime(125));
    CHECK(cut.stepsUntilDose(5) == 125);

    c.schedule.stop.endTime = std::numeric_limits<double>::infinity();
    CHECK_FALSE(Timeline(c).over(1000000000000));
    c.schedule.rotateTime = 0;
    const Timeline settleOnly(c);
    CHECK_FALSE(settleOnly.hasDoses());
    CHECK_FALSE(settleOnly.over(99));
    CHECK(settleOnly.over(100));
    CHECK_FALSE(settleOnly.cutByEndTime(100));
}
