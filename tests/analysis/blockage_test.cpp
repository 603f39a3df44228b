#include "host/analysis/blockage.h"

#include "tests/analysis/beds.h"
#include "tests/analysis/doses.h"
#include "tests/support/catch.h"
#include "tests/support/near.h"

using namespace vkdose;
using vkdose::test::dosesOf;
using vkdose::test::layers;
using vkdose::test::near;
using vkdose::test::paperCanister;
using vkdose::test::paperCoil;

TEST_CASE("blocked: three doses that give nothing while powder is left") {
    const double filled = 0.048;
    CHECK(blockedAt(dosesOf({4e-3, 4e-3, 0, 0.05e-3, 0.05e-3}), filled) == 3);
    CHECK(blockedAt(dosesOf({4e-3, 4e-3, 0, 0.05e-3}), filled) == std::nullopt);  // two tell nothing
    CHECK(blockedAt(dosesOf({4e-3, 4e-3, 4e-3, 4e-3}), filled) == std::nullopt);
    CHECK(blockedAt(dosesOf({0, 0, 0}), filled) == 1);  // from the beginning
    std::vector<Dose> cutShort = dosesOf({4e-3, 0, 0, 0});
    cutShort.back().complete = false;
    CHECK(blockedAt(cutShort, filled) == std::nullopt);
}

TEST_CASE("blocked: an empty canister is none, and an avalanche later does not undo it") {
    CHECK(blockedAt(dosesOf({40e-3, 8e-3, 0, 0, 0}), 0.048) == std::nullopt);
    CHECK(blockedAt(dosesOf({4e-3, 0, 0, 0, 16e-3}), 0.048) == 2);
}

TEST_CASE("blocked: a device that fills before it delivers is none") {
    CHECK(blockedAt(dosesOf({0, 0, 0, 4e-3, 4e-3}), 0.048) == std::nullopt);
    CHECK(blockedAt(dosesOf({0, 0, 0, 4e-3, 0, 0, 0}), 0.048) == 5);
}

TEST_CASE("blocked: what fell out while settling is no dose") {
    CHECK(blockedAt(dosesOf({0, 0, 0}, 1e-3), 0.048) == 1);
    CHECK(blockedAt(dosesOf({1e-3, 0, 0}), 0.048) == std::nullopt);
}

TEST_CASE("blocked: an empty canister that waits for its refill is none") {
    Supply supply = 0.030;
    supply.refills = {{4.5, 0.020}};
    CHECK(supply.until(4.4) == Approx(0.010));
    CHECK(supply.until(4.5) == Approx(0.030));
    CHECK(blockedAt(dosesOf({6e-3, 4e-3, 0, 0, 0, 5e-3}), supply) == std::nullopt);  // doses 3 to 5 had no powder
    CHECK(blockedAt(dosesOf({6e-3, 4e-3, 0, 0, 0, 0, 0, 0}), supply) == 6);
    CHECK(blockedAt(dosesOf({6e-3, 0, 0, 0, 0, 5e-3}), supply) == 2);  // 4 g were left
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
