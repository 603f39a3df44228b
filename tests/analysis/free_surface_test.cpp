#include "host/analysis/free_surface.h"

#include <stdexcept>

#include "tests/support/catch.h"
#include "tests/support/near.h"

using namespace vkdose;
using namespace vkdose::test;

namespace {

constexpr double kFloor = -10e-3;  // its lowest point, in a canister 20 mm wide

Canister box(bool flat) {
    Canister can;
    can.length = 40e-3;
    can.width = 20e-3;
    can.height = 60e-3;
    can.flatFloor = flat;
    return can;
}

}  // namespace

TEST_CASE("the surface of an empty canister is its floor") {
    for (const double h : surfaceProfile(Particles{}, box(true), 7, Across::Mean).height) CHECK(h == 0);
    // A half-cylinder of radius R lies R (1 - pi/4) over its lowest point in the mean.
    const double mean = 10e-3 * (1 - kPi / 4);
    const auto trough = surfaceProfile(Particles{}, box(false), 20, Across::Mean);
    for (const double h : trough.height) CHECK(near(h, mean, 10e-3, 1e-3));  // 80 points across a steep edge
    // Near the axis it is flat: x^2 / 2R, in the mean over 1 mm to either side a third of 1/20 mm.
    for (const double h : surfaceProfile(Particles{}, box(false), 20, Across::Mean, {-1e-3, 1e-3}).height)
        CHECK(near(h, 1e-6 / (2 * 10e-3) / 3, 10e-3, 1e-4));
    CHECK(near(trough.z.front(), 1e-3, 1e-3, 1e-12));
    CHECK(near(trough.z.back(), 39e-3, 1e-3, 1e-12));
}

TEST_CASE("the surface over one sphere: what stands under its upper half, over the column") {
    Particles p;
    const double r = 4e-3, y = 2e-3;
    p.add({1e-3, y, 20e-3}, r);
    const auto profile =
        surfaceProfile(p, box(true), 4, Across::Mean);  // columns of 10 x 20 mm; the sphere is over two of them
    // Its shadow pi r^2 at the height of its middle, and half a ball on top of that; half of both to each column.
    const double volume = (kPi * r * r * (y - kFloor) + 2.0 / 3 * kPi * r * r * r) / 2;
    const double expected = volume / (10e-3 * 20e-3);
    CHECK(near(profile.height[0], 0, r, 1e-12));
    CHECK(near(profile.height[1], expected, r, 0.05));  // its edge on a lattice of 1.25 mm
    CHECK(near(profile.height[2], expected, r, 0.05));
    CHECK(near(profile.height[3], 0, r, 1e-12));

    p.status[0] = Status::Dosed;
    CHECK(surfaceProfile(p, box(true), 4, Across::Mean).height[1] == 0);
}

TEST_CASE("the surface as seen from the side: the outline, and nothing where there is no powder") {
    Particles p;
    const double r = 5e-3, y = 2e-3;
    p.add({0.625e-3, y, 20e-3}, r);         // over points of the lattice, which is 1.25 mm fine
    p.add({-6e-3, y - 4e-3, 20e-3}, 3e-3);  // behind it
    for (const bool flat : {true, false}) {
        const auto profile = surfaceProfile(p, box(flat), 4, Across::Highest);
        // Half the disc's outline over one column: its radius at the height of its middle, and a quarter disc.
        const double expected = (r * (y - kFloor) + kPi * r * r / 4) / 10e-3;
        CHECK(profile.height[0] == 0);
        CHECK(near(profile.height[1], expected, r, 0.01));  // four points for a quarter circle
        CHECK(near(profile.height[2], expected, r, 0.01));
        CHECK(profile.height[3] == 0);
    }
}

TEST_CASE("the surface of a slope of small spheres is a slope") {
    // Spheres 0.2 mm apart whose middles lie on y = z/2: the envelope is that plane, moved out by the radius.
    Particles p;
    const double r = 1e-3, slope = 0.5;
    for (int i = -60; i <= 60; ++i)
        for (int k = -10; k <= 210; ++k) p.add({0.2e-3 * i, slope * 0.2e-3 * k, 0.2e-3 * k}, r);
    const auto profile = surfaceProfile(p, box(true), 40, Across::Mean);
    for (std::size_t i = 2; i + 2 < profile.z.size(); ++i) {
        const double plane = slope * profile.z[i] + r * std::hypot(1.0, slope) - kFloor;
        CHECK(near(profile.height[i], plane, r, 0.01));  // 0.2 mm apart leave dents of (0.1 mm)^2 / 2r and less
    }
}

TEST_CASE("the surface in a strip is that of the powder there") {
    Particles p;
    for (int i = 0; i <= 50; ++i)
        for (int k = 0; k <= 200; ++k) p.add({0.2e-3 * i, 5e-3, 0.2e-3 * k}, 1e-3);  // only x >= 0
    const double full = 5e-3 + 1e-3 - kFloor;
    for (const double h : surfaceProfile(p, box(true), 40, Across::Mean, {1e-3, 9e-3}).height)
        CHECK(near(h, full, 1e-3, 0.02));
    for (const double h : surfaceProfile(p, box(true), 40, Across::Mean, {-9e-3, -1.1e-3}).height) CHECK(h == 0);
    CHECK_THROWS_AS(surfaceProfile(p, box(true), 0, Across::Mean), std::invalid_argument);
    CHECK_THROWS_AS(surfaceProfile(p, box(true), 40, Across::Mean, {11e-3, 12e-3}), std::invalid_argument);
}
