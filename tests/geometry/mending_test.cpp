// Meshes with the usual defects are mended without a change of their surface: a sphere touches what it touches of the
// triangles as they were, and the volume is the same.

#include <random>

#include "geometry/inside.h"
#include "geometry/mesh.h"
#include "geometry/mesh_surface.h"
#include "tests/geometry/closest_places.h"
#include "tests/geometry/damaged.h"
#include "tests/geometry/facets.h"
#include "tests/support/catch.h"
#include "tests/support/near.h"

using namespace vkdose;
using namespace vkdose::geometry;
using namespace vkdose::test;

namespace {

TriangleSoup soup(const Sample& s) {
    return readMesh(asciiPly(s), "part.ply", 1);
}

std::string refusal(const Sample& s) {
    try {
        makeMesh(soup(s));
    } catch (const MeshError& e) {
        return e.what();
    }
    return "";
}

std::string mended(const Sample& s, double unit = 1) {
    return makeMesh(readMesh(asciiPly(s), "part.ply", unit)).facts.mended;
}

Facets facetsOf(const Sample& s) {
    Facets all;
    for (const auto& t : s.triangles) all.push_back({s.points[t[0]], s.points[t[1]], s.points[t[2]]});
    return all;
}

/// How often the words of a kind stand in the text, as the number before them.
std::size_t told(const std::string& text, const std::string& words) {
    const std::size_t at = text.find(words);
    if (at == std::string::npos) return 0;
    const std::size_t number = text.rfind("; ", at) == std::string::npos ? 0 : text.rfind("; ", at) + 2;
    return std::stoul(text.substr(number));
}

}  // namespace

TEST_CASE("mending: what was done is counted and told") {
    for (const Damaged& d : damagedMeshes()) {
        const MeshFacts facts = makeMesh(soup(d.mesh)).facts;
        CAPTURE(d.name, facts.mended);
        CHECK(told(facts.mended, "without area") == d.flat);
        CHECK(told(facts.mended, "left out that stand") == d.doubled);
        CHECK(told(facts.mended, "on its edge") + told(facts.mended, "on their edges") == d.onEdges);
        CHECK(facts.seams == d.seams);
        CHECK((facts.mended.find("seam") != std::string::npos) == (d.seams > 0));
    }
}

TEST_CASE("mending: a closed mesh stays closed, with the volume and the inside that it had") {
    for (const Damaged& d : damagedMeshes()) {
        const CheckedMesh made = makeMesh(soup(d.mesh));
        CAPTURE(d.name, made.facts.text());
        CHECK(made.facts.closed == d.closed);
        CHECK(isClosed(made.mesh) == d.closed);
        // The tolerance is 2e-6 of the box.
        CHECK(near(made.facts.volume, d.volume, 1, 2e-6));
        if (!d.closed) continue;
        CHECK(made.facts.oriented);
        const Inside inside(made.mesh);
        std::mt19937_64 random(11);
        std::size_t count = 0;
        constexpr std::size_t kPoints = 4000;
        for (std::size_t i = 0; i < kPoints; ++i) {
            const Vec3 p = within(random, made.facts.low - 0.1, made.facts.high + 0.1);
            // The boxes of the samples are those of whole numbers.
            const Vec3 cell = glm::floor(p);
            const bool shifted = d.volume > 1;
            const bool inFirst = cell == Vec3(0);
            const Vec3 second = d.name.find("vertex") != std::string::npos ? Vec3(1, 1, 1)
                                : d.name.find("wall") != std::string::npos ? Vec3(1, 0, 0)
                                                                           : Vec3(1, 1, 0);
            const bool expected = inFirst || (shifted && cell == second);
            REQUIRE(inside(p) == expected);
            count += expected;
        }
        CHECK(count > kPoints / 6);
    }
}

