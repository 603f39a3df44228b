#include "host/sim/checkpoint_pace.h"

#include <vector>

#include "tests/support/catch.h"

using namespace vkdose;

namespace {

/// When checkpoints are made [s after the start] by a run that looks every quarter of a second, up to `end`. Each takes
/// `work`.
std::vector<double> timesOf(double longest, double work, double end) {
    constexpr double kStart = 4096;
    CheckpointPace pace(longest, kStart);
    std::vector<double> times;
    double t = 0;
    while (t <= end) {
        if (pace.due(kStart + t)) {
            times.push_back(t);
            pace.stored(kStart + t, kStart + t + work);
            t += work;
        }
        t += 0.25;
    }
    return times;
}

}  // namespace

TEST_CASE("the first checkpoint comes after ten seconds, and each interval is as long as the run so far") {
    CHECK(timesOf(300, 0, 1300) == std::vector<double>{10, 20, 40, 80, 160, 320, 620, 920, 1220});
}

TEST_CASE("a case that wants checkpoints more often has them from the first on") {
    CHECK(timesOf(4, 0, 13) == std::vector<double>{4, 8, 12});
    CHECK(timesOf(15, 0, 60) == std::vector<double>{10, 20, 35, 50});
}

TEST_CASE("a checkpoint that takes long is rarer, and never rarer than the case says") {
    // 12 + 20 * 2 and 54 + 54: an interval begins when the checkpoint before is stored.
    CHECK(timesOf(300, 2, 200) == std::vector<double>{10, 52, 108});
    CHECK(timesOf(300, 16, 700) == std::vector<double>{10, 326, 642});
}

TEST_CASE("without an interval none is due by the clock") {
    CHECK(timesOf(0, 0, 5000).empty());
}
