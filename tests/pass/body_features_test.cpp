// The device's answer to "which distinct features of a body does this sphere touch?" against the host's in double
// precision: for random spheres at every shape, at meshes cut in odd ways, with bodies that are turned.

#include "tests/pass/body_features.h"
#include "geometry/shape.h"
#include "host/core/error.h"
#include "tests/geometry/damaged.h"
#include "tests/geometry/shatter.h"

using namespace vkdose;
using namespace vkdose::geometry;
using namespace vkdose::test;

namespace {

/// A unit vector that leans from z by the first angle towards the second one around z, both in degrees.
Vec3 leaning(double from, double around) {
    const double t = from * kPi / 180, a = around * kPi / 180;
    return {std::sin(t) * std::cos(a), std::sin(t) * std::sin(a), std::cos(t)};
}

}  // namespace

TEST_CASE("the device finds the features of exact shapes as the host does") {
    const Vec3 tilted = glm::normalize(Vec3(1, 2, 3));
    const std::vector<Setup> setups{
        {"plane", {Plane{{0.02, 0.03, -0.01}, tilted}}, 1e-3, Vec3(-0.03), Vec3(0.05)},
        {"plane with an end", {Plane{{0, -2e-3, 0}, {0, 1, 0}, 5e-3}}, 1e-3, Vec3(-3e-3, -3.5e-3, 3e-3), Vec3(7e-3)},
        {"disc with a hole", {Cone{{1e-3, 0, 0}, tilted, 4e-3, 10e-3, 0}}, 1e-3, Vec3(-12e-3), Vec3(12e-3)},
        {"cylinder", {Cone{{0, 0, 0}, tilted, 8e-3, 8e-3, 15e-3}}, 1e-3, Vec3(-12e-3), Vec3(20e-3)},
        {"hopper",
         {Cone{{0.01, 0.02, 0}, {0, -1, 0}, 50e-3, 4e-3, 60e-3}},
         1e-3,
         Vec3(-0.05, -0.06, -0.05),
         Vec3(0.07, 0.03, 0.05)},
        {"hopper's outlet",
         {Cone{{0, 0, 0}, {0, -1, 0}, 20e-3, 3e-3, 30e-3}},
         4e-3,
         Vec3(-3e-3, -34e-3, -3e-3),
         Vec3(3e-3, -24e-3, 3e-3)},
        {"ball", {Ball{{1e-3, 2e-3, 3e-3}, 6e-3}}, 1e-3, Vec3(-8e-3), Vec3(10e-3)},
        {"solid block", {Block{Vec3(-4e-3), Vec3(5e-3), false}}, 1e-3, Vec3(-6e-3), Vec3(7e-3)},
        {"room", {Block{Vec3(-4e-3), Vec3(5e-3), true}}, 1e-3, Vec3(-3.3e-3), Vec3(4.3e-3)},
        {"tube from inside", {Tube{{0, 0, 0}, tilted, 8e-3, 15e-3, true}}, 1e-3, Vec3(-8e-3), Vec3(14e-3)},
        {"tube from outside", {Tube{{0, 0, 0}, tilted, 8e-3, 15e-3, false}}, 1e-3, Vec3(-8e-3), Vec3(14e-3)},
        {"trough with an end", {Trough{8e-3, 10e-3}}, 1e-3, Vec3(-8e-3, -8e-3, 2e-3), Vec3(8e-3, 8e-3, 10.5e-3)},
        {"front wall and throat", {Front{5e-3, 6e-3, 4e-3}}, 1e-3, Vec3(-9e-3, -9e-3, 3e-3), Vec3(9e-3, 9e-3, 4.7e-3)},
        {"throat", {Front{5e-3, 6e-3, 4e-3}}, 1e-3, Vec3(-5.5e-3, -5.5e-3, 3e-3), Vec3(5.5e-3, 5.5e-3, 10e-3)},
        // Angles around the wire's axis are good to some units in the last place of pi: 1e-6 rad at 10 mm.
        {"wire",
         {Coil{10e-3, 9e-3, 1e-3, 40e-3, 2e-3, 0.7, 1}},
         1e-3,
         Vec3(-13e-3, -13e-3, 0),
         Vec3(13e-3, 13e-3, 44e-3),
         1e-6,
         1e-5,
         1.5e-8},
        {"tight wire",
         {Coil{10e-3, 2.6e-3, 0.5e-3, 20e-3, 0, -2, -1}},
         1e-3,
         Vec3(-12e-3, -12e-3, -1e-3),
         Vec3(12e-3, 12e-3, 21e-3),
         1e-6,
         1e-5,
         1.5e-8},
        {"ends of wires",  // a whole one, and one so short that a sphere may reach both of its ends
         {Coil{10e-3, 9e-3, 1e-3, 2e-3, 2e-3, 0.7, 1}, Coil{10e-3, 9e-3, 1e-3, 0.5e-3, -8e-3, 2.5, -1}},
         1e-3,
         Vec3(-13e-3, -13e-3, -10e-3),
         Vec3(13e-3, 13e-3, 6e-3),
         1e-6,
         1e-5,
         1.5e-8},
        {"ends of a tight wire",
         {Coil{10e-3, 2.6e-3, 0.5e-3, 1e-3, 0, -2, -1}},
         1e-3,
         Vec3(-12e-3, -12e-3, -2e-3),
         Vec3(12e-3, 12e-3, 3e-3),
         1e-6,
         1e-5,
         1.5e-8},
        {"endless tube", {Tube{{0, 0, 0}, tilted, 8e-3, kEndless, true}}, 1e-3, Vec3(-12e-3), Vec3(14e-3)},
    };
    Narrow narrow;
    for (const Setup& setup : setups) check(narrow, setup, 2000, 1000);
}

