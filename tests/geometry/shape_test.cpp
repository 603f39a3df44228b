// Each exact shape against meshes of itself: as many contacts, at the same place, and the difference falls with the
// square of the facets.

#include "geometry/shape.h"

#include <random>

#include "tests/support/catch.h"
#include "tests/support/near.h"

using namespace vkdose;
using namespace vkdose::geometry;
using test::near;

namespace {

struct Sample {
    const char* name;
    Shape shape;
    double facet;    ///< of the coarsest mesh [m]
    double curve;    ///< the smallest radius of curvature [m]
    double radius;   ///< of the spheres [m]
    Vec3 low, high;  ///< where they are
    bool solid;      ///< the mesh is closed and encloses the volume below
    double volume;   ///< [m3]
};

const Coil kWire{10e-3, 9e-3, 1e-3, 40e-3, 2e-3, 0.7, 1};
const Flight kScrew{3e-3, 10e-3, 1e-3, 9e-3, 9e-3, 8 * kPi, 2e-3, 0.4, 1};
const Flight kNarrowing{3e-3, 10e-3, 1e-3, 12e-3, 6e-3, 8 * kPi, 2e-3, -0.3, -1};

double bladeVolume(const Flight& f) {
    return f.angle / 2 * (f.outerRadius * f.outerRadius - f.innerRadius * f.innerRadius) * f.thickness;
}

std::vector<Sample> samples() {
    const Vec3 tilted = glm::normalize(Vec3(1, 2, 3));
    return {
        {"disc with a hole", Cone{{1e-3, 0, 0}, tilted, 4e-3, 10e-3, 0}, 1.5e-3, 4e-3, 1e-3, Vec3(-12e-3), Vec3(12e-3),
         false, 0},
        {"cylinder", Cone{{0, 0, 0}, tilted, 8e-3, 8e-3, 15e-3}, 1.5e-3, 8e-3, 1e-3, Vec3(-12e-3), Vec3(20e-3), false,
         0},
        {"cone",
         Cone{{0, 0, 0}, {0, -1, 0}, 10e-3, 4e-3, 12e-3},
         1.5e-3,
         4e-3,
         1e-3,
         {-12e-3, -14e-3, -12e-3},
         {12e-3, 2e-3, 12e-3},
         false,
         0},
        {"tube from inside",
         Tube{{0, 0, 0}, {0, 0, 1}, 8e-3, 15e-3, true},
         1.5e-3,
         8e-3,
         1e-3,
         {-6e-3, -6e-3, 2e-3},
         {6e-3, 6e-3, 13e-3},
         false,
         0},
        {"tube from outside",
         Tube{{0, 0, 0}, {0, 0, 1}, 8e-3, 15e-3, false},
         1.5e-3,
         8e-3,
         1e-3,
         {-10e-3, -10e-3, 2e-3},
         {10e-3, 10e-3, 13e-3},
         false,
         0},
        {"trough", Trough{8e-3}, 1.5e-3, 8e-3, 1e-3, {-8e-3, -8e-3, 2e-3}, {8e-3, 8e-3, 13e-3}, false, 0},
        {"ball", Ball{{1e-3, 2e-3, 3e-3}, 6e-3}, 1.5e-3, 6e-3, 1e-3, Vec3(-8e-3), Vec3(10e-3), true,
         4 * kPi / 3 * 216e-9},
        {"solid block", Block{Vec3(-4e-3), Vec3(5e-3), false}, 1e-3, kEndless, 1e-3, Vec3(-6e-3), Vec3(7e-3), true,
         729e-9},
        {"room", Block{Vec3(-4e-3), Vec3(5e-3), true}, 1e-3, kEndless, 1e-3, Vec3(-4e-3), Vec3(5e-3), true, -729e-9},
        {"wire",
         kWire,
         0.4e-3,
         1e-3,
         1e-3,
         {-13e-3, -13e-3, 4e-3},
         {13e-3, 13e-3, 40e-3},
         true,
         kPi * 1e-6 * std::hypot(2 * kPi * 10e-3, 9e-3) / 9e-3 * 40e-3},
        {"screw", kScrew, 1e-3, 3e-3, 1e-3, {-12e-3, -12e-3, 1e-3}, {12e-3, 12e-3, 40e-3}, true, bladeVolume(kScrew)},
        {"narrowing screw",
         kNarrowing,
         1e-3,
         3e-3,
         1e-3,
         {-12e-3, -12e-3, 1e-3},
         {12e-3, 12e-3, 40e-3},
         true,
         bladeVolume(kNarrowing)},
    };
}

Vec3 within(std::mt19937_64& random, const Vec3& low, const Vec3& high) {
    std::uniform_real_distribution<double> unit(0, 1);
    const double x = unit(random), y = unit(random), z = unit(random);
    return low + (high - low) * Vec3(x, y, z);
}

bool behindWall(const Sample& s, const Vec3& q) {
    return std::holds_alternative<Tube>(s.shape) && closestPoint(Surface(std::get<Tube>(s.shape)), q).distance < 0;
}

/// What spheres at random meet on the shape and on a mesh of it.
struct Difference {
    double distance = 0;  ///< mean difference of the smallest distance, in radii
    int counted = 0;      ///< spheres
    int otherNumber = 0;  ///< of them that touch another number of places
};

Difference difference(const Sample& s, double facet) {
    const auto triangles = tessellated(s.shape, facet, s.low - 2e-3, s.high + 2e-3);
    const MeshSurface mesh(makeMesh(soupOf(triangles, s.name), 1e-10).mesh, s.radius);
    // Nearly touching, a coarse mesh may miss a contact or have one more: that is its error, not one of the count.
    const double doubt = s.facet * s.facet / (4 * s.curve);
    std::mt19937_64 random(31);
    Difference found;
    for (int n = 0; n < 400000 && found.counted < 1500; ++n) {
        const Vec3 q = within(random, s.low, s.high);
        const std::vector<Feature> exact = touched({s.shape}, q, s.radius);
        if (exact.empty() || exact.front().distance < 0.8 * s.radius || exact.front().distance > s.radius - doubt)
            continue;
        if (behindWall(s, q) || touched({s.shape}, q, s.radius + doubt).size() != exact.size() ||
            touched({s.shape}, q, s.radius - doubt).size() != exact.size())
            continue;
        const std::vector<Feature> meshed = mesh.touched(q, s.radius);
        ++found.counted;
        if (meshed.size() != exact.size()) ++found.otherNumber;
        if (!meshed.empty()) found.distance += std::abs(meshed.front().distance - exact.front().distance) / s.radius;
    }
    found.distance /= found.counted;
    return found;
}

}  // namespace

