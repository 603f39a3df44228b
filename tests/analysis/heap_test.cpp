// The angle of repose, on heaps whose slope is known.
#include "host/analysis/heap.h"

#include "geometry/surface.h"
#include "tests/support/catch.h"
#include "tests/support/near.h"

using namespace vkdose;
using namespace vkdose::test;

namespace {

/// Small spheres whose centres lie densely on a cone: their envelope is a cone of the same slope.
Particles cone(double angle, double height, double radius, const Vec3& foot = Vec3(0)) {
    Particles p;
    const double step = radius / 2, run = height / std::tan(angle);
    const int rings = int(run / (step * std::cos(angle)));
    for (int ring = 0; ring <= rings; ++ring) {
        const double r = ring * step * std::cos(angle);
        const int count = std::max(1, int(2 * kPi * r / step));
        for (int i = 0; i < count; ++i) {
            const double phi = 2 * kPi * (i + 0.5) / count;
            p.add(foot + Vec3(r * std::cos(phi), height - r * std::tan(angle), r * std::sin(phi)), radius);
        }
    }
    return p;
}

constexpr double kDegreeAngle = kPi / 180;

}  // namespace

TEST_CASE("the slope of a cone of small spheres is the cone's") {
    for (const double degrees : {12.0, 30.0, 45.0, 60.0}) {
        CAPTURE(degrees);
        const auto slope = heapSlope(cone(degrees * kDegreeAngle, 15e-3, 0.5e-3));
        REQUIRE(slope);
        // The envelope's ripple is 1/32 of a radius, on a flank of some 9 mm.
        CHECK(near(slope->angle / kDegreeAngle, degrees, 1, 0.2));
        CHECK(slope->error / kDegreeAngle < 0.2);
        CHECK(nearRelative(slope->height, 15e-3 + 0.5e-3, 0.05));
    }
}

TEST_CASE("the slope of a cone from the side is the cone's") {
    for (const double degrees : {12.0, 30.0, 45.0, 60.0}) {
        CAPTURE(degrees);
        const auto slope = heapSlopeFromSide(cone(degrees * kDegreeAngle, 15e-3, 0.5e-3));
        REQUIRE(slope);
        CHECK(near(slope->angle / kDegreeAngle, degrees, 1, 0.2));
        CHECK(slope->error / kDegreeAngle < 0.1);
        CHECK(nearRelative(slope->height, 15e-3 + 0.5e-3, 0.01));
        CHECK(nearRelative(slope->to - slope->from, 0.6 * slope->height / std::tan(degrees * kDegreeAngle), 0.03));
    }
}

TEST_CASE("a ridge hides the flat flanks before and behind it: the two views of a heap differ") {
    // A cone of 25 degrees with two thin walls of 40 degrees across it, one along x and one along z.
    Particles p = cone(25 * kDegreeAngle, 12e-3, 0.5e-3);
    for (int i = -60; i <= 60; ++i) {
        const double s = 0.25e-3 * i, h = 16e-3 - std::abs(s) * std::tan(40 * kDegreeAngle);
        p.add({s, h, 0}, 0.5e-3);
        p.add({0, h, s}, 0.5e-3);
    }
    const auto plan = heapSlope(p), side = heapSlopeFromSide(p);
    REQUIRE(plan);
    REQUIRE(side);
    CHECK(side->angle - plan->angle > 3 * kDegreeAngle);
}

TEST_CASE("the slope of a heap does not change with its place, with what has rolled away and what was dosed") {
    const double angle = 33 * kDegreeAngle;
    const Vec3 up = glm::normalize(Vec3(0.3, 0.2, 1)), foot(0.1, -0.2, 0.05);
    const Particles there = cone(angle, 15e-3, 0.5e-3);
    const auto plain = heapSlope(there);
    REQUIRE(plain);
    // The same heap about another axis: the frame's own turn about the axis moves spots against spheres a little.
    const Vec3 x = geometry::anyNormal(up), z = glm::cross(x, up);
    Particles turned = there;
    for (Vec3& p : turned.position) p = foot + p.x * x + p.y * up + p.z * z;
    turned.add(foot + 0.2 * x + 0.5e-3 * up, 0.5e-3);  // far away
    turned.add(foot + 0.05 * up, 0.5e-3);              // high in the air over the top, but dosed
    turned.status.back() = Status::Dosed;
    const auto slope = heapSlope(upright(turned, foot, up));
    REQUIRE(slope);
    CHECK(near(slope->angle / kDegreeAngle, plain->angle / kDegreeAngle, 1, 0.1));
    CHECK(nearRelative(slope->height, plain->height, 0.02));
    const auto side = heapSlopeFromSide(upright(turned, foot, up));
    REQUIRE(side);
    CHECK(near(side->angle / kDegreeAngle, 33, 1, 0.1));
}

TEST_CASE("an uneven heap has the mean slope, and its error tells the unevenness") {
    // Half of the cone at 30, half at 36 degrees, of one height.
    Particles p;
    for (const double degrees : {30.0, 36.0}) {
        const Particles half = cone(degrees * kDegreeAngle, 15e-3, 0.5e-3);
        for (std::size_t i = 0; i < half.size(); ++i)
            if ((half.position[i].x < 0) == (degrees < 33)) p.add(half.position[i], half.radius[i]);
    }
    const auto slope = heapSlope(p);
    REQUIRE(slope);
    CHECK(near(slope->angle / kDegreeAngle, 33, 1, 1));
    // Quarters 30, 30, 36, 36: a deviation of 3.46, over the root of four. The flank's ends cut the halves unevenly.
    CHECK(near(slope->error / kDegreeAngle, 1.73, 1, 0.6));
}

TEST_CASE("a layer of powder is no heap") {
    Particles p;
    for (int i = -10; i <= 10; ++i)
        for (int k = -10; k <= 10; ++k) p.add({2e-3 * i, 1e-3, 2e-3 * k}, 1e-3);
    for (const auto& slope : {heapSlope, heapSlopeFromSide}) {
        CHECK_FALSE(slope(p));
        CHECK_FALSE(slope(Particles()));
    }
}