TEST_CASE("the device finds the features of screws as the host does") {
    // Angles around the axis are good to some units in the last place of pi: 1e-6 rad at 10 mm, as for a wire.
    const auto screw = [](const char* name, const std::vector<Shape>& shapes, double radius) {
        return Setup{name, shapes, radius, Vec3(-12e-3, -12e-3, -1e-3), Vec3(12e-3, 12e-3, 42e-3), 1e-6, 1e-5, 1.5e-8};
    };
    const Flight even{3e-3, 10e-3, 1e-3, 9e-3, 9e-3, 8.3 * kPi, 2e-3, 0.4, 1};
    const Flight widening{2e-3, 10e-3, 1.2e-3, 5e-3, 11e-3, 9.7 * kPi, 0, -2, -1};
    const Flight thin{3e-3, 10e-3, 0.05e-3, 6e-3, 6e-3, 12 * kPi, 1e-3, 1, 1};
    const Cone shaft{{0, 0, 2e-3}, {0, 0, 1}, 3e-3, 3e-3, even.height(even.angle) - even.zStart};
    const std::vector<Setup> setups{
        screw("even pitch", {even}, 1e-3),
        screw("pitch that widens", {widening}, 1.25e-3),
        screw("pitch that narrows", {Flight{2e-3, 10e-3, 1e-3, 12e-3, 4e-3, 10 * kPi, 0, 3, 1}}, 0.7e-3),
        screw("thin blade", {thin}, 1.9e-3),
        screw("spheres that just pass", {thin}, 2.9e-3),
        screw("spheres as large as the shaft", {even}, 3.2e-3),
        screw("spheres larger than the pitch", {thin}, 6e-3),
        screw("a short blade", {Flight{3e-3, 10e-3, 1e-3, 20e-3, 20e-3, 1.1 * kPi, 5e-3, 2, 1}}, 1.5e-3),
        screw("blade and shaft",
              {even, shaft, Cone{{0, 0, 2e-3}, {0, 0, 1}, 0, 3e-3, 0},
               Cone{{0, 0, even.height(even.angle)}, {0, 0, 1}, 0, 3e-3, 0}},
              1.25e-3),
    };
    Narrow narrow;
    for (const Setup& setup : setups) check(narrow, setup, 2000, 1000);
}

