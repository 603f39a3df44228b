// How the benchmark counts: on figures made up here, never on a clock.

#include "host/bench/measure.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "host/bench/plain_loop.h"

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

namespace {

/// Three spheres in a row: the first two overlap, the third is within the skin of the second.
Particles row(double r) {
    Particles p;
    p.add(Vec3(0), r);
    p.add(Vec3(1.9 * r, 0, 0), r);
    p.add(Vec3(3.95 * r, 0, 0), r);
    return p;
}

}  // namespace

TEST_CASE("the plain loop finds its neighbours and leaves the packing as it was") {
    constexpr double r = 1e-3;
    World world;
    ContactParameters law;
    law.k1 = 5000;
    law.gamma = 0.08;
    world.law.classes.fill(law);
    world.density = 1400;
    world.timeStep = 2e-6;
    world.skin = 0.1 * r;
    for (const int threads : {1, 2}) {
        PlainLoop loop(world, row(r), threads);
        CHECK(loop.listed() == Approx(4.0 / 3));
        CHECK(loop.touching() == Approx(2.0 / 3));
        loop.advance(1001);
        CHECK(loop.touching() == Approx(2.0 / 3));
    }
}

TEST_CASE("the plain loop's list is that of all pairs") {
    const Workload box = plans({})[1].make();
    World world = box.world;
    Particles few;
    for (std::size_t i = 0; i < box.particles.size(); i += 7)  // with holes, and an odd number of them
        few.add(box.particles.position[i], box.particles.radius[i]);
    std::size_t listed = 0;
    for (std::size_t i = 0; i < few.size(); ++i)
        for (std::size_t j = 0; j < few.size(); ++j)
            if (i != j && glm::length(few.position[i] - few.position[j]) < few.radius[i] + few.radius[j] + world.skin)
                ++listed;
    REQUIRE(listed > 100);
    CHECK(PlainLoop(world, few, 2).listed() == Approx(double(listed) / double(few.size())));
}
