// A sphere that rolls over a surface of triangles, with the contact law of the reference, and the history carried from
// facet to facet: its way and its forces are those on the exact surface.

#include <functional>
#include <random>

#include "geometry/matching.h"
#include "geometry/shape.h"
#include "host/backend/reference/contact.h"
#include "tests/geometry/shatter.h"
#include "tests/law/setups.h"
#include "tests/support/catch.h"
#include "tests/support/near.h"

using namespace vkdose;
using namespace vkdose::geometry;
using namespace vkdose::test;
using vkdose::reference::contactResponse;
using vkdose::reference::History;
using vkdose::reference::touchWall;

namespace {

struct Known {
    Vec3 normal;
    History history;
};

/// A sphere and its contacts with one body at rest, a step at a time (leapfrog, as in the reference).
struct Roller {
    reference::Body sphere{};
    std::vector<Known> contacts;
    Vec3 force{0}, torque{0};
    int begun = 0, most = 0;

    void step(const std::vector<Shape>& surface, const ContactLaw& law, const Vec3& gravity, double dt) {
        std::vector<Vec3> before, now;
        for (const Known& c : contacts) before.push_back(c.normal);
        const std::vector<Feature> found = touched(surface, sphere.position, sphere.radius);
        for (const Feature& f : found) now.push_back(f.normal);
        const std::vector<std::size_t> old = continued(before, now);

        const double mass = massOf(sphere.radius), inertia = 0.4 * mass * sphere.radius * sphere.radius;
        force = mass * gravity;
        torque = Vec3(0);
        std::vector<Known> next;
        for (std::size_t i = 0; i < found.size(); ++i) {
            Known c{now[i], {}};
            if (old[i] == kNew) {
                ++begun;
            } else {
                c.history = contacts[old[i]].history;
                c.history.sliding = turnedAlong(c.history.sliding, before[old[i]], now[i]);
                c.history.rolling = turnedAlong(c.history.rolling, before[old[i]], now[i]);
            }
            const auto touch = touchWall(sphere, found[i].normal, found[i].distance, geometry::Moving{});
            if (!touch) continue;
            const auto response = contactResponse(law, pairOf(ContactClass::ParticleWall), *touch, dt, c.history);
            force += response.force;
            torque += response.torqueI;
            next.push_back(c);
        }
        contacts = std::move(next);
        most = std::max(most, int(contacts.size()));
        sphere.velocity += dt / mass * force;
        sphere.spin += dt / inertia * torque;
        sphere.position += dt * sphere.velocity;
    }
};

constexpr double kStep = 4e-6;

/// A contact that was pressed to this depth, and the overlap at which it exerts no force: adhesion holds it there, and
/// would not if the depth were forgotten.
constexpr double kPressed = 5e-5;  // [m]
constexpr double kAtRest =
    (1 - kK1 / (kK1 + (kK2Max - kK1) * kPressed / (kK2Max / (kK2Max - kK1) * 0.05 * 2 * kRadius))) * kPressed;

/// Puts the sphere where such a contact with the nearest place of the surface is at rest.
void press(Roller& r, const std::vector<Shape>& surface) {
    const Feature at = touched(surface, r.sphere.position, 1.4 * kRadius).at(0);
    r.sphere.position += (kRadius - kAtRest - at.distance) * at.normal;
    Known c{at.normal, {}};
    c.history.maxOverlap = kPressed;
    r.contacts = {c};
}

/// The plane's own frame, tilted against the world so that no coordinate is a whole number.
const Vec3 kUp = glm::normalize(Vec3(0.3, 0.2, 1)), kAlong = glm::normalize(glm::cross(Vec3(0, 1, 0), kUp));
const Vec3 kAside = glm::cross(kUp, kAlong);

std::shared_ptr<const MeshSurface> surfaceOf(const Mesh& mesh) {
    return std::make_shared<const MeshSurface>(mesh, 1.5 * kRadius);
}

/// The square in meshes that have to be mended: in halves with a wall below the line where they meet; as the top of a
/// row of boxes; in halves of which one is cut into strips; with flat and double triangles.
std::vector<Mesh> mendedSquares(double half) {
    const auto sheet = [](std::vector<Triangle>& to, const Vec3& at, const Vec3& u, const Vec3& v) {
        to.push_back({at, at + u, at + u + v});
        to.push_back({at, at + u + v, at + v});
    };
    const Vec3 corner = -half * (kAlong + kAside), long1 = half * kAlong, wide = 2 * half * kAside;
    const Vec3 deep = -3 * kRadius * kUp;
    std::vector<Triangle> wall, boxes, strips, faulty;
    sheet(wall, corner, long1, wide);
    sheet(wall, corner + long1, long1, wide);
    sheet(wall, corner + long1, wide, deep);
    constexpr int kBoxes = 6;
    for (int i = 0; i < kBoxes; ++i) {
        const Vec3 at = corner + double(i) / kBoxes * 2.0 * long1, u = 2.0 / kBoxes * long1;
        sheet(boxes, at, u, wide);
        sheet(boxes, at, deep, wide);
        sheet(boxes, at + u, deep, wide);
        sheet(boxes, at + deep, u, wide);
    }
    constexpr int kStrips = 7;
    sheet(strips, corner, long1, wide);
    for (int i = 0; i < kStrips; ++i)
        sheet(strips, corner + long1 + double(i) / kStrips * wide, long1, wide / double(kStrips));
    sheet(faulty, corner, 2.0 * long1, wide);
    sheet(faulty, corner, 2.0 * long1, wide);
    faulty.push_back({faulty[0][0], faulty[0][2], faulty[0][1]});
    faulty.push_back({corner, corner + long1, corner + 2.0 * long1});
    faulty.push_back({corner, -corner, -0.3 * corner});
    std::vector<Mesh> meshes;
    for (const auto& triangles : {wall, boxes, strips, faulty}) {
        const CheckedMesh made = makeMesh(soupOf(triangles, "square"), 1e-9);
        REQUIRE_FALSE(made.facts.mended.empty());
        meshes.push_back(made.mesh);
    }
    return meshes;
}

}  // namespace

