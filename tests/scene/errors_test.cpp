// Errors that the user must see: particles lost, overlaps no law covers, tables that are full.

#include <fmt/format.h>

#include "host/model/case.h"
#include "tests/support/gpu.h"
#include "tests/support/places.h"

using namespace vkdose;
using namespace vkdose::test;
using Catch::Contains;

namespace {

void requireRunError(const RuledWorld& w, const Particles& p, std::uint32_t steps, const std::string& words) {
    auto device = gpu();
    device->load(w, p);
    REQUIRE_THROWS_AS(device->advance(steps, 0), RunError);
    auto again = gpu();
    again->load(w, p);
    REQUIRE_THROWS_WITH(again->advance(steps, 0), Contains(words));
    requireClean(*device);
}

}  // namespace

TEST_CASE("a particle that leaves the domain is named with its place and time") {
    RuledWorld w = emptyWorld();
    w.domain = {Vec3(-0.01), Vec3(0.01)};
    Particles p;
    p.add({0, 0, 0}, 1e-3);
    p.add({0.0099, 0, 0}, 1e-3, {1, 0, 0});
    requireRunError(w, p, 200, "particle 1 ");
    requireRunError(w, p, 200, "left the domain");
    requireRunError(w, p, 200, "domain.high");
}

TEST_CASE("a backend that could not load a world has no state to give, and loads another") {
    RuledWorld w = emptyWorld();
    w.walls.assign(29, geometry::Plane{{0, -1, 0}, {0, 1, 0}});  // more than a device holds
    Particles p;
    p.add({0, 0, 0}, 1e-3);
    auto device = gpu();
    CHECK_THROWS_WITH(device->load(w, p), Contains("29 walls"));
    CHECK_THROWS_AS(device->particles(), RunError);
    CHECK_THROWS_AS(device->contacts(), RunError);
    CHECK_THROWS_AS(device->advance(1, 0), RunError);
    w.walls.erase(w.walls.begin() + 1, w.walls.end());
    device->load(w, p);
    device->advance(1, 0);
    CHECK(device->particles().size() == 1);
    requireClean(*device);
}

TEST_CASE("a velocity that is not a number is reported, not carried on") {
    Particles p;
    p.add({0, 0, 0}, 1e-3, {std::nan(""), 0, 0});
    requireRunError(emptyWorld(), p, 2, "not a number");
}

TEST_CASE("two spheres in one place are reported") {
    Particles p;
    p.add({0, 0, 0}, 1e-3);
    p.add({1e-4, 0, 0}, 1e-3);
    requireRunError(emptyWorld(), p, 1, "overlap");
}

TEST_CASE("how deep an overlap may be is the world's choice") {
    RuledWorld w = emptyWorld();
    w.timeStep = 1e-8;
    Particles p;
    p.add({0, 0, 0}, 1e-3);
    p.add({1.7e-3, 0, 0}, 1e-3);
    for (const double limit : {0.29, 0.31}) {
        w.maxOverlapRatio = limit;
        auto device = gpu();
        auto reference = makeReferenceBackend();
        device->load(w, p);
        reference->load(w, p);
        if (limit < 0.3) {
            CHECK_THROWS_AS(device->advance(1, 0), RunError);
            CHECK_THROWS_AS(reference->advance(1, 0), RunError);
        } else {
            CHECK(device->advance(1, 0).maxOverlapRatio == Approx(0.3).epsilon(1e-5));
            CHECK(reference->advance(1, 0).maxOverlapRatio == Approx(0.3));
        }
    }
}

TEST_CASE("a full neighbour row is reported", "[every-driver]") {
    Particles p;
    p.add({0, 0, 0}, 1e-3);
    // Ninety small spheres inside the large one's reach, apart from it and from each other.
    for (int i = 0; i < 90; ++i) {
        const double z = -1 + (2 * i + 1) / 90.0, phi = i * 2.399963;
        p.add(1.21e-3 * Vec3(std::sqrt(1 - z * z) * std::cos(phi), std::sqrt(1 - z * z) * std::sin(phi), z), 1.0e-4);
    }
    RuledWorld w = emptyWorld();
    w.timeStep = 1e-8;
    w.skin = 0.15e-3;
    requireRunError(w, p, 1, "more neighbours than a row holds");
}

