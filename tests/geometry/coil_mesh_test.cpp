// The mesh is the coil, and closed.

#include "geometry/coil_mesh.h"
#include "geometry/mesh_writer.h"

#include <map>
#include <tuple>

#include "tests/support/catch.h"
#include "tests/support/near.h"

using namespace vkdose;
using namespace vkdose::geometry;

namespace {

/// The paper's coil, moved and turned.
Coil coil(int hand) {
    return {10.4e-3, 70e-3 / 8, 1e-3, 70e-3, 2e-3, 0.7, hand};
}

/// A corner as a key; corners that meet are the same bits.
using Corner = std::tuple<double, double, double>;
Corner corner(const Vec3& v) {
    return {v.x, v.y, v.z};
}

}  // namespace

TEST_CASE("the coil's mesh is closed and faces outwards") {
    for (const int hand : {1, -1}) {
        const std::vector<Triangle> mesh = coilMesh(coil(hand), 8, 20);
        CHECK(mesh.size() == 2572);
        // A closed surface has every edge twice, once in each direction.
        std::map<std::pair<Corner, Corner>, int> edges;
        double volume = 0;
        for (const Triangle& t : mesh) {
            for (int i = 0; i < 3; ++i) ++edges[{corner(t[i]), corner(t[(i + 1) % 3])}];
            volume += glm::dot(t[0], glm::cross(t[1], t[2])) / 6;
        }
        for (const auto& [edge, times] : edges) {
            REQUIRE(times == 1);
            REQUIRE(edges.count({edge.second, edge.first}) == 1);
        }
        // Of a straight tube as long as the wire and with eight corners; twenty chords to a turn enclose 2 % less.
        const double turn = std::hypot(2 * kPi * 10.4e-3, 70e-3 / 8);
        CHECK(test::nearRelative(volume, 8 * turn * 4 * 1e-6 * std::sin(kPi / 4), 0.03));
    }
}

TEST_CASE("the corners of the coil's mesh lie on the wire") {
    for (const int hand : {1, -1}) {
        const Coil c = coil(hand);
        double low = 1, high = 0;
        for (const Triangle& t : coilMesh(c, 12, 40))
            for (const Vec3& v : t) {
                CHECK(test::near(closestPoint(c, 0, v).distance, 0, c.wireRadius, 1e-9));
                low = std::min(low, v.z);
                high = std::max(high, v.z);
            }
        // From end to end; there the wire rises by the pitch in a turn, and its end is cut square.
        CHECK(test::near(low, 2e-3, c.wireRadius, 1));
        CHECK(test::near(high, 72e-3, c.wireRadius, 1));
        CHECK(low < 2e-3);
        CHECK(high > 72e-3);
    }
}

TEST_CASE("the bytes of an STL file hold the triangles, in the unit asked for") {
    const std::vector<Triangle> mesh = coilMesh(coil(1), 3, 4);
    const std::string bytes = stlBytes(mesh, "a coil", 1e-3);
    CHECK(bytes.size() == 84 + 50 * mesh.size());
    CHECK(bytes.substr(0, 7) == "a coil ");
    const TriangleSoup soup = readMesh(bytes, "coil.stl", 1e-3);
    REQUIRE(soup.triangles.size() == mesh.size());
    for (std::size_t t = 0; t < mesh.size(); ++t)
        for (std::size_t k = 0; k < 3; ++k)
            CHECK(test::near(soup.points[soup.triangles[t][k]], mesh[t][k], 0.08, 1.1e-7));  // single precision
    CHECK_THROWS_AS(stlBytes({{Vec3(0), Vec3(1e30), Vec3(0, 1, 0)}}, "", 1e-30), MeshError);
}