TEST_CASE("rolling: over a plane of triangles, along and across edges and corners, as over the plane") {
    const double half = 12 * kRadius;
    const Vec3 corner = -half * (kAlong + kAside);
    const std::vector<Triangle> square{{corner, corner + 2 * half * kAlong, -corner},
                                       {corner, -corner, corner + 2 * half * kAside}};
    // Strong adhesion, so that what the contact remembers matters; friction and rolling resistance.
    const ContactLaw law = lawOf(paperParameters(0.5, 0.4, 0.05));
    const Vec3 gravity = -9.81 * kUp;
    // Along the diagonal, which is an edge; along a row of edges and corners of the refined meshes; obliquely.
    const Vec3 ways[] = {glm::normalize(kAlong + kAside), kAlong, glm::normalize(kAlong + 0.37 * kAside)};
    const Vec3 starts[] = {0.8 * corner, -0.8 * half * kAlong, -0.7 * half * kAlong - 0.3 * half * kAside};
    for (int way = 0; way < 3; ++way) {
        const auto roll = [&](const std::vector<Shape>& surface, Roller& r, const std::function<void(int)>& look) {
            r.sphere = {starts[way] + kRadius * kUp, 0.4 * ways[way], 200.0 * ways[way], kRadius};
            press(r, surface);
            for (int n = 0; n < 6000; ++n) {
                r.step(surface, law, gravity, kStep);
                if (n % 50 == 0) look(n);
            }
        };
        std::vector<Vec3> places, forces, torques;
        std::vector<History> histories;
        Roller exact;
        roll({Plane{Vec3(0), kUp}}, exact, [&](int) {
            places.push_back(exact.sphere.position);
            forces.push_back(exact.force);
            torques.push_back(exact.torque);
            REQUIRE(exact.contacts.size() == 1);
            histories.push_back(exact.contacts[0].history);
        });
        CHECK(glm::length(places.back() - places.front()) > 5 * kRadius);  // it has gone some way
        const double weight = massOf(kRadius) * 9.81;
        int triangulation = 0;
        std::vector<Mesh> meshes = tenTriangulations(square);
        for (Mesh& mesh : mendedSquares(half)) meshes.push_back(std::move(mesh));
        for (const Mesh& mesh : meshes) {
            CAPTURE(way, triangulation++, mesh.triangles.size());
            Roller r;
            std::size_t k = 0;
            roll({surfaceOf(mesh)}, r, [&](int n) {
                CAPTURE(n);
                REQUIRE(near(r.sphere.position, places[k], kRadius, 1e-9));
                REQUIRE(near(r.force, forces[k], weight, 1e-6));
                REQUIRE(near(r.torque, torques[k], weight * kRadius, 1e-6));
                REQUIRE(r.contacts.size() == 1);
                REQUIRE(near(r.contacts[0].history.maxOverlap, histories[k].maxOverlap, kRadius, 1e-10));
                REQUIRE(near(r.contacts[0].history.sliding, histories[k].sliding, kRadius, 1e-9));
                REQUIRE(near(r.contacts[0].history.rolling, histories[k].rolling, kRadius, 1e-9));
                ++k;
            });
            CHECK(r.begun == 0);
            CHECK(r.most == 1);
        }
    }
}

