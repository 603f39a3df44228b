// However a surface is cut into triangles, a sphere touches it as often as it touches the surface: counted for random
// spheres against what the shape itself says.

#include "geometry/mesh_surface.h"

#include <algorithm>
#include <functional>

#include "tests/geometry/facets.h"
#include "tests/geometry/shatter.h"
#include "tests/support/catch.h"
#include "tests/support/near.h"

using namespace vkdose;
using namespace vkdose::geometry;
using namespace vkdose::test;

namespace {

/// Distances from a centre to the walls that a sphere there would touch.
using Walls = std::function<std::vector<double>(const Vec3&)>;

/// Spheres of `radius` at random in the box, those that overlap by up to a fifth of the radius, touch as many places of
/// every triangulation as of the walls, at the same distances. The grid finds what a search of all triangles finds.
void checkCounts(const Facets& surface, double radius, const Vec3& low, const Vec3& high, const Walls& walls,
                 int spheres = 2000) {
    int way = 0;
    for (const Mesh& mesh : tenTriangulations(surface)) {
        const MeshSurface touching(mesh, radius * 1.1);
        std::mt19937_64 random(23);
        CAPTURE(way++, mesh.triangles.size());
        int met = 0;
        double worst = 0;  // error of a distance or a direction [m]
        for (int n = 0; met < spheres && n < 100 * spheres; ++n) {
            const Vec3 q = within(random, low, high);
            std::vector<double> expected = walls(q);
            std::sort(expected.begin(), expected.end());
            if (expected.empty() || expected.front() < 0.8 * radius || expected.front() > radius * (1 - 1e-9)) continue;
            // A second contact that barely touches may be missing.
            if (std::any_of(expected.begin(), expected.end(),
                            [&](double d) { return std::abs(d - radius) < 1e-9 * radius; }))
                continue;
            expected.erase(std::remove_if(expected.begin(), expected.end(), [&](double d) { return d > radius; }),
                           expected.end());
            ++met;
            const std::vector<Feature> found = touching.touched(q, radius);
            const double depth = 1 - expected.front() / radius;
            CAPTURE(q.x, q.y, q.z, depth);
            REQUIRE(found.size() == expected.size());
            for (std::size_t i = 0; i < found.size(); ++i) {
                const Vec3 back = found[i].point + found[i].distance * found[i].normal;
                worst = std::max({worst, std::abs(found[i].distance - expected[i]), glm::length(back - q)});
            }
            if (n % 20 != 0) continue;
            const std::vector<Feature> twin = touching.touchedAmongAll(q, radius);
            REQUIRE(twin.size() == found.size());
            for (std::size_t i = 0; i < twin.size(); ++i) {
                REQUIRE(twin[i].key == found[i].key);
                REQUIRE(twin[i].distance == found[i].distance);
            }
        }
        REQUIRE(met > spheres / 4);
        CHECK(near(worst, 0, radius, 1e-10));
    }
}

/// Distance of a point outside to a block.
double outside(const Vec3& q, const Vec3& low, const Vec3& high) {
    return glm::length(q - glm::clamp(q, low, high));
}

Walls outsideOf(const Vec3& low, const Vec3& high) {
    return [=](const Vec3& q) -> std::vector<double> {
        const double d = outside(q, low, high);
        return d > 0 ? std::vector{d} : std::vector<double>{};
    };
}

}  // namespace

TEST_CASE("a sphere on a plate touches it once, from either side, and on its rim") {
    const Vec3 corner(-0.5, -0.5, 0);
    for (const double radius : {0.02, 0.1, 0.6, 3.0}) {
        CAPTURE(radius);
        checkCounts(sheet(corner, {1, 0, 0}, {0, 1, 0}), radius, corner - radius, -corner + radius,
                    outsideOf(corner, -corner));
    }
}

TEST_CASE("a sphere outside a block touches it once: faces, edges, corners, thin blades, needles") {
    for (const double radius : {0.05, 0.3, 4.0})
        for (const Vec3& high : {Vec3(1), Vec3(1, 1, 0.01), Vec3(0.02, 0.01, 1)}) {
            CAPTURE(radius, high.x, high.y, high.z);
            checkCounts(block(Vec3(0), high), radius, Vec3(-radius), high + radius, outsideOf(Vec3(0), high), 500);
        }
}

TEST_CASE("a sphere on the thin edge of a wedge touches it once: its other side does not shine through") {
    const double rise = std::tan(kPi / 6);
    const auto at = [&](int corner, double y) { return Vec3(corner == 0 ? 0 : 1, y, corner == 2 ? rise : 0); };
    Facets wedge{{at(0, 0), at(1, 0), at(2, 0)}, {at(0, 1), at(2, 1), at(1, 1)}};
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3;
        wedge.push_back({at(i, 0), at(j, 1), at(j, 0)});
        wedge.push_back({at(i, 0), at(i, 1), at(j, 1)});
    }
    const Walls walls = [&](const Vec3& q) {
        const Vec3 flat(q.x, 0, q.z);
        double least = 1e9;
        bool isOutside = false;
        for (int i = 0; i < 3; ++i) {
            const Vec3 p = at(i, 0), along = at((i + 1) % 3, 0) - p;
            if (glm::cross(flat - p, along).y < 0) isOutside = true;
            const double share = glm::clamp(glm::dot(flat - p, along) / glm::dot(along, along), 0.0, 1.0);
            least = std::min(least, glm::length(flat - p - share * along));
        }
        return isOutside ? std::vector{least} : std::vector<double>{};
    };
    checkCounts(wedge, 0.25, {-0.25, 0.3, -0.25}, {0.6, 0.7, 0.6}, walls, 1000);
}