TEST_CASE("the device finds the features of meshes as the host does, however they are cut") {
    struct Way {
        const char* name;
        Facets facets;
        double radius;
        Vec3 low, high;
    };
    // Bodies of a tenth of a metre, spheres from a fiftieth of the body to four times its size.
    constexpr double kSize = 0.1;
    const auto around = [&](const char* name, const Facets& facets, double radius, const Vec3& high) {
        return Way{name, facets, radius, Vec3(-radius), high + radius};
    };
    std::vector<Way> ways;
    for (const double radius : {1e-3, 0.02, 0.3})
        ways.push_back(around("plate", sheet(Vec3(0), {kSize, 0, 0}, {0, kSize, 0}), radius, {kSize, kSize, 0}));
    for (const double radius : {2e-3, 0.03, 0.4}) {
        ways.push_back(around("block", block(Vec3(0), Vec3(kSize)), radius, Vec3(kSize)));
        ways.push_back(around("thin blade", block(Vec3(0), {kSize, kSize, 1e-3}), radius, {kSize, kSize, 1e-3}));
    }
    ways.push_back(around("rod", block(Vec3(0), {2e-3, 1e-3, kSize}), 1e-3, {2e-3, 1e-3, kSize}));
    ways.push_back({"room", block(Vec3(0), Vec3(kSize)), 0.01, Vec3(0.008), Vec3(kSize - 0.008)});
    ways.push_back({"corner of a room", block(Vec3(0), Vec3(kSize)), 0.01, Vec3(0.008), Vec3(0.012)});
    // Of facets that meet at 5.6 degrees, and at 18 degrees: a sphere in the coarse one touches two at a time.
    for (const int sides : {64, 20})
        for (const double radius : {2e-3, 0.02, 0.09}) {
            const Vec3 corner(kSize - 0.7 * radius, kSize - 0.7 * radius, 0.09);
            ways.push_back({sides == 64 ? "tube" : "coarse tube", prism(sides, kSize, kSize, false), radius,
                            Vec3(-corner.x, -corner.y, 0.01), corner});
        }
    Narrow narrow;
    for (const Way& way : ways) {
        int number = 0;
        for (const Mesh& mesh : tenTriangulations(way.facets)) {
            // All of it is within reach of a sphere that is as large.
            if (way.radius > 0.5 * kSize && mesh.triangles.size() > gpu::kMostInCell) continue;
            const Setup setup{fmt::format("{}, triangulation {}", way.name, number++),
                              {std::make_shared<MeshSurface>(mesh, way.radius * 1.1)},
                              way.radius,
                              way.low,
                              way.high};
            check(narrow, setup, 300, 150);
        }
    }
}

TEST_CASE("the device finds the features of mended meshes as the host does, seams among them") {
    constexpr double kSize = 0.01;
    Narrow narrow;
    for (const Damaged& damaged : damagedMeshes()) {
        Facets facets;
        for (const auto& t : damaged.mesh.triangles) {
            Triangle corners;
            for (int i = 0; i < 3; ++i) corners[i] = kSize * damaged.mesh.points[t[i]];
            facets.push_back(corners);
        }
        const Mesh mesh = makeMesh(soupOf(facets, damaged.name)).mesh;
        for (const double radius : {0.5e-3, 3e-3}) {
            Vec3 low(0), high(0);
            for (const Vec3& v : mesh.vertices) {
                low = glm::min(low, v);
                high = glm::max(high, v);
            }
            check(narrow,
                  {fmt::format("{}, radius {}", damaged.name, radius),
                   {std::make_shared<MeshSurface>(mesh, radius * 1.1)},
                   radius,
                   low - radius,
                   high + radius},
                  300, 50);
        }
    }
}

TEST_CASE("the device joins the shapes of a body as the host does, and finds curved meshes") {
    const Flight screw{3e-3, 10e-3, 1e-3, 9e-3, 9e-3, 8 * kPi, 2e-3, 0.4, 1};
    const auto meshed = [](const Shape& shape, double facet, double reach) {
        return meshOf(tessellated(shape, facet, Vec3(-1), Vec3(1)), reach);
    };
    const Cone wall{{0, 0, 0}, {0, 0, 1}, 0.01, 0.01, 0.03}, floor{{0, 0, 0}, {0, 0, 1}, 0, 0.01, 0},
        lid{{0, 0, 0.03}, {0, 0, 1}, 0, 0.01, 0};
    const std::vector<Setup> setups{
        {"rod of three cones", {wall, floor, lid}, 2.5e-3, Vec3(-0.013, -0.013, -3e-3), Vec3(0.013, 0.013, 0.033)},
        {"pot", {wall, floor}, 2e-3, Vec3(-9e-3, -9e-3, 1.5e-3), Vec3(9e-3, 9e-3, 8e-3)},
        {"screw with its shaft",
         {meshed(screw, 1e-3, 1.1e-3), Tube{{0, 0, 0}, {0, 0, 1}, 3e-3, 50e-3, false}},
         1e-3,
         Vec3(-12e-3, -12e-3, 1e-3),
         Vec3(12e-3, 12e-3, 40e-3)},
        {"fine screw", {meshed(screw, 0.4e-3, 1.4e-3)}, 1.25e-3, Vec3(-12e-3, -12e-3, 1e-3), Vec3(12e-3, 12e-3, 40e-3)},
        {"two meshes and a plane",
         {meshed(Ball{Vec3(0), 5e-3}, 1e-3, 2e-3), Plane{{0, 0, 4e-3}, {0, 0, -1}},
          meshOf(block(Vec3(6e-3, -5e-3, -5e-3), Vec3(8e-3, 5e-3, 5e-3)), 2e-3)},
         1.8e-3,
         Vec3(-7e-3),
         Vec3(7e-3, 7e-3, 4e-3)},
        {"two walls that are nearly one, and a third",
         {Plane{{0, 0, 0}, {0, 0, 1}}, Plane{{0, 0, 0}, leaning(10, 90)}, Plane{{0, 0, 0}, {1, 0, 0}}},
         1e-3,
         Vec3(0.8e-3, -1e-3, 0.8e-3),
         Vec3(1.1e-3, 1e-3, 1.1e-3)},
    };
    Narrow narrow;
    for (const Setup& setup : setups) check(narrow, setup, 2000, 1000);
}