TEST_CASE("rolling: in a tube of facets, and in a hopper, the way approaches that in the exact shape") {
    struct Way {
        const char* name;
        Shape shape;
        Vec3 start, velocity;
    };
    const double angle = -kPi / 2 + 0.9;  // up the side of the tube; it swings down and up the other side
    const Way ways[] = {{"tube", Tube{{0, 0, -0.1}, {0, 0, 1}, 6 * kRadius, 0.2, true},
                         5 * kRadius * Vec3(std::cos(angle), std::sin(angle), 0), Vec3(0, 0, 0.05)},
                        // Round the hopper, a little too slow to keep its height.
                        {"hopper", Cone{{0, 0, 0}, {0, -1, 0}, 14 * kRadius, 2 * kRadius, 16 * kRadius},
                         kRadius * Vec3(8.2, -6, 0), Vec3(0, 0, 0.3)}};
    const ContactLaw law = lawOf(paperParameters(0.2, 0.5, 0), CoulombLimit::Luding);
    for (const Way& way : ways) {
        const auto roll = [&](const std::vector<Shape>& surface) {
            Roller r;
            r.sphere = {way.start, way.velocity, Vec3(0), kRadius};
            press(r, surface);
            for (int n = 0; n < 15000; ++n) r.step(surface, law, Vec3(0, -9.81, 0), kStep);
            return r;
        };
        const Roller exact = roll({way.shape});
        REQUIRE(exact.contacts.size() == 1);
        CHECK(glm::length(exact.sphere.position - way.start) > 4 * kRadius);
        std::vector<double> apart;
        for (const double facet : {1.5, 0.75, 0.375}) {
            const auto triangles = tessellated(way.shape, facet * kRadius, Vec3(-1), Vec3(1));
            const Roller r = roll({surfaceOf(makeMesh(soupOf(triangles, way.name), 1e-9).mesh)});
            apart.push_back(glm::length(r.sphere.position - exact.sphere.position) / kRadius);
            CHECK(r.most == 1);
        }
        CAPTURE(way.name, apart[0], apart[1], apart[2], exact.sphere.position.x / kRadius,
                exact.sphere.position.y / kRadius);
        // Over each valley the sphere loses the part of its speed that points into the next facet. That is a part of
        // its energy of second order in the facet, at a number of valleys that grows with its inverse: first order
        // together.
        CHECK(apart[0] < 0.5);
        CHECK(apart[2] < 0.35 * apart[0]);
    }
}

TEST_CASE("rolling: a contact goes on over the edge of a block, from its top to its side") {
    const Vec3 low(-10 * kRadius, -10 * kRadius, -10 * kRadius), high(0, 10 * kRadius, 0);
    const auto triangles = tessellated(Block{low, high, false}, 1, low, high);
    const ContactLaw law = lawOf(paperParameters(0.5, 0.5, 0.05));
    // Adhesion holds the sphere on the block while it goes over the edge; there is no gravity.
    const auto roll = [&](const std::vector<Shape>& surface) {
        Roller r;
        r.sphere = {Vec3(-kRadius, 0, kRadius), Vec3(0.02, 0, 0), Vec3(0, 0.02 / kRadius, 0), kRadius};
        press(r, surface);
        for (int n = 0; n < 40000; ++n) r.step(surface, law, Vec3(0), kStep);
        return r;
    };
    const Roller exact = roll({Block{low, high, false}});
    const Roller meshed = roll({surfaceOf(makeMesh(soupOf(triangles, "block"), 1e-9).mesh)});
    CAPTURE(exact.sphere.position.x / kRadius, exact.sphere.position.z / kRadius);
    REQUIRE(exact.contacts.size() == 1);
    REQUIRE(meshed.contacts.size() == 1);
    CHECK(exact.begun == 0);
    CHECK(meshed.begun == 0);
    CHECK(exact.sphere.position.x > 0);  // it has gone beyond the edge
    CHECK(near(meshed.sphere.position, exact.sphere.position, kRadius, 1e-6));
    CHECK(near(meshed.contacts[0].history.maxOverlap, exact.contacts[0].history.maxOverlap, kRadius, 1e-6));
}

TEST_CASE("rolling: a sphere dropped on a block and on a mesh of it rebounds alike") {
    const Vec3 low(-3 * kRadius), high(3 * kRadius);
    const ContactLaw law = lawOf(paperParameters(0.1, 0.5, 0.1));
    std::vector<Triangle> triangles = tessellated(Block{low, high, false}, 1, low, high);
    for (const Vec3& above : {Vec3(0.2, 0.1, 4.1), Vec3(2.99, 0.1, 4.1), Vec3(3.2, 0.3, 4.1), Vec3(3.2, 3.1, 4.1)}) {
        const auto drop = [&](const std::vector<Shape>& surface) {
            Roller r;
            r.sphere = {kRadius * above, Vec3(0, 0, -0.5), Vec3(10, 20, 30), kRadius};
            for (int n = 0; n < 1500; ++n) r.step(surface, law, Vec3(0, 0, -9.81), kStep);
            return r;
        };
        const Roller exact = drop({Block{low, high, false}});
        CHECK(exact.begun >= 1);
        CHECK(exact.sphere.velocity.z > -0.3);
        for (const Mesh& mesh : tenTriangulations(triangles)) {
            const Roller meshed = drop({surfaceOf(mesh)});
            CAPTURE(above.x, above.y, mesh.triangles.size());
            CHECK(near(meshed.sphere.position, exact.sphere.position, kRadius, 1e-8));
            CHECK(near(meshed.sphere.velocity, exact.sphere.velocity, 0.5, 1e-8));
            CHECK(near(meshed.sphere.spin, exact.sphere.spin, 0.5 / kRadius, 1e-8));
        }
    }
}
