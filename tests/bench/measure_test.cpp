// How the benchmark counts: on figures made up here, never on a clock.

#include "host/bench/measure.h"
#include "tests/support/catch.h"

using namespace vkdose;
using namespace vkdose::bench;

TEST_CASE("median and range of a few values") {
    CHECK(spreadOf({3, 1, 2}).median == 2);
    CHECK(spreadOf({4, 1, 3, 2}).median == 2.5);
    CHECK(spreadOf({3, 1, 2}).low == 1);
    CHECK(spreadOf({3, 1, 2}).high == 3);
    CHECK(spreadOf({7}).median == 7);
}

TEST_CASE("the warm-up comes first, and every repeat makes the same steps") {
    std::vector<std::uint32_t> calls;
    std::vector<std::size_t> callsAtMeeting;
    Effort effort;
    effort.repeats = 3;
    effort.seconds = 1e-9;  // the shortest trial says enough
    effort.mostWarmSteps = 40;
    effort.meet = [&] { callsAtMeeting.push_back(calls.size()); };
    const Speed speed = time([&](std::uint32_t n) { calls.push_back(n); }, 10, 1000, effort);
    REQUIRE(calls.size() == 5);  // warm-up, trial, repeats
    CHECK(calls[0] == 40);
    CHECK(calls[2] == speed.steps);
    CHECK(calls[4] == speed.steps);
    CHECK(callsAtMeeting == std::vector<std::size_t>{2, 3, 4});
    REQUIRE(speed.rates.size() == 3);
    for (const double rate : speed.rates) CHECK(rate > 0);
}
