// The yardstick does the work it claims to: the same law as the reference, on all pairs.

#include "host/bench/plain_loop.h"

#include "host/backend/reference/reference.h"
#include "host/bench/workloads.h"
#include "tests/support/catch.h"
#include "tests/support/near.h"

using namespace vkdose;
using namespace vkdose::bench;

namespace {

RuledWorld paperWorld() {
    return plans({})[1].make().world;
}

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
    RuledWorld world = paperWorld();
    world.skin = 0.1 * r;
    for (const int threads : {1, 2}) {
        PlainLoop loop(world, row(r), threads);
        CHECK(loop.listed() == Approx(4.0 / 3));
        CHECK(loop.touching() == Approx(2.0 / 3));
        loop.advance(2501);
        CHECK(loop.touching() == Approx(2.0 / 3));
    }
}

TEST_CASE("the plain loop's list is that of all pairs") {
    const Workload box = plans({})[1].make();
    const RuledWorld& world = box.world;
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

namespace {

constexpr double kRadius = 1e-3;  // [m]
constexpr double kThrown = 0.2;   // [m/s]
/// A position of a millimetre is rounded by a thousandth of what a step moves it, and a contact that begins, slips or
/// ends a step earlier for that lost or gained what a step of its force is worth: seldom, so that on average it is
/// less.
constexpr double kShift = 0.1, kOnAverage = 0.01;

/// Empty space in which every pair is in the list from the start.
RuledWorld space() {
    RuledWorld world = paperWorld();
    world.walls.clear();
    world.gravity = Vec3(0);
    world.skin = 1;
    world.domain = {};
    world.maxOverlapRatio = 1;
    return world;
}

/// Three spheres about to touch each other, spinning and thrown at their middle, each time another way.
Particles threesome(int seed) {
    const auto any = [&](int i) { return std::sin(double(1 + i + 12 * seed) * 2.3); };
    Particles p;
    for (int i = 0; i < 3; ++i) {
        const double angle = 2 * kPi / 3 * i, r = kRadius * (1 + 0.05 * any(4 * i));
        const Vec3 outwards(std::cos(angle), std::sin(angle), 0), aside(any(4 * i + 1), any(4 * i + 2), any(4 * i + 3));
        p.add(1.25 * kRadius * outwards, r, -kThrown * outwards + 0.3 * kThrown * aside,
              0.5 * kThrown / kRadius * Vec3(aside.z, aside.x, aside.y));
    }
    return p;
}

}  // namespace

TEST_CASE("the plain loop computes the contact law") {
    RuledWorld world = space();
    ContactParameters& p = world.law.of(ContactClass::ParticleParticle);
    // Damping begins with a jump, so that a contact found a step later, by rounding, costs its force for that step.
    p.gamma *= 0.1, p.gammaT *= 0.1, p.gammaR *= 0.1;
    SECTION("the paper's") {}
    SECTION("friction limited as in Luding, half the lever") {
        world.law.limitFriction(CoulombLimit::Luding);
        world.law.rollingLever = RollingLever::Half;
    }
    SECTION("beyond the plastic limit") {
        p.plasticityDepth = 0.003;
    }
    SECTION("spheres that slide and roll") {
        p.mu = p.muR = 0.02;
    }
    std::size_t contacts = 0, compared = 0;
    double squares = 0;
    for (int seed = 0; seed < 16; ++seed) {
        const Particles start = threesome(seed);
        const std::unique_ptr<Backend> reference = makeReferenceBackend();
        reference->load(world, start);
        PlainLoop one(world, start, 1, 1), two(world, start, 2, 1);
        const bool shares = seed < 2;  // on a busy machine two threads wait for each other in every step
        for (int leg = 0; leg < 40; ++leg) {
            reference->advance(10, 0);
            one.advance(10);
            if (shares) two.advance(10);
            contacts += reference->contacts().size();
            const Particles expected = reference->particles(), found = one.particles(), shared = two.particles();
            for (std::size_t i = 0; i < expected.size(); ++i) {
                INFO("seed " << seed << " leg " << leg << " sphere " << i);
                CHECK(test::near(found.velocity[i], expected.velocity[i], kThrown, kShift));
                CHECK(test::near(found.spin[i], expected.spin[i], kThrown / kRadius, kShift));
                const Vec3 v = (found.velocity[i] - expected.velocity[i]) / kThrown;
                const Vec3 w = (found.spin[i] - expected.spin[i]) / kThrown * kRadius;
                squares += glm::dot(v, v) + glm::dot(w, w);
                ++compared;
                if (!shares) continue;
                CHECK(test::near(shared.velocity[i], found.velocity[i], kThrown, kShift));
                CHECK(test::near(shared.spin[i], found.spin[i], kThrown / kRadius, kShift));
            }
        }
    }
    CHECK(contacts > 100);
    CHECK(test::near(std::sqrt(squares / double(compared)), 0, 1, kOnAverage));
}