TEST_CASE("mending: a sphere touches of the mended mesh what it touches of the triangles as they were") {
    for (const Damaged& d : damagedMeshes()) {
        CAPTURE(d.name);
        const bool moved = d.name.find("beside") != std::string::npos;  // by 3e-7
        const MeshSurface surface(makeMesh(soup(d.mesh)).mesh, 0.6);
        const Facets facets = facetsOf(d.mesh);
        std::mt19937_64 random(3);
        std::size_t touches = 0, several = 0;
        for (int i = 0; i < 3000; ++i) {
            const double radius = std::uniform_real_distribution<double>(0.02, 0.6)(random);
            const Vec3 low = surface.grid().low + 0.6 - radius;
            const Vec3 high = surface.grid().low + surface.grid().cell * Vec3(surface.grid().cells) - 0.6 + radius;
            const Vec3 centre = within(random, low, high);
            const std::vector<Feature> minima = minimaOnTriangles(facets, centre, radius, moved ? 1e-5 : 1e-6);
            const std::vector<Feature> expected = distinct(minima, centre, radius);
            // A fifth of the radius is the deepest that the features of a surface are told apart to.
            if (expected.empty() || expected.front().distance < 0.8 * radius) continue;
            const std::vector<Feature> found = surface.touched(centre, radius);
            CAPTURE(i, radius, centre.x, centre.y, centre.z);
            REQUIRE(found.size() == expected.size());
            for (std::size_t k = 0; k < found.size(); ++k)
                REQUIRE(near(found[k].distance, expected[k].distance, radius, moved ? 1e-5 : 1e-9));
            // Nor is there a place more before those that are one contact are joined.
            for (const Feature& place : surface.places(centre, radius)) {
                const bool known = std::any_of(minima.begin(), minima.end(), [&](const Feature& m) {
                    return glm::length(m.point - place.point) < 1e-5 * radius;
                });
                REQUIRE((known || d.apart));
            }
            ++touches;
            several += found.size() > 1;
        }
        CAPTURE(touches, several);
        CHECK(touches > 100);
    }
}

TEST_CASE("mending: places are told in the units of the file") {
    Sample s = cube();
    s.triangles.push_back({0, 0, 1});
    s.points.push_back({0.5, 0, 0});
    s.triangles[4] = {8, 1, 5};
    s.triangles.push_back({0, 8, 5});
    s.triangles.push_back(s.triangles[0]);
    s.points.push_back({0.25, 0.5, 2});
    s.triangles.push_back({2, 6, 9});
    CHECK(mended(s, 1e-3) ==
          "1 triangle without area left out (at part.ply:34 (0.333333, 0, 0)); "
          "1 triangle left out that stands there twice (at part.ply:36 (0.333333, 0.666667, 0)); "
          "1 triangle cut at a vertex on its edge (at part.ply:23 (0.5, 0, 0)); "
          "1 edge of more than two triangles made a seam (at part.ply:28 (0, 1, 0.5))");
    CHECK(mended(cube()).empty());
}

TEST_CASE("mending: of many defects a few places are told") {
    Sample s = cube();
    for (std::uint32_t i = 0; i < 50; ++i) s.triangles.push_back({i % 8, i % 8, (i + 1) % 8});
    const std::string said = mended(s);
    CHECK_THAT(said, Catch::StartsWith("50 triangles without area left out (first at part.ply:32 ("));
    CHECK(said.size() < 250);
}

TEST_CASE("mending: what cannot be mended is refused with its places") {
    Sample flat;
    for (std::uint32_t i = 0; i < 50; ++i) {
        flat.points.insert(flat.points.end(), {{i, 0, 0}, {i + 0.5, 0, 0}, {i, 0.5, 0}});
        flat.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 1});
    }
    const std::string said = refusal(flat);
    CHECK_THAT(said, Catch::StartsWith("part.ply: 50 triangles without area (first at part.ply:") &&
                         Catch::Contains("(0.333333, 0, 0)") && Catch::Contains("nothing of the mesh is left"));
    CHECK(said.size() < 350);

    // Ten thousand triangles on one line, each with twenty vertices of others on its edge: found without a hang.
    Sample line;
    for (std::uint32_t i = 0; i < 10000; ++i) {
        line.points.insert(line.points.end(), {{i, 0, 0}, {i + 10.5, 0, 0}, {i, 1 + 0.1 * (i % 7), 1 + i % 3}});
        line.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    CHECK_THAT(refusal(line),
               Catch::Contains("vertices on the middle of another triangle's edge (first at part.ply:") &&
                   Catch::Contains("too many"));
}

TEST_CASE("mending: corners that rounding to single precision has parted are one") {
    // A block of 0.3 at 17, every corner off by a digit of single precision at random, as exporters leave them.
    std::mt19937_64 random(23);
    Sample s;
    for (const auto& t : cube().triangles) {
        const auto first = std::uint32_t(s.points.size());
        for (const auto v : t) {
            Vec3 p = Vec3(17.1, -16.3, 16.7) + 0.3 * cube().points[v];
            for (int d = 0; d < 3; ++d) {
                auto x = static_cast<float>(p[d]);
                if (random() % 3 == 0) x = std::nextafterf(x, random() % 2 == 0 ? 1e9F : -1e9F);
                p[d] = double(x);
            }
            s.points.push_back(p);
        }
        s.triangles.push_back({first, first + 1, first + 2});
    }
    const MeshFacts facts = makeMesh(readMesh(binaryStl(s), "part.stl", 1)).facts;
    CHECK(facts.vertices == 8);
    CHECK(facts.closed);
    CHECK(facts.mended.empty());
    CHECK(nearRelative(facts.volume, 0.027, 1e-4));
}
