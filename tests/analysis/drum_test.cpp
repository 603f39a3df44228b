// The angle of the surface in a drum, on beds whose slope is known.
#include "host/analysis/drum.h"

#include <stdexcept>

#include "tests/support/catch.h"
#include "tests/support/near.h"

using namespace vkdose;
using namespace vkdose::test;

namespace {

/// Spheres on a cubic lattice that is turned by `angle` about z, in a drum of radius 30 mm, up to a plane surface that
/// passes `below` the axis.
Particles bed(double angle, double below) {
    constexpr double a = 0.5e-3, kRadius = 30e-3;
    Particles p;
    for (int i = -30; i <= 30; ++i)
        for (int j = 0; j < 60; ++j)
            for (int k = 0; k < 4; ++k) {
                const double s = 2 * a * i, u = -below - a - 2 * a * j;
                if (std::hypot(s, u) > kRadius - a) continue;
                p.add({std::cos(angle) * s - std::sin(angle) * u, std::sin(angle) * s + std::cos(angle) * u, 2 * a * k},
                      a);
            }
    return p;
}

constexpr double kDegreeAngle = kPi / 180;

}  // namespace

TEST_CASE("the angle of a plane surface in a drum, also a steep one") {
    for (const double degrees : {-20.0, 0.0, 33.0, 50.0, 75.0}) {
        CAPTURE(degrees);
        const auto angle = drumAngle(bed(degrees * kDegreeAngle, 4e-3));
        REQUIRE(angle);
        // The ripple of the lattice is 0.3 of a radius on a width of 30 mm; the lattice of spots does not divide it.
        CHECK(near(*angle / kDegreeAngle, degrees, 1, 0.3));
    }
}

TEST_CASE("powder that the drum lifts rises by a positive angle, whichever way the drum turns") {
    const Vec3 up(0, 1, 0), z(0, 0, 1);
    // A drum that turns about +z carries its lowest point towards +x.
    const Particles lifted = bed(30 * kDegreeAngle, 4e-3);
    CHECK(near(*drumAngle(inDrum(lifted, Vec3(0), z, up)) / kDegreeAngle, 30, 1, 0.3));
    CHECK(near(*drumAngle(inDrum(lifted, Vec3(0), -z, up)) / kDegreeAngle, -30, 1, 0.3));
    // Another place and another axis: x -> z, z -> -x.
    Particles turned = lifted;
    for (Vec3& p : turned.position) p = Vec3(-p.z, p.y, p.x) + Vec3(0.1, 0.2, 0.3);
    CHECK(near(*drumAngle(inDrum(turned, {0.1, 0.2, 0.3}, {-1, 0, 0}, up)) / kDegreeAngle, 30, 1, 0.3));
    CHECK_THROWS_AS(inDrum(lifted, Vec3(0), up, up), std::invalid_argument);
}

TEST_CASE("a bed too narrow has no angle") {
    Particles p;
    for (int i = 0; i < 8; ++i) p.add({2e-3 * i, 0, 0}, 1e-3);
    CHECK_FALSE(drumAngle(p));
    CHECK_FALSE(drumAngle(Particles()));
}