TEST_CASE("a skin that fills a row at the first step, and no other, is refused with the case") {
    const auto file = std::filesystem::path(sourceDir()) / "cases" / "mini.toml";
    const Case c = loadCase(file);
    const Insertion filled = insertParticles(c);
    int refused = 0, runs = 0;
    for (const double skin : {0.6, 1.5, 2.0, 2.2, 2.4, 2.6, 2.8, 3.0, 3.2, 3.5, 4.0, 6.0, 21.0}) {
        CAPTURE(skin);
        RuledWorld world{c.world, c.settlingLaw};
        world.skin = skin * 1e-3;
        auto device = gpu();
        device->load(world, filled.particles);
        try {
            device->advance(1, 0);
            CHECK_NOTHROW(loadCase(file, {fmt::format("time.skin_mm={}", skin)}));
            ++runs;
        } catch (const RunError& error) {
            CHECK_THAT(error.what(), Contains("more neighbours than a row holds"));
            CHECK_THROWS_WITH(loadCase(file, {fmt::format("time.skin_mm={}", skin)}),
                              Contains("time.skin_mm") && Contains("give about 0.66"));
            ++refused;
        }
        requireClean(*device);
    }
    CHECK(refused > 1);
    CHECK(runs > 1);
}

TEST_CASE("more neighbours and contacts than the tables are made for are reported") {
    // A lattice squeezed until every sphere overlaps three shells of others, far denser than any packing.
    const double radius = 1e-3,
                 spacing = 2 * radius / GENERATE(1.75, 1.45);  // 26 others overflow the rows, 18 the pairs
    Particles p;
    for (int i = 0; i < 12 * 12 * 12; ++i) p.add(spacing * Vec3(i % 12, i / 12 % 12, i / 144), radius);
    RuledWorld w = emptyWorld();
    w.timeStep = 1e-9;
    w.skin = 1e-6;
    w.maxOverlapRatio = 2;
    requireRunError(w, p, 1, "finds no room in the tables of neighbours and contacts");
}

TEST_CASE("more particles around one than the neighbour search may look at are reported") {
    Particles p;
    // The large sphere, far away, makes the cells of the search large; the small ones, apart from each other, fill one.
    p.add({0.5, 0, 0}, 0.01);
    for (int i = 0; i < 17 * 17 * 17; ++i) p.add(3e-4 * Vec3(1 + i % 17, 1 + i / 17 % 17, 1 + i / 289), 1e-4);
    RuledWorld w = emptyWorld();
    w.timeStep = 1e-8;
    w.skin = 1e-5;
    requireRunError(w, p, 1, "has thousands of others around it");
}

TEST_CASE("a dosed particle is counted once and its neighbours forget it", "[every-driver]") {
    RuledWorld w = canisterWorld();
    w.walls.clear();
    w.coil.reset();
    Particles p;
    p.add({0, 0, 0.0699}, 1e-3, {0, 0, 0.5});
    p.add({0, 0, 0.0679}, 1e-3, {0, 0, 0.5});
    p.add({0, 0, 0.03}, 1e-3);
    auto device = gpu();
    device->load(w, p);
    const Sensors before = device->advance(1, 0);
    CHECK(before.count == std::array<std::uint64_t, 4>{1, 2, 0, 0});
    const Sensors after = device->advance(300, 0);
    CHECK(after.count == std::array<std::uint64_t, 4>{1, 1, 1, 0});
    const Sensors later = device->advance(600, 0);
    CHECK(later.count == std::array<std::uint64_t, 4>{1, 1, 1, 0});
    CHECK(device->contacts().empty());
    CHECK(device->particles().status[0] == Status::Dosed);
    requireClean(*device);
}

TEST_CASE("a device that is not there is refused by name") {
    REQUIRE_THROWS_WITH(makeVulkanBackend(vk::DeviceChoice{"no such device", false}), Contains("no such device"));
}
