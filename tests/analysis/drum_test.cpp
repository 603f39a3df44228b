// The angle of the surface in a drum, on beds whose slope is known.
#include "host/analysis/drum.h"

#include <algorithm>
#include <cmath>
#include <functional>
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

/// Spheres side by side below a surface, in layers from the front wall backwards: z = 0, -2a, ...; their tops touch the
/// surface where they stand.
Particles below(const std::function<double(double x, int layer)>& surface, int layers = 4, double a = 0.5e-3) {
    Particles p;
    for (int layer = 0; layer < layers; ++layer)
        for (double x = -24e-3; x <= 24e-3; x += a / 4)
            for (int row = 0; row < 3; ++row) {
                // Of spheres that touch a straight surface from below.
                const double slope = (surface(x + 1e-6, layer) - surface(x - 1e-6, layer)) / 2e-6;
                p.add({x, surface(x, layer) - (1 + row) * a * std::sqrt(1 + slope * slope), -2 * a * layer}, a);
            }
    return p;
}

std::optional<SurfaceAngle> frontAngle(double halfWidth, const std::vector<Particles>& photographs) {
    DrumFront front(halfWidth, 1e-3, int(photographs.size()));
    for (const Particles& p : photographs) front.add(p);
    return front.angle();
}

constexpr double kDegreeAngle = kPi / 180;

double line(double degrees, double x) {
    return std::tan(degrees * kDegreeAngle) * x - 4e-3;
}

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

TEST_CASE("the angle of a plane surface seen from the front, also a steep one") {
    for (const double degrees : {-20.0, 0.0, 33.0, 50.0, 70.0}) {
        CAPTURE(degrees);
        const auto seen = frontAngle(10e-3, {below([=](double x, int) { return line(degrees, x); })});
        REQUIRE(seen);
        // Ripples of a fraction of a pixel of 0.1 mm on 20 mm of width.
        CHECK(near(seen->angle / kDegreeAngle, degrees, 1, 0.2));
        CHECK(std::isnan(seen->error));  // one photograph
    }
}

TEST_CASE("the slope of an S-shaped surface is that of the line through it within the window") {
    // y = a sin(x / b): the least-squares slope over |x| < w is 3 a b / w^3 (b sin(w/b) - w cos(w/b)).
    const double a = 8e-3, b = 12e-3;
    const Particles powder = below([=](double x, int) { return a * std::sin(x / b); });
    double last = 90;
    for (const double w : {4e-3, 10e-3, 21e-3}) {
        CAPTURE(w);
        const double slope = 3 * a * b / (w * w * w) * (b * std::sin(w / b) - w * std::cos(w / b));
        const auto seen = frontAngle(w, {powder});
        REQUIRE(seen);
        CHECK(near(seen->angle, std::atan(slope), kDegreeAngle, 0.3));
        CHECK(seen->angle / kDegreeAngle < last - 1);  // the wider, the flatter
        last = seen->angle / kDegreeAngle;
    }
}

TEST_CASE("from the front the highest powder along the line of sight is seen, not the mean of the bed") {
    // At the glass 40 degrees, behind it 30: the glass stands above the rest for x > 0 only.
    const Particles powder = below([](double x, int layer) { return line(layer == 0 ? 40 : 30, x); });
    const double w = 10e-3, t40 = std::tan(40 * kDegreeAngle), t30 = std::tan(30 * kDegreeAngle);
    const auto seen = frontAngle(w, {powder});
    REQUIRE(seen);
    // The least-squares line through two half lines that meet in the middle has the mean of their slopes.
    CHECK(near(seen->angle, std::atan((t40 + t30) / 2), kDegreeAngle, 0.3));
    // The bulk counts every layer: three of four are at 30 degrees.
    const auto bulk = drumAngle(powder);
    REQUIRE(bulk);
    CHECK(*bulk / kDegreeAngle < 34);
    // A layer at the glass that is lower everywhere hides nothing.
    const Particles hollow = below([](double x, int layer) { return line(30, x) - (layer == 0 ? 3e-3 : 0); });
    CHECK(near(frontAngle(w, {hollow})->angle / kDegreeAngle, 30, 1, 0.2));
}

TEST_CASE("photographs are averaged before the line is drawn, and their quarters tell the error") {
    const auto at = [](double degrees) { return below([=](double x, int) { return line(degrees, x); }); };
    // For most of the time at 40 degrees, with avalanches: the line at half occupancy does not see them.
    std::vector<Particles> steady(12, at(40));
    steady[1] = steady[4] = steady[7] = steady[11] = at(20);
    const auto seen = frontAngle(10e-3, steady);
    REQUIRE(seen);
    CHECK(near(seen->angle / kDegreeAngle, 40, 1, 0.2));
    CHECK(near(seen->error / kDegreeAngle, 0, 1, 0.01));  // each quarter is at 40 too
    // Quarters of 38, 40, 42 and 44 degrees: their deviation is 2.58, over the root of four.
    std::vector<Particles> drifts;
    for (const double degrees : {38, 38, 40, 40, 42, 42, 44, 44}) drifts.push_back(at(degrees));
    CHECK(near(frontAngle(10e-3, drifts)->error / kDegreeAngle, 1.29, 1, 0.05));
    drifts.pop_back();
    CHECK(std::isnan(frontAngle(10e-3, drifts)->error));  // fewer than two photographs a quarter
}

TEST_CASE("a window beyond the bed, or of less than five diameters, has no angle") {
    const Particles powder = below([](double x, int) { return line(30, x); });
    CHECK(frontAngle(2.6e-3, {powder}));
    CHECK_FALSE(frontAngle(2.4e-3, {powder}));
    CHECK(frontAngle(24e-3, {powder}));
    CHECK_FALSE(frontAngle(26e-3, {powder}));
    CHECK_FALSE(frontAngle(10e-3, {}));
    DrumFront front(26e-3, 1e-3, 1);  // the bed ends at 24.5 mm, a sphere's radius beyond its last middle
    front.add(powder);
    CHECK(front.columns() == 520);
    CHECK(near(front.emptyColumns(), 2 * 15, 2, 1));
}
