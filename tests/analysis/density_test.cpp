#include "host/sim/density.h"

#include "host/core/random.h"
#include "tests/analysis/beds.h"
#include "tests/support/catch.h"
#include "tests/support/near.h"

using namespace vkdose;
using namespace vkdose::test;

namespace {

constexpr double kSolid = 1427;

World solid() {
    World world;
    world.density() = kSolid;
    return world;
}

const double kCubic = kSolid * kPi / 6;  // spheres on a cubic lattice that touch

}  // namespace

TEST_CASE("bed density of a cubic lattice, whatever the shape of its surface") {
    // The region's faces cut spheres; a face leaves at most the difference between a lattice plane and the mean of the
    // planes, a hundredth of the bed's 25 mm. Columns of two diameters hold two by two spheres exactly.
    Particles bed = layers(-10e-3, 50e-3);
    const geometry::Coil coil = paperCoil();
    const auto flat = bedDensity(solid(), bed, paperCanister(), &coil);
    REQUIRE(flat);
    CHECK(nearRelative(flat->density, kCubic, 0.02));

    for (std::size_t i = 0; i < bed.size(); ++i)  // emptied towards the rear, in steps as wide as the columns
        if (bed.position[i].y > 20e-3 + 4e-3 * std::floor((bed.position[i].z - 2e-3) / 4e-3) * 0.5)
            bed.status[i] = Status::Dosed;
    const auto sloped = bedDensity(solid(), bed, paperCanister(), &coil);
    REQUIRE(sloped);
    CHECK(sloped->volume < flat->volume);
    CHECK(nearRelative(sloped->density, kCubic, 0.05));
}

TEST_CASE("bed density of spheres strewn at random: the mass per volume that was strewn") {
    Particles bed;
    // 12,000 places in the box of the floor plan, from -11.5 to 60 mm: overlapping, but of known density.
    constexpr int kCount = 12000;
    for (std::uint64_t i = 0; i < kCount; ++i) {
        const auto [u, v] = uniforms(7, Stream::Jitter, 2 * i);
        const auto [w, unused] = uniforms(7, Stream::Jitter, 2 * i + 1);
        bed.add({(u - 0.5) * 23e-3, -11.5e-3 + v * 71.5e-3, w * 60e-3}, 1e-3);
    }
    const double sphere = kSolid * 4.0 / 3 * kPi * 1e-9;
    const double expected = kCount * sphere / (23e-3 * 71.5e-3 * 60e-3);
    const geometry::Coil coil = paperCoil();
    const auto measured = bedDensity(solid(), bed, paperCanister(), &coil);
    REQUIRE(measured);
    // Some 5000 spheres in the region scatter by 1.4 %; three times that.
    CHECK(nearRelative(measured->density, expected, 0.042));
    CHECK(nearRelative(measured->mass, measured->density * measured->volume, 1e-12));
}

TEST_CASE("density between the turns: the cylinder less the wire, where powder lies above") {
    const Particles bed = layers(-10e-3, 40e-3);
    const geometry::Coil coil = paperCoil();
    const auto measured = coilDensity(solid(), bed, paperCanister(), coil);
    REQUIRE(measured);
    const double outer = 11.4e-3;
    const double wire = kPi * 1e-6 * std::hypot(1.0, 2 * kPi * 10.4e-3 / 8.75e-3);
    CHECK(nearRelative(measured->volume, 60e-3 * (kPi * outer * outer - wire), 1e-12));
    // The lattice does not know the wire: its mass in the cylinder is that of the cubic lattice, to a face's 2 %.
    CHECK(nearRelative(measured->mass, kCubic * 60e-3 * kPi * outer * outer, 0.03));
}

TEST_CASE("density between the turns: slices without powder above are left out") {
    Particles bed = layers(-10e-3, 40e-3);
    for (std::size_t i = 0; i < bed.size(); ++i)
        if (bed.position[i].z < 32e-3 && bed.position[i].y > 0) bed.status[i] = Status::Dosed;
    const geometry::Coil coil = paperCoil();
    const auto all = coilDensity(solid(), layers(-10e-3, 40e-3), paperCanister(), coil);
    const auto half = coilDensity(solid(), bed, paperCanister(), coil);
    REQUIRE(half);
    CHECK(nearRelative(half->volume / all->volume, 28.0 / 60, 1e-9));  // slices of 4 mm: from 32 mm on
    CHECK(nearRelative(half->density, all->density, 0.03));
}