TEST_CASE("a shape and meshes of itself touch as often, and approach each other with the square of the facets") {
    for (const Sample& s : samples()) {
        const Difference coarse = difference(s, s.facet), fine = difference(s, s.facet / 2);
        CAPTURE(s.name, coarse.counted, coarse.distance, fine.distance, coarse.otherNumber, fine.otherNumber);
        CHECK(coarse.counted > 300);
        CHECK(coarse.otherNumber == 0);
        CHECK(fine.otherNumber == 0);
        CHECK(coarse.distance < 0.05);
        // Flat shapes agree to rounding. For the others half the facet is a quarter of the difference; the number of
        // facets is whole, so not exactly.
        if (coarse.distance > 1e-12) CHECK(fine.distance < 0.33 * coarse.distance);
        if (coarse.distance > 1e-12) CHECK(fine.distance > 0.17 * coarse.distance);
    }
}

TEST_CASE("meshes of solid shapes are closed, face outwards and enclose the volume") {
    for (const Sample& s : samples()) {
        const auto facts =
            makeMesh(soupOf(tessellated(s.shape, s.facet / 2, s.low - 2e-3, s.high + 2e-3), s.name), 1e-10).facts;
        CAPTURE(s.name, facts.text());
        CHECK(facts.oriented);
        CHECK(facts.closed == s.solid);
        if (s.solid) CHECK(test::nearRelative(facts.volume, s.volume, 0.02));
    }
}

TEST_CASE("a shape tells whether it ends, whether it is solid, and how fine its triangles have to be") {
    for (const Sample& s : samples()) {
        CAPTURE(s.name);
        const ShapeForm form = formOf(s.shape);
        CHECK(form.endless == std::holds_alternative<Trough>(s.shape));
        CHECK(form.solid == (s.solid && s.volume > 0));  // a room is closed as well, but matter is outside of it
        CHECK((form.facet > 0) != form.endless);
        if (s.curve < kEndless) CHECK(form.facet < form.curve);
    }
    CHECK(formOf(Plane{{0, 0, 0}, {0, 1, 0}}).endless);
    CHECK(formOf(Tube{{0, 0, 0}, {0, 0, 1}, 1e-3}).endless);
    CHECK(formOf(Tube{{0, 0, 0}, {0, 0, 1}, 1e-3}).facet == 0);
    CHECK(formOf(Cone{{0, 0, 0}, {0, 0, 1}, 1e-3, 1e-3, 2}).facet == 0);  // a thread of two metres
}