TEST_CASE("a sphere inside a block touches one, two or three walls") {
    const Walls walls = [](const Vec3& q) { return std::vector<double>{q.x, q.y, q.z, 1 - q.x, 1 - q.y, 1 - q.z}; };
    checkCounts(block(Vec3(0), Vec3(1)), 0.1, Vec3(0), Vec3(1), walls);
    checkCounts(block(Vec3(0), Vec3(1)), 0.45, Vec3(0.35), Vec3(0.65), walls);
    // In the very corner.
    checkCounts(block(Vec3(0), Vec3(1)), 0.1, Vec3(0.08), Vec3(0.12), walls);
}

TEST_CASE("a sphere beside a cylinder of 64 facets touches it once") {
    constexpr int kSides = 64;
    // Of a point outside to the polygon of the section.
    const Walls walls = [](const Vec3& q) {
        double least = 1e9;
        bool isOutside = false;
        for (int i = 0; i < kSides; ++i) {
            const double a = 2 * kPi * i / kSides, b = 2 * kPi * (i + 1) / kSides;
            const Vec3 p(std::cos(a), std::sin(a), 0), along = Vec3(std::cos(b), std::sin(b), 0) - p;
            const Vec3 flat(q.x, q.y, 0);
            if (glm::cross(along, flat - p).z < 0) isOutside = true;
            const double share = glm::clamp(glm::dot(flat - p, along) / glm::dot(along, along), 0.0, 1.0);
            least = std::min(least, glm::length(flat - p - share * along));
        }
        return isOutside ? std::vector{least} : std::vector<double>{};
    };
    for (const double radius : {0.02, 0.15, 2.0}) {
        CAPTURE(radius);
        const double reach = 1 + radius;
        checkCounts(prism(kSides, 1, 1, true), radius, Vec3(-reach, -reach, 0.1), Vec3(reach, reach, 0.9), walls, 250);
    }
}

TEST_CASE("a sphere inside a tube of 64 facets touches it once, even if it nearly fills it") {
    constexpr int kSides = 64;
    const Walls walls = [](const Vec3& q) {
        double least = 1e9;
        for (int i = 0; i < kSides; ++i) {
            const double middle = 2 * kPi * (i + 0.5) / kSides;
            least = std::min(least, std::cos(kPi / kSides) - q.x * std::cos(middle) - q.y * std::sin(middle));
        }
        return std::vector{least};
    };
    for (const double radius : {0.02, 0.2, 0.6, 0.9}) {
        CAPTURE(radius);
        const double low = -1 + 0.7 * radius;
        checkCounts(prism(kSides, 1, 1, false), radius, Vec3(low, low, 0.1), Vec3(-low, -low, 0.9), walls, 250);
    }
}

TEST_CASE("a sphere between two blades touches both, one in the corner of a blade and a floor touches both") {
    Facets blades = block({0, 0, 0}, {1, 1, 0.01});
    const Facets upper = block({0, 0, 0.2}, {1, 1, 0.21});
    blades.insert(blades.end(), upper.begin(), upper.end());
    checkCounts(blades, 0.1, {0.1, 0.1, 0.08}, {0.9, 0.9, 0.13}, [](const Vec3& q) {
        return std::vector<double>{q.z - 0.01, 0.2 - q.z};
    });

    Facets corner = sheet({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    const Facets blade = block({0.5, 0, 0.001}, {0.502, 1, 1});  // does not quite reach the floor
    corner.insert(corner.end(), blade.begin(), blade.end());
    checkCounts(corner, 0.1, {0.5, 0.2, 0.08}, {0.65, 0.8, 0.12}, [](const Vec3& q) {
        return std::vector<double>{q.z, q.x - 0.502};
    });
}

TEST_CASE("more places than a backend keeps are an error that names the sphere") {
    Facets spikes;  // nine far apart on a great sphere, pointing inwards
    for (int i = 0; i < 9; ++i) {
        const double angle = 2 * kPi * i / 9;
        const Vec3 out(std::cos(angle), std::sin(angle), 0), aside(-out.y, out.x, 0);
        spikes.push_back({0.99 * out, 2.0 * out + 0.1 * aside, 2.0 * out + Vec3(0, 0, 0.1)});
    }
    const auto make = [](const Facets& s) { return MeshSurface(makeMesh(soupOf(s, "spikes")).mesh, 1); };
    CHECK_THROWS_AS(make(spikes).touched(Vec3(0), 1), TooManyFeatures);
    spikes.pop_back();
    CHECK(make(spikes).touched(Vec3(0), 1).size() == 8);
    CHECK(make(spikes).touched(Vec3(5, 0, 0), 1).empty());
    CHECK(make(spikes).touched(Vec3(0, 0, 0.9), 1).empty());
}

TEST_CASE("a sphere whose centre lies on the surface has a contact with a direction") {
    const MeshSurface plate(makeMesh(soupOf(sheet({0, 0, 0}, {1, 0, 0}, {0, 1, 0}), "plate")).mesh, 0.1);
    const auto found = plate.touched({0.5, 0.25, 0}, 0.1);
    REQUIRE(found.size() == 1);
    CHECK(near(found[0].normal, Vec3(0, 0, 1), 1, 1e-12));
    CHECK(plate.touched({0.5, 0.5, 0}, 0.1).size() == 1);
    CHECK(plate.touched({0, 0, 0}, 0.1).size() == 1);
}