TEST_CASE("density between the turns: only beyond where it is asked for") {
    const geometry::Coil coil = paperCoil();
    const Particles bed = layers(-10e-3, 40e-3);
    const auto all = coilDensity(solid(), bed, paperCanister(), coil);
    const auto end = coilDensity(solid(), bed, paperCanister(), coil, 40e-3);
    REQUIRE(end);
    CHECK(nearRelative(end->volume / all->volume, 20.0 / 60, 1e-9));
    CHECK(nearRelative(end->density, all->density, 0.03));  // the cut through spheres, as above
}

TEST_CASE("density between the turns, whatever the width of the coil") {
    // From 22.8 to 24.6 mm: columns of just 4 mm would leave 2.8 mm over, or 0.2 mm with no sphere's centre in them.
    const Particles bed = layers(-14e-3, 40e-3);
    for (geometry::Coil coil = paperCoil(); coil.radius < 11.35e-3; coil.radius += 0.1e-3) {
        CAPTURE(coil.radius);
        const auto measured = coilDensity(solid(), bed, paperCanister(), coil);
        REQUIRE(measured);
        CHECK(measured->volume > 60e-3 * kPi * coil.radius * coil.radius);
    }
}

TEST_CASE("a bed that still falls has no settled density") {
    Case c;
    c.world = solid();
    c.canister = paperCanister();
    const Particles bed = layers(-10e-3, 40e-3);
    Settling settling;
    settling.fallSpeed = 1;
    settling.speed = 0.09;
    CHECK(settledDensity(c, settling, bed));
    settling.speed = 0.11;
    CHECK_FALSE(settledDensity(c, settling, bed));
}

TEST_CASE("too little powder has no density") {
    const geometry::Coil coil = paperCoil();
    CHECK_FALSE(bedDensity(solid(), Particles(), paperCanister(), &coil));
    CHECK_FALSE(bedDensity(solid(), layers(-10e-3, 12e-3), paperCanister(), &coil));
    CHECK_FALSE(coilDensity(solid(), layers(-10e-3, 0), paperCanister(), coil));
}

TEST_CASE("the closed form with a measured density") {
    CHECK(nearRelative(closedFormMass(471, paperCoil(), 3), 4.2011e-3, 1e-4));  // the paper's, 4.20 g, as printed
}

TEST_CASE("density in a round container, whatever its radius and its powders") {
    World two = solid();
    two.materials.push_back({"heavy", true, 8 * kSolid});
    Particles bed;
    constexpr double a = 0.6e-3;
    for (int i = -11; i <= 11; ++i)
        for (int j = 0; j < 12; ++j)
            for (int k = -11; k <= 11; ++k)
                bed.add({2 * a * i, a + 2 * a * j, 2 * a * k}, a, Vec3(0), Vec3(0),
                        j < 3 ? int(two.materials.size()) - 1 : kFirstPowder);
    // At 13.5 and 14.2 mm seven columns are as wide as the plan but for the last bit.
    for (const int tenths : {130, 135, 138, 142, 145}) {
        CAPTURE(tenths);
        const auto found = containerDensity(two, bed, tenths * 1e-4);
        REQUIRE(found);
        CHECK(nearRelative(found->solid / found->volume, kPi / 6, 0.03));
        CHECK(found->density > 1.5 * kCubic);  // the lowest layers are of the heavy powder
    }
}

TEST_CASE("density in a round container, of a cubic lattice and below the lowest place of its surface") {
    Particles bed;
    constexpr double a = 1e-3;
    for (int i = -8; i <= 8; ++i)
        for (int j = 0; j < 20; ++j)
            for (int k = -8; k <= 8; ++k) bed.add({2 * a * i, a + 2 * a * j, 2 * a * k}, a);
    const auto full = containerDensity(solid(), bed, 14e-3);
    REQUIRE(full);
    CHECK(nearRelative(full->volume, kPi * 12e-3 * 12e-3 * (40e-3 - 4e-3), 1e-9));
    // The faces cut spheres; a lattice of points tells their parts to about a hundredth of the region.
    CHECK(nearRelative(full->density, kCubic, 0.02));
    // A dip of 10 mm in the middle, over all of a column.
    for (std::size_t i = 0; i < bed.size(); ++i)
        if (std::abs(bed.position[i].x) < 5e-3 && std::abs(bed.position[i].z) < 5e-3 && bed.position[i].y > 30e-3)
            bed.status[i] = Status::Dosed;
    const auto dipped = containerDensity(solid(), bed, 14e-3);
    REQUIRE(dipped);
    CHECK(nearRelative(dipped->volume, kPi * 12e-3 * 12e-3 * (30e-3 - 4e-3), 1e-9));
    CHECK(nearRelative(dipped->density, kCubic, 0.02));
    CHECK_FALSE(containerDensity(solid(), bed, 3e-3));  // no hundred spheres
    CHECK_FALSE(containerDensity(solid(), bed, 1e-3));
}
