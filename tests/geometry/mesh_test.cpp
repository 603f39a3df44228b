// A mesh is welded, measured, and refused if contacts with it would be counted wrongly.

#include "geometry/mesh.h"
#include "geometry/inside.h"

#include "tests/geometry/mesh_samples.h"
#include "tests/support/catch.h"
#include "tests/support/near.h"

using namespace vkdose;
using namespace vkdose::geometry;
using namespace vkdose::test;

namespace {

TriangleSoup soup(const Sample& s) {
    return readMesh(asciiPly(s), "part.ply", 1);
}

}  // namespace

TEST_CASE("corners within the tolerance become one, and the tolerance is told") {
    Sample s = cube();
    // The top gets corners of its own, a little off.
    for (std::uint32_t v = 4; v < 8; ++v) s.points.push_back(s.points[v] + Vec3(3e-5, 0, -2e-5));
    for (int t : {2, 3})
        for (auto& v : s.triangles[t]) v += 4;
    const MeshFacts loose = makeMesh(soup(s)).facts, welded = makeMesh(soup(s), 1e-4).facts;
    CHECK(loose.vertices == 12);
    CHECK(loose.openEdges == 8);
    CHECK_FALSE(loose.closed);
    CHECK(loose.volume == 0);
    CHECK(welded.vertices == 8);
    CHECK(welded.closed);
    CHECK(welded.weldTolerance == 1e-4);
    CHECK(near(welded.volume, 1, 1, 1e-4));
    CHECK_THAT(welded.text(), Catch::Contains("12 triangles, 1000 x 1000 x 1000 mm") && Catch::Contains("closed") &&
                                  Catch::Contains("within 0.0001 m"));
    CHECK_THAT(loose.text(), Catch::Contains("8 open edges"));
    CHECK_THROWS_AS(makeMesh(soup(s), 0), MeshError);
    CHECK_THROWS_AS(makeMesh(soup(s), 2), MeshError);  // welds the cube to a point
}

TEST_CASE("the tables of a mesh agree with each other") {
    Sample s = cube();
    s.triangles.pop_back();  // an open edge or three
    const Mesh m = makeMesh(soup(s)).mesh;
    REQUIRE(m.edges.size() == 18);
    int open = 0;
    for (std::uint32_t e = 0; e < m.edges.size(); ++e)
        for (const std::uint32_t f : m.edges[e].faces) {
            if (f == kNoFace) {
                ++open;
                continue;
            }
            int at = -1;
            for (int i = 0; i < 3; ++i)
                if (m.edgesOf[f][i] == e) at = i;
            REQUIRE(at >= 0);
            const std::uint32_t a = m.triangles[f][at], b = m.triangles[f][(at + 1) % 3];
            CHECK(std::min(a, b) == m.edges[e].vertices[0]);
            CHECK(std::max(a, b) == m.edges[e].vertices[1]);
        }
    CHECK(open == 3);
    std::size_t ends = 0;
    for (std::uint32_t v = 0; v < m.vertices.size(); ++v)
        for (std::uint32_t i = m.firstNeighbour[v]; i < m.firstNeighbour[v + 1]; ++i, ++ends) {
            const std::uint32_t w = m.neighbours[i];
            CHECK(std::count_if(m.edges.begin(), m.edges.end(), [&](const MeshEdge& e) {
                      return e.vertices == std::array{std::min(v, w), std::max(v, w)};
                  }) == 1);
        }
    CHECK(ends == 36);
}

TEST_CASE("a mesh that is inside out, or whose sides do not agree, is told") {
    Sample s = cube();
    for (auto& t : s.triangles) std::swap(t[0], t[1]);
    const MeshFacts turned = makeMesh(soup(s)).facts;
    CHECK(turned.oriented);
    CHECK(near(turned.volume, -1, 1, 1e-12));
    CHECK_THAT(turned.text(), Catch::Contains("inside out"));
    std::swap(s.triangles[5][0], s.triangles[5][1]);
    const MeshFacts mixed = makeMesh(soup(s)).facts;
    CHECK_FALSE(mixed.oriented);
    CHECK(mixed.closed);
    CHECK_THAT(mixed.text(), Catch::Contains("not consistent"));
}

TEST_CASE("a closed mesh tells what is inside of it") {
    const Mesh block = makeMesh(soup(cube())).mesh;
    CHECK(isClosed(block));
    const Inside inside(block);
    std::uint64_t n = 0;
    for (int i = 0; i < 23; ++i)
        for (int j = 0; j < 20; ++j)
            for (int k = 0; k < 17; ++k) {
                const Vec3 at = Vec3(-0.3) + Vec3(0.0701 * i, 0.0833 * j, 0.0977 * k);
                const bool expected = glm::all(glm::greaterThan(at, Vec3(0))) && glm::all(glm::lessThan(at, Vec3(1)));
                CHECK(inside(at) == expected);
                n += expected;
            }
    CHECK(n > 1000);
    Sample open = cube();
    open.triangles.pop_back();
    CHECK_FALSE(isClosed(makeMesh(soup(open)).mesh));
}