TEST_CASE("closest points of shapes are consistent, and no point of the mesh is nearer") {
    for (const Sample& s : samples()) {
        const auto triangles = tessellated(s.shape, s.facet, s.low - 2e-3, s.high + 2e-3);
        std::mt19937_64 random(7);
        for (int n = 0; n < 300; ++n) {
            const Vec3 q = within(random, s.low, s.high);
            if (behindWall(s, q)) continue;
            for (const Feature& f : places(s.shape, q, 3e-3)) {
                CAPTURE(s.name, q.x, q.y, q.z, f.distance);
                REQUIRE(near(glm::length(f.normal), 1, 1, 1e-12));
                REQUIRE(near(f.point + f.distance * f.normal, q, 10e-3, 1e-12));
            }
            const std::vector<Feature> all = places(s.shape, q, 3e-3);
            double least = 3e-3;
            for (const Feature& f : all) least = std::min(least, f.distance);
            double corner = kEndless;
            for (const Triangle& t : triangles)
                for (const Vec3& c : t) corner = std::min(corner, glm::length(q - c));
            REQUIRE(corner >= least - 1e-9);
        }
    }
}

TEST_CASE("a body of several shapes touches a sphere as one surface") {
    // A rod with two ends: convex, so once, wherever the sphere is.
    const std::vector<Shape> rod{Cone{{0, 0, 0}, {0, 0, 1}, 1, 1, 3}, Cone{{0, 0, 0}, {0, 0, 1}, 0, 1, 0},
                                 Cone{{0, 0, 3}, {0, 0, 1}, 0, 1, 0}};
    // A pot: its floor and its wall are two, and a hopper over an outlet one or two.
    const std::vector<Shape> pot{Cone{{0, 0, 0}, {0, 0, 1}, 1, 1, 3}, Cone{{0, 0, 0}, {0, 0, 1}, 0, 1, 0}};
    std::mt19937_64 random(3);
    int met = 0, corners = 0;
    for (int n = 0; n < 40000; ++n) {
        const Vec3 q = within(random, {-1.3, -1.3, -0.3}, {1.3, 1.3, 3.3});
        const double rho = std::hypot(q.x, q.y);
        const double outside = std::hypot(std::max(0.0, rho - 1), std::max({0.0, -q.z, q.z - 3}));
        if (outside > 0.2 && outside < 0.25) {
            const auto found = touched(rod, q, 0.25);
            REQUIRE(found.size() == 1);
            REQUIRE(near(found[0].distance, outside, 1, 1e-12));
            ++met;
        }
        if (rho > 0.8 || q.z < 0.2 || q.z > 2) continue;
        const int expected = (1 - rho < 0.25 ? 1 : 0) + (q.z < 0.25 ? 1 : 0);
        const auto found = touched(pot, q, 0.25);
        REQUIRE(int(found.size()) == expected);
        if (expected == 2) ++corners;
    }
    CHECK(met > 500);
    CHECK(corners > 20);
    // The features tell which shape they belong to.
    const auto corner = touched(pot, {0.76, 0, 0.22}, 0.25);
    REQUIRE(corner.size() == 2);
    CHECK(corner[0].shape == 1);
    CHECK(corner[1].shape == 0);
}

TEST_CASE("a sphere in a hopper's outlet touches the ring once, exact or as facets") {
    const Cone hopper{{0, 0, 0}, {0, -1, 0}, 20e-3, 3e-3, 30e-3};
    const auto triangles = tessellated(hopper, 1e-3, Vec3(-1), Vec3(1));
    const MeshSurface mesh(makeMesh(soupOf(triangles, "hopper"), 1e-10).mesh, 4e-3);
    // On the axis, and a little off it; 4 mm do not pass a hole of 6 mm.
    for (const double off : {0.0, 1e-6, 0.02e-3, 0.05e-3}) {
        const double depth = 27.35e-3;
        const Vec3 q(off, -depth, 0);
        CAPTURE(off);
        CHECK(touched({hopper}, q, 4e-3).size() == 1);
        CHECK(mesh.touched(q, 4e-3).size() == 1);
    }
}

