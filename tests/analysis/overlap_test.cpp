#include "host/analysis/overlap.h"

#include "host/core/random.h"
#include "tests/support/catch.h"
#include "tests/support/near.h"

using namespace vkdose;
using namespace vkdose::test;

namespace {

constexpr double kExact = 1e-12;  // of the radius: rounding of a few operations on millimetres

World boxWithCoil() {
    World world;
    world.walls.push_back(geometry::Plane{{0, -10e-3, 0}, {0, 1, 0}});
    world.coil = geometry::Coil{};
    world.coil->radius = 5e-3;
    world.coil->pitch = 20e-3;
    world.coil->wireRadius = 1e-3;
    world.coil->length = 40e-3;
    return world;
}

}  // namespace

TEST_CASE("overlaps of a pair: over the smaller radius, the deepest one counts for each") {
    Particles p;
    p.add({0, 20e-3, 0}, 2e-3);
    p.add({0, 22.7e-3, 0}, 1e-3);     // 0.3 mm deep
    p.add({3.9e-3, 20e-3, 0}, 2e-3);  // 0.1 mm deep in the first
    p.add({0, 40e-3, 0}, 1e-3);
    const auto ratio = overlapRatios(p, World{}, 0);
    CHECK(near(ratio[0], 0.3, 1, kExact));
    CHECK(near(ratio[1], 0.3, 1, kExact));
    CHECK(near(ratio[2], 0.05, 1, kExact));
    CHECK(ratio[3] == 0);
}

TEST_CASE("overlaps with a wall and with the coil where it has turned to") {
    Particles p;
    p.add({0, -9.2e-3, 10e-3}, 1e-3);    // 0.2 mm into the floor, far from the wire
    p.add({6.5e-3, 0, 0.001e-3}, 1e-3);  // at the wire's beginning while it is not turned: 0.5 mm deep
    const World world = boxWithCoil();
    const auto straight = overlapRatios(p, world, 0), turned = overlapRatios(p, world, kPi);
    CHECK(near(straight[0], 0.2, 1, kExact));
    CHECK(near(straight[1], 0.5, 1, 1e-3));  // the wire leaves it at an angle: by a thousandth within its radius
    CHECK(turned[1] == 0);
}

TEST_CASE("overlaps with a body where its own clock has brought it") {
    Particles p;
    p.add({0, 1.8e-3, 0}, 1e-3);
    World world;
    RigidBody lift;
    lift.shapes = {geometry::Ball{Vec3(0), 1e-3}};
    lift.course.motion = geometry::Slide{{0, 1e-3, 0}};
    lift.clock = Clock::Phases;
    world.bodies = {lift, lift};
    CHECK(near(overlapRatios(p, world, 0, 7)[0], 0.2, 1, kExact));
    CHECK(near(overlapRatios(p, world, 0, 7, {0, 0.3})[0], 0.5, 1, kExact));
}

TEST_CASE("overlaps leave out what is dosed or lost") {
    Particles p;
    for (int i = 0; i < 3; ++i) p.add({0, 1e-3 * i, 0}, 1e-3);
    p.status[1] = Status::Dosed;
    const auto ratio = overlapRatios(p, World{}, 0);
    CHECK(ratio == std::vector<double>{0, 0, 0});
    p.status[1] = Status::Active;
    CHECK(overlapRatios(p, World{}, 0)[0] > 0.9);
}

TEST_CASE("overlaps of a random crowd are those of all its pairs, whichever way it is longest") {
    for (const Vec3& size : {Vec3(60, 9, 8), Vec3(9, 60, 8), Vec3(8, 9, 60)}) {
        Particles p;
        for (std::uint64_t i = 0; i < 311; ++i) {
            const auto [u, v] = uniforms(5, Stream::Jitter, 2 * i);
            const auto [w, r] = uniforms(5, Stream::Jitter, 2 * i + 1);
            p.add(Vec3(u, v, w) * size * 1e-3, (0.5 + r) * 1e-3);
        }
        const auto ratio = overlapRatios(p, World{}, 0);
        for (std::size_t i = 0; i < p.size(); ++i) {
            double deepest = 0;
            for (std::size_t j = 0; j < p.size(); ++j)
                if (j != i)
                    deepest =
                        std::max(deepest, (p.radius[i] + p.radius[j] - glm::length(p.position[i] - p.position[j])) /
                                              std::min(p.radius[i], p.radius[j]));
            CHECK(near(ratio[i], deepest, 1, kExact));
        }
    }
}
