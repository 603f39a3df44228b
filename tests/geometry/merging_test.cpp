// Places of one mesh that become one contact must do so without a jump: along any way of an elastic sphere the force
// that its contacts exert takes the energy that they store, up to overlaps of a fifth of the radius.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include "geometry/features.h"
#include "geometry/mesh_surface.h"
#include "tests/geometry/facets.h"
#include "tests/support/catch.h"
#include "tests/support/near.h"

using namespace vkdose;
using namespace vkdose::geometry;
using namespace vkdose::test;

namespace {

constexpr double kDeepest = 0.2;  // overlap, the radius of the sphere is 1
constexpr double kDegree = kPi / 180;

Facets together(Facets a, const Facets& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

/// A strip along y from `a` to `b`.
Facets strip(const Vec3& a, const Vec3& b, double half = 3) {
    return sheet(a - Vec3(0, half, 0), Vec3(0, 2 * half, 0), b - a);
}

/// Two faces whose normals are `angle` apart, and which end `half` from the middle.
Facets groove(double angle, double half = 3) {
    const double length = 3 + 1.5 * std::tan(angle / 2);  // so that a sphere between steep faces is between faces
    const Vec3 up(0, 0, length * std::sin(angle / 2)), aside(length * std::cos(angle / 2), 0, 0);
    return together(strip(up - aside, Vec3(0), half), strip(Vec3(0), up + aside, half));
}

/// A pyramid upside down.
Facets pit(int sides, double slope) {
    Facets surface;
    const auto corner = [&](int i) {
        const double turn = 2 * kPi * i / sides + 0.3;
        return 4.0 * Vec3(std::cos(turn), std::sin(turn), std::cos(kPi / sides) * std::tan(slope));
    };
    for (int i = 0; i < sides; ++i) surface.push_back({Vec3(0), corner(i), corner(i + 1)});
    return surface;
}

/// A floor, a riser of this slope and a plateau.
Facets step(double height, double slope) {
    const Vec3 edge(height / std::tan(slope), 0, height);
    return together(together(strip({-3, 0, 0}, {0, 0, 0}), strip({0, 0, 0}, edge)), strip(edge, edge + Vec3(3, 0, 0)));
}

/// A right angle whose corner is rounded by strips.
Facets fillet(double radius, int strips) {
    const double end = radius * std::sqrt(0.5);
    const Vec3 middle(0, 0, radius * std::sqrt(2.0));
    Vec3 last(-end, 0, end);
    Facets surface = strip({-3, 0, 3}, last);
    for (int i = 1; i <= strips; ++i) {
        const double angle = (225 + 90.0 * i / strips) * kDegree;
        const Vec3 next = middle + radius * Vec3(std::cos(angle), 0, std::sin(angle));
        surface = together(surface, strip(last, next));
        last = next;
    }
    return together(surface, strip(last, {3, 0, 3}));
}

Facets gap(double width) {
    return together(block({-2, -3, -2}, {-width / 2, 3, 0}), block({width / 2, -3, -2}, {2, 3, 0}));
}

/// Vertices that stand up from below the sphere.
Facets spikes(int count, double apart) {
    Facets surface;
    for (int i = 0; i < count; ++i) {
        const double turn = 2 * kPi * i / count;
        const Vec3 tip = apart * Vec3(std::cos(turn), std::sin(turn), 0);
        surface.push_back({tip, tip + Vec3(0.1, 0, -2), tip + Vec3(0, 0.1, -2)});
    }
    return surface;
}

/// Elastic energy and force of all contacts, in units of the stiffness; the deepest overlap.
struct State {
    double energy = 0, deepest = 0;
    Vec3 force{0};
    std::size_t contacts = 0;
};

State stateAt(const MeshSurface& mesh, const Vec3& centre) {
    State s;
    for (const Feature& f : mesh.touched(centre, 1)) {
        const double overlap = 1 - f.distance;
        s.energy += overlap * overlap / 2;
        s.force += overlap * f.share * f.normal;
        s.deepest = std::max(s.deepest, overlap);
        ++s.contacts;
    }
    return s;
}

struct Scan {
    std::size_t most = 0;  ///< contacts at once
    double worst = 0;      ///< what energy and work differ by, in units of the energy of the deepest overlap
    double met = 0;        ///< share of the way on which the sphere touches
};

/// Goes 60 straight ways in the box. Where an overlap is deeper than kDeepest the count of work begins anew.
Scan scan(const Facets& surface, const Vec3& low, const Vec3& high, int steps = 1500) {
    const MeshSurface mesh(makeMesh(soupOf(surface, "merging")).mesh, 1.1);
    std::mt19937_64 random(5);
    Scan found;
    std::size_t met = 0, all = 0;
    for (int way = 0; way < 60; ++way) {
        const Vec3 from = within(random, low, high), to = within(random, low, high);
        State before = stateAt(mesh, from);
        double begin = before.energy, work = 0;
        for (int k = 1; k <= steps; ++k) {
            const State now = stateAt(mesh, from + (to - from) * (double(k) / steps));
            work += glm::dot(before.force + now.force, to - from) / (2 * steps);
            if (std::max(before.deepest, now.deepest) > kDeepest) {
                begin = now.energy;
                work = 0;
            } else {
                met += now.contacts > 0 ? 1 : 0;
                found.most = std::max(found.most, now.contacts);
                found.worst = std::max(found.worst, std::abs(now.energy - begin + work) / (kDeepest * kDeepest / 2));
            }
            before = now;
            ++all;
        }
    }
    found.met = double(met) / double(all);
    return found;
}

/// Where the force turns in a kink, the sum over steps of a thousandth is off by half a step times the turn, which is
/// below 1e-3 of the energy at a fifth; a jump of the energy by 1 % is 1e-2 of it.
void checkScan(const std::string& name, const Facets& surface, const Vec3& low, const Vec3& high) {
    const Scan s = scan(surface, low, high);
    CAPTURE(name, s.worst, s.met, s.most);
    CHECK(s.met > 1e-4);  // there was something to see; a sphere in a narrow groove mostly lies deeper than counted
    CHECK(s.worst < 3e-3);
}

}  // namespace

TEST_CASE("no jump of the energy between the faces of a groove, from 5 to 175 degrees, and at its ends") {
    for (const double degrees : {5, 12, 19, 20, 21, 25, 30, 37, 45, 60, 90, 120, 150, 165, 175}) {
        const double up = 1 / std::cos(degrees * kDegree / 2);
        const double wide = std::min(1.0, 0.5 / std::tan(degrees * kDegree / 2));
        checkScan(fmt::format("{} degrees", degrees), groove(degrees * kDegree), {-wide, -0.3, 0.78 * up},
                  {wide, 0.3, up + 0.3 * wide});
        if (degrees > 130) continue;  // the sphere is far above the ends
        checkScan(fmt::format("end of {} degrees", degrees), groove(degrees * kDegree, 0.5), {-0.2, 0.2, 0.7},
                  {0.2, 1.3, up + 0.1});
    }
}

TEST_CASE("no jump of the energy in pits of three to six faces") {
    for (const int sides : {3, 4, 6})
        for (const double slope : {5, 15, 20, 25, 35, 50}) {
            const double up = 1 / std::cos(slope * kDegree);
            checkScan(fmt::format("{} faces, slope {}", sides, slope), pit(sides, slope * kDegree),
                      {-0.4, -0.4, 0.8 * up}, {0.4, 0.4, up + 0.2});
        }
}

TEST_CASE("no jump of the energy at a step, between a face and an edge") {
    for (const double height : {0.01, 0.05, 0.1, 0.2, 0.4, 0.7})
        for (const double slope : {15, 30, 60, 89})
            checkScan(fmt::format("height {}, slope {}", height, slope), step(height, slope * kDegree),
                      {-1.2, -0.3, 0.8}, {1.2, 0.3, 1.05 + height});
}

// geometry/README.md tells what is between these radii.
TEST_CASE("no jump of the energy in a rounded corner that is much narrower than the sphere, or wider") {
    for (const double radius : {0.2, 0.4, 1.2})
        for (const int strips : {1, 2, 4, 9}) {
            const double up = radius < 1 ? std::sqrt(2.0) : 1 + radius * (std::sqrt(2.0) - 1);
            if (radius > 1 && strips == 1) continue;  // a trough with a floor, which is not touched as deep
            checkScan(fmt::format("radius {}, {} strips", radius, strips), fillet(radius, strips),
                      {-0.3, -0.2, up - 0.25}, {0.3, 0.2, up + 0.15});
        }
}

TEST_CASE("no jump of the energy between two edges, and between vertices") {
    for (const double width : {0.1, 0.3, 0.35, 0.4, 0.6, 0.9, 1.4})
        checkScan(fmt::format("gap of {}", width), gap(width), {-0.8, -0.3, 0.6}, {0.8, 0.3, 1.05});
    for (const int count : {2, 3, 4})
        for (const double apart : {0.1, 0.16, 0.18, 0.25, 0.35, 0.6})
            checkScan(fmt::format("{} vertices {} from the middle", count, apart), spikes(count, apart),
                      {-0.5, -0.5, 0.7}, {0.5, 0.5, 1.05});
}

TEST_CASE("the force is the slope of the energy where places are merging") {
    // Edges and vertices turn the direction to them as the sphere moves; so do the passes between them.
    std::mt19937_64 random(9);
    int merging = 0;
    for (const Facets& surface : {groove(30 * kDegree), groove(45 * kDegree, 0.5), step(0.3, 60 * kDegree), gap(0.45),
                                  spikes(3, 0.3), pit(4, 25 * kDegree)}) {
        const MeshSurface mesh(makeMesh(soupOf(surface, "merging")).mesh, 1.1);
        for (int n = 0; n < 3000; ++n) {
            const Vec3 q = within(random, {-0.5, -0.8, 0.75}, {0.5, 0.8, 1.2});
            const State s = stateAt(mesh, q);
            const std::vector<Feature> found = mesh.touched(q, 1);
            const bool shares = std::any_of(found.begin(), found.end(), [](const Feature& f) { return f.share != 1; });
            if (!shares || s.deepest > kDeepest) continue;
            const double h = 1e-6;
            Vec3 slope(0), rough(0);
            for (int d = 0; d < 3; ++d) {
                Vec3 off(0);
                off[d] = h;
                const double more = stateAt(mesh, q + off).energy, less = stateAt(mesh, q - off).energy;
                slope[d] = (more - less) / (2 * h);
                rough[d] = (more - 2 * s.energy + less) / (2 * h);  // a kink between the two
            }
            if (glm::length(rough) > 1e-4) continue;
            CAPTURE(q.x, q.y, q.z, s.contacts);
            REQUIRE(near(s.force, -slope, kDeepest, 1e-5));
            ++merging;
        }
    }
    CHECK(merging > 1000);
}

TEST_CASE("merged places count once, and those apart twice") {
    // On the line above a groove, at a hundredth of overlap.
    const auto contacts = [](double degrees) {
        const MeshSurface mesh(makeMesh(soupOf(groove(degrees * kDegree), "groove")).mesh, 1.1);
        return mesh.touched({1e-4, 0, 0.99 / std::cos(degrees * kDegree / 2)}, 1).size();
    };
    for (const double degrees : {0.5, 2.0, 5.0, 10.0, 15.0, 19.0}) CHECK(contacts(degrees) == 1);
    for (const double degrees : {21.0, 25.0, 30.0, 60.0, 90.0, 120.0, 140.0}) CHECK(contacts(degrees) == 2);
}