TEST_CASE("a sphere between two turns of a screw touches both, and shaft and blade are two") {
    const std::vector<Shape> screw{kScrew, Tube{{0, 0, 0}, {0, 0, 1}, 3e-3, 50e-3, false}};
    // Between the blades there are 8 mm; a sphere of radius 4.1 mm touches both.
    const double theta = 4 * kPi, azimuth = kScrew.startAngle + theta;
    const Vec3 outward(std::cos(azimuth), std::sin(azimuth), 0);
    const Vec3 between = 8.2e-3 * outward + Vec3(0, 0, kScrew.height(theta) + 4.5e-3);
    CHECK(touched(screw, between, 4.1e-3).size() == 2);
    // A small one in the corner of blade and shaft.
    const Vec3 inCorner = 3.95e-3 * outward + Vec3(0, 0, kScrew.height(theta) + 0.5e-3 + 1.05e-3);
    const auto corner = touched(screw, inCorner, 1e-3);
    REQUIRE(corner.size() == 2);
    CHECK(corner[0].shape != corner[1].shape);
    // Above the end of the blade nothing is left.
    CHECK(touched(screw, Vec3(6e-3, 0, 45e-3), 1e-3).empty());
}

TEST_CASE("a centre inside a solid shape has a negative distance and a way out") {
    const auto check = [](const Shape& shape, const Vec3& q) {
        const auto found = places(shape, q, 1e-3);
        REQUIRE(found.size() == 1);
        CHECK(found[0].distance < 0);
        CHECK(near(found[0].point + found[0].distance * found[0].normal, q, 1e-3, 1e-9));
    };
    check(Ball{{0, 0, 0}, 1e-3}, {1e-4, 2e-4, 0});
    check(Ball{{0, 0, 0}, 1e-3}, {0, 0, 0});
    check(Block{Vec3(-1e-3), Vec3(1e-3), false}, {1e-4, 2e-4, 0});
    const double theta = 4.3;
    const double azimuth = kScrew.startAngle + theta;
    check(kScrew, Vec3(6e-3 * std::cos(azimuth), 6e-3 * std::sin(azimuth), kScrew.height(theta) + 0.2e-3));
}

TEST_CASE("a shape that turns about z comes no nearer to a point than it says") {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> unit(-1, 1);
    // An endless wire, as far as the points below can tell: they see no end of it.
    const Coil wire{10e-3, 9e-3, 1e-3, 400e-3, -200e-3, 0.7, 1};
    for (const Shape& shape : {Shape{wire}, Shape{Tube{{0, 0, -5e-3}, {0, 0, 1}, 10e-3, 20e-3, true}},
                               Shape{Cone{{0, 0, 1e-3}, {0, 0, -1}, 8e-3, 2e-3, 9e-3}}, Shape{Ball{{0, 0, 3e-3}, 4e-3}},
                               Shape{Plane{{1e-3, 2e-3, 0}, {0, 0, 1}}}}) {
        CAPTURE(shape.index());
        const std::optional<double> approach = formOf(shape).approach;
        REQUIRE(approach);
        const auto distance = [&](const Vec3& q) {
            double least = 1;
            for (const Feature& f : places(shape, q, 30e-3)) least = std::min(least, f.distance);
            return least;
        };
        for (int trial = 0; trial < 200; ++trial) {
            const Vec3 q = 15e-3 * Vec3(unit(random), unit(random), unit(random));
            const double angle = 0.2 * unit(random);
            const Vec3 turned(std::cos(angle) * q.x - std::sin(angle) * q.y,
                              std::sin(angle) * q.x + std::cos(angle) * q.y, q.z);
            CHECK(std::abs(distance(turned) - distance(q)) <= *approach * std::abs(angle) + 1e-9);
        }
    }
    CHECK_FALSE(Tube{{1e-3, 0, 0}, {0, 0, 1}, 10e-3, 20e-3, true}.form().approach);
    CHECK_FALSE(Plane{{0, 0, 0}, {0, 1, 0}}.form().approach);
    CHECK_FALSE(Block{Vec3(-1e-3), Vec3(1e-3), false}.form().approach);
    CHECK_FALSE(kScrew.form().approach);
}