TEST_CASE("the device joins a ring of facets around a sphere as the host does") {
    // Spheres stuck in the outlet of a hopper, and in a tube that is hardly wider than they are: each touches facets
    // all around.
    const auto meshed = [](const Shape& shape, double facet, double reach) {
        return meshOf(tessellated(shape, facet, Vec3(-1), Vec3(1)), reach);
    };
    const Cone hopper{{0, 0, 0}, {0, -1, 0}, 20e-3, 3e-3, 30e-3}, funnel{{0, 0, 0}, {0, -1, 0}, 6e-3, 3e-3, 30e-3};
    const Cone snug{{0, 0, 0}, {0, 0, 1}, 4e-3, 4e-3, 12e-3};
    const auto stuck = [&](const char* name, const Cone& cone, double facet, double wander) {
        const Shape mesh = meshed(cone, facet, 4.4e-3);
        return Setup{name, {mesh}, 4e-3, Vec3(-wander, -33e-3, -wander), Vec3(wander, -24e-3, wander)};
    };
    const std::vector<Setup> setups{
        stuck("outlet", hopper, 2.5e-3, 0.1e-3),
        stuck("outlet, fine mesh", hopper, 1.6e-3, 0.1e-3),
        stuck("steep funnel", funnel, 0.8e-3, 0.1e-3),
        {"snug tube", {meshed(snug, 0.8e-3, 4.4e-3)}, 4e-3, Vec3(-0.2e-3, -0.2e-3, 2e-3), Vec3(0.2e-3, 0.2e-3, 10e-3)},
    };
    Narrow narrow;
    for (const Setup& setup : setups) check(narrow, setup, 500, 200);
}

TEST_CASE("the device joins walls that only a wall between them makes one") {
    // A sphere on the axis is as deep in all of them. Those across are two features until a neighbour joins them.
    std::vector<Shape> pit;
    for (const double around : {0.0, 180.0, 90.0, 270.0}) pit.emplace_back(Plane{{0, 0, 0}, leaning(13, around)});
    const Vec3 centre(0, 0, 1e-3);
    Narrow narrow;
    const auto count = [&](std::size_t walls) {
        const std::vector<Shape> shapes(pit.begin(), pit.begin() + std::ptrdiff_t(walls));
        const auto found = narrow.ask(packBodies({bodyOf(shapes)}, 1e-3), {Pose{}}, {{centre, 1e-3, 0}}).front().count;
        CHECK(found == touched(shapes, centre, 1e-3).size());
        return found;
    };
    CHECK(count(2) == 2);
    CHECK(count(3) == 1);
    CHECK(count(4) == 1);
}

TEST_CASE("the device tells when a sphere touches more places than it computes") {
    Facets spikes;  // nine far apart on a great circle, pointing inwards
    for (int i = 0; i < 9; ++i) {
        const double angle = 2 * kPi * i / 9;
        const Vec3 out(0.01 * std::cos(angle), 0.01 * std::sin(angle), 0), aside(-out.y, out.x, 0);
        spikes.push_back({0.99 * out, 2.0 * out + 0.1 * aside, 2.0 * out + Vec3(0, 0, 1e-3)});
    }
    Narrow narrow;
    const auto count = [&] {
        const PackedBodies packed = packBodies({bodyOf({meshOf(spikes, 0.01)})}, 0.01);
        return narrow.ask(packed, {Pose{}}, {{Vec3(0), 0.01, 0}}).front().count;
    };
    CHECK(count() == kMaxFeatures + 1);
    spikes.pop_back();
    CHECK(count() == kMaxFeatures);
}
