#include "host/analysis/blockage.h"

#include "tests/analysis/beds.h"
#include "tests/support/catch.h"
#include "tests/support/near.h"

using namespace vkdose;
using vkdose::test::layers;
using vkdose::test::near;
using vkdose::test::paperCanister;
using vkdose::test::paperCoil;

TEST_CASE("blocked: three doses that give nothing while powder is left") {
    const double filled = 0.048;
    CHECK(blockedAt(std::vector<double>{0.004, 0.008, 0.008, 0.00805, 0.0081}, filled) == 3);
    CHECK(blockedAt(std::vector<double>{0.004, 0.008, 0.008, 0.00805}, filled) == std::nullopt);  // two tell nothing
    CHECK(blockedAt(std::vector<double>{0.004, 0.008, 0.012, 0.016}, filled) == std::nullopt);
    CHECK(blockedAt(std::vector<double>{0, 0, 0}, filled) == 1);  // from the beginning
}

TEST_CASE("blocked: an empty canister is none, and an avalanche later does not undo it") {
    CHECK(blockedAt(std::vector<double>{0.04, 0.048, 0.048, 0.048, 0.048}, 0.048) == std::nullopt);
    CHECK(blockedAt(std::vector<double>{0.004, 0.004, 0.004, 0.004, 0.02}, 0.048) == 2);
}

TEST_CASE("blocked: what fell out while settling is no dose") {
    CHECK(blockedAt(std::vector<double>{0.001, 0.001, 0.001}, 0.048, {}, 0.001) == 1);
    CHECK(blockedAt(std::vector<double>{0.001, 0.001, 0.001}, 0.048) == std::nullopt);
}

TEST_CASE("no arch in a bed without voids, nor over an empty coil") {
    CHECK_FALSE(archAbove(paperCoil(), paperCanister(), layers(-10e-3, 40e-3)));
    CHECK_FALSE(archAbove(paperCoil(), paperCanister(), Particles()));
}

TEST_CASE("an arch: its height, and the length of coil under it") {
    // Layers up to y = 1 mm and again from y = 13 mm, over the rear half only; spheres of 1 mm radius.
    Particles bed = layers(-10e-3, 40e-3);
    for (std::size_t i = 0; i < bed.size(); ++i) {
        const Vec3& x = bed.position[i];
        if (x.z < 30e-3 && x.y > 1e-3 && x.y < 13e-3) bed.status[i] = Status::Dosed;
    }
    const std::optional<Arch> arch = archAbove(paperCoil(), paperCanister(), bed);
    REQUIRE(arch);
    // Lattice planes lie at -10, -8, ... mm: the void is between the sphere at 0 (top at 1) and that at 14 (bottom at
    // 13).
    CHECK(near(arch->height, 12e-3, 2e-3, 1e-9));
    CHECK(arch->z < 30e-3);
    // Slices are two diameters, 4 mm: seven of them and half of the eighth, which holds powder, lie in the rear half.
    CHECK(near(arch->length, 28e-3, 4e-3, 1e-9));
}

TEST_CASE("a hole smaller than two particles is no arch") {
    Particles bed = layers(-10e-3, 40e-3);
    for (std::size_t i = 0; i < bed.size(); ++i)
        if (bed.position[i].y > 1e-3 && bed.position[i].y < 3e-3) bed.status[i] = Status::Dosed;
    CHECK_FALSE(archAbove(paperCoil(), paperCanister(), bed));
}

TEST_CASE("a tunnel over the coil is an arch although powder stands beside it") {
    Particles bed = layers(-10e-3, 40e-3);
    for (std::size_t i = 0; i < bed.size(); ++i) {
        const Vec3& x = bed.position[i];
        if (std::abs(x.x) < 6e-3 && x.y > 1e-3 && x.y < 13e-3) bed.status[i] = Status::Dosed;
    }
    CHECK(archAbove(paperCoil(), paperCanister(), bed));
}

TEST_CASE("a void that ends below the coil's axis is the coil's own, no arch") {
    Particles bed = layers(-10e-3, 40e-3);
    for (std::size_t i = 0; i < bed.size(); ++i)
        if (bed.position[i].y < -1e-3) bed.status[i] = Status::Dosed;  // the next sphere begins at -1 mm
    CHECK_FALSE(archAbove(paperCoil(), paperCanister(), bed));
}
