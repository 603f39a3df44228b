// Trough, rim and throat are one wall to a sphere: one contact wherever it touches once, one history all the way
// through. On both backends.

#include <algorithm>

#include "host/sim/energy_ledger.h"
#include "tests/scene/agreement.h"

using namespace vkdose;
using namespace vkdose::test;

namespace {

constexpr double kHalf = 0.0115;    // half width of the trough [m]
constexpr double kFrontZ = 0.06;    // front wall
constexpr double kThroat = 0.01;    // its length
const double kA = single(1.25e-3);  // radius of the sphere
constexpr double kDegree = kPi / 180;

RuledWorld wallsOnly(std::vector<Wall> walls) {
    RuledWorld w = emptyWorld();
    w.gravity = Vec3(0);
    w.walls = std::move(walls);
    return w;
}

/// The paper's canister without its coil, with a hole of this radius.
RuledWorld canister(double hole = kHalf) {
    return wallsOnly({geometry::Trough{kHalf, kFrontZ}, geometry::Plane{{0, 0, 0}, {0, 0, 1}},
                      geometry::Front{kFrontZ, hole, kThroat}});
}

/// The same with a flat floor.
RuledWorld flatCanister() {
    return wallsOnly({geometry::Plane{{-kHalf, 0, 0}, {1, 0, 0}, kFrontZ},
                      geometry::Plane{{kHalf, 0, 0}, {-1, 0, 0}, kFrontZ},
                      geometry::Plane{{0, -kHalf, 0}, {0, 1, 0}, kFrontZ}, geometry::Plane{{0, 0, 0}, {0, 0, 1}},
                      geometry::Front{kFrontZ, kHalf, kThroat}});
}

/// A sphere `depth` deep in a cylinder about the z axis, at `angle` from the x axis.
Vec3 inWall(double radius, double depth, double angle, double z) {
    const double rho = radius - kA + depth;
    return {rho * std::cos(angle), rho * std::sin(angle), z};
}

/// The contacts with walls that a sphere has at each of these places, one after the other on their own as far as walls
/// are concerned: what spheres do to each other is not looked at.
std::vector<std::vector<Contact>> contactsAt(Backend& backend, RuledWorld world, const std::vector<Vec3>& places) {
    Particles p;
    for (const Vec3& x : places) p.add(x, kA);
    world.maxOverlapRatio = 10;
    backend.load(world, p);
    backend.advance(1, 0);
    std::vector<std::vector<Contact>> found(places.size());
    for (const Contact& c : backend.contacts())
        if (c.kind == ContactClass::ParticleWall) found[c.particle].push_back(c);
    return found;
}

/// Both backends with a name each.
template <class Body>
void onBoth(const Body& body) {
    SECTION("reference") {
        auto backend = makeReferenceBackend();
        body(*backend, 1e-9);
    }
    SECTION("device") {
        auto backend = gpu();
        body(*backend, 1e-4);  // of a force whose overlap of 2 um is right to 2e-10 m
        requireClean(*backend);
    }
}

/// Deepest contact with a wall so far of particle 0, and how many contacts it has.
struct Held {
    std::size_t contacts = 0;
    double deepest = 0;
};

Held held(const Backend& backend) {
    Held h;
    for (const Contact& c : backend.contacts()) {
        ++h.contacts;
        h.deepest = std::max(h.deepest, c.maxOverlap);
    }
    return h;
}

}  // namespace

TEST_CASE("throat: a sphere feels the same force in the trough, in the hole and in the throat, at every angle") {
    const double depth = 2e-6, force = 4813.4 * depth;
    onBoth([&](Backend& backend, double tolerance) {
        for (const double angle : {-179.0, -135.0, -90.0, -45.0, -10.0, -0.5, 45.0, 90.0, 179.5}) {
            std::vector<Vec3> places;
            for (const double past : {-0.03, -2 * kA, -1e-4, -1e-6, 0.0, 1e-6, 1e-4, 5e-3})
                if (angle < 0 || past >= 0)  // in front of the hole, above the axis, the trough is plane
                    places.push_back(inWall(kHalf, depth, angle * kDegree, kFrontZ + past));
            for (const auto& found : contactsAt(backend, canister(), places)) {
                CAPTURE(angle);
                REQUIRE(found.size() == 1);
                CHECK(near(glm::length(found[0].force), force, force, tolerance));
            }
        }
    });
}

TEST_CASE("throat: one contact along every path through a hole as wide as the trough", "[every-driver]") {
    onBoth([&](Backend& backend, double) {
        // Shallow, and pinched as by the coil; below the axis, and above it, where the wall has a sickle of a ledge.
        for (const double depth : {1e-8, 2e-6, 0.1 * kA, 0.3 * kA})
            for (const double angle : {-179.9, -120.0, -90.0, -30.0, -0.1, 0.0, 0.1, 0.5, 179.9}) {
                std::vector<Vec3> places;
                for (int step = -20; step <= 20; ++step) {
                    const double past = 0.005 * kA * step * std::abs(step);  // 5 um to 2.5 mm
                    places.push_back(inWall(kHalf, depth, angle * kDegree, kFrontZ + past));
                    if (angle > 0)
                        places.back().x = (angle < 90 ? 1 : -1) * (kHalf - kA + depth);  // the sides are plane
                }
                const auto found = contactsAt(backend, canister(), places);
                for (std::size_t k = 0; k < places.size(); ++k) {
                    CAPTURE(depth / kA, angle, places[k].z - kFrontZ);
                    CHECK(found[k].size() == 1);
                }
            }
    });
}

TEST_CASE("throat: a flat floor that touches the hole is one wall with the throat") {
    const double depth = 2e-6, force = 4813.4 * depth;
    onBoth([&](Backend& backend, double tolerance) {
        for (const double angle : {-90.0, 0.0, 180.0}) {
            std::vector<Vec3> places;
            for (const double past : {-2e-3, -1e-4, -1e-6, 0.0, 1e-6, 1e-4, 2e-3})
                places.push_back(inWall(kHalf, depth, angle * kDegree, kFrontZ + past));
            for (const auto& found : contactsAt(backend, flatCanister(), places)) {
                CAPTURE(angle);
                REQUIRE(found.size() == 1);
                CHECK(near(glm::length(found[0].force), force, force, tolerance));
            }
        }
    });
}

TEST_CASE("throat: a sphere in a corner or on a ledge has a contact with either wall") {
    onBoth([&](Backend& backend, double) {
        const double d = 2e-6;
        // Side and front wall above the hole.
        CHECK(contactsAt(backend, canister(), {{kHalf - kA + d, 0.02, kFrontZ - kA + d}})[0].size() == 2);
        // A hole that is narrower by half a radius: floor and rim of the ledge, then the throat alone.
        const double hole = kHalf - 0.5 * kA;
        const double rho = kHalf - kA + d, over = hole - rho;  // centre to rim, across
        const double before = std::sqrt((kA - d) * (kA - d) - over * over);
        std::vector<Vec3> places{{0, -rho, kFrontZ - before}, {0, -rho, kFrontZ - before - 2 * d}};
        for (const double past : {-5e-5, 0.0, 1e-4, 5e-3}) places.push_back(inWall(hole, d, -kPi / 2, kFrontZ + past));
        auto found = contactsAt(backend, canister(hole), places);
        CHECK(found[0].size() == 2);
        for (std::size_t k = 1; k < found.size(); ++k) CHECK(found[k].size() == 1);
        // A ledge of 1 um below an overlap of 2 um is none.
        places.clear();
        for (const double past : {-1e-4, -1e-5, 0.0, 1e-5, 1e-4})
            places.push_back(inWall(kHalf, d, -kPi / 2, kFrontZ + past));
        found = contactsAt(backend, canister(kHalf - 1e-6), places);
        for (const auto& one : found) CHECK(one.size() == 1);
    });
}

TEST_CASE("throat: a sphere slides from trough to throat and back as along an endless trough") {
    // Sticky, with friction, rolling and torsion: what a lost or doubled history would change. The sphere starts
    // pressed in and spinning, across and along, so that springs are stretched in every direction when it passes the
    // front wall.
    for (const double direction : {1.0, -1.0})
        for (const double angle : {-90.0, -40.0}) {
            CAPTURE(direction, angle);
            Particles p;
            p.add(inWall(kHalf, 4e-6, angle * kDegree, kFrontZ - direction * 1e-5), kA, {0.01, -0.02, direction * 1.5},
                  {40, 10, -70});
            RuledWorld ending = canister(), endless = wallsOnly({geometry::Trough{kHalf}});
            ending.law = endless.law = paperLaw(0.873);
            ending.gravity = endless.gravity = 2000.0 * Vec3(std::cos(angle * kDegree), std::sin(angle * kDegree), 0);
            onBoth([&](Backend& backend, double) {
                backend.load(endless, p);
                backend.advance(120, 0);
                const Particles expected = backend.particles();
                const std::vector<Contact> before = backend.contacts();
                REQUIRE((expected.position[0].z - kFrontZ) * direction > 1e-5);
                REQUIRE(before.size() == 1);
                backend.load(ending, p);
                backend.advance(120, 0);
                const Particles now = backend.particles();
                const std::vector<Contact> after = backend.contacts();
                REQUIRE(after.size() == 1);
                // Just before the wall the throat's rim is deeper than the trough, or the trough's end than the throat,
                // by no more than rounding; so the two worlds agree to that.
                CHECK(near(now.position[0], expected.position[0], kA, 1e-7));
                CHECK(near(now.velocity[0], expected.velocity[0], 1.5, 1e-5));
                CHECK(near(now.spin[0], expected.spin[0], 80, 1e-5));
                CHECK(nearRelative(after[0].maxOverlap, before[0].maxOverlap, 1e-5));
                CHECK(near(after[0].sliding, before[0].sliding, glm::length(before[0].sliding), 1e-4));
                CHECK(near(after[0].rolling, before[0].rolling, glm::length(before[0].rolling), 1e-4));
            });
        }
}

TEST_CASE("throat: a sphere goes round in the hole as in an endless tube") {
    // From the throat's top down the side and out into the trough, and the other way: the contact passes from the front
    // wall to the trough and back.
    RuledWorld tube = wallsOnly({geometry::Tube{{0, 0, 0}, {0, 0, 1}, kHalf}});
    RuledWorld ending = canister();
    for (RuledWorld* w : {&tube, &ending}) {
        w->law = paperLaw(0.873);
        w->timeStep = 4e-6;
    }
    const double start = GENERATE(20.0, -20.0), along = start > 0 ? -0.4 : 0.4, around = start > 0 ? -2.0 : 2.0;
    Particles p;
    const double a = start * kDegree, way = start > 0 ? 0.75e-3 : 0.3e-3;  // to the front wall: passed below the axis
    p.add(inWall(kHalf, 2e-6, a, kFrontZ - along / 0.4 * way), kA,
          around * Vec3(-std::sin(a), std::cos(a), 0) + Vec3(0, 0, along), {0, 0, -around / kA});
    onBoth([&](Backend& backend, double) {
        std::vector<Particles> ends;
        std::vector<std::vector<Contact>> contacts;
        for (const RuledWorld& w : {tube, ending}) {
            backend.load(w, p);
            backend.advance(900, 0);
            ends.push_back(backend.particles());
            contacts.push_back(backend.contacts());
        }
        const double passed = (ends[0].position[0].z - kFrontZ) * along;
        REQUIRE(passed > 0);
        REQUIRE(ends[0].position[0].y * start < 0);
        REQUIRE(contacts[0].size() == 1);
        REQUIRE(contacts[1].size() == 1);
        CHECK(near(ends[1].position[0], ends[0].position[0], kA, 1e-5));
        CHECK(near(ends[1].velocity[0], ends[0].velocity[0], 2, 1e-5));
        CHECK(nearRelative(contacts[1][0].maxOverlap, contacts[0][0].maxOverlap, 1e-4));
    });
}

TEST_CASE("throat: over the rim from the front wall the contact keeps its history") {
    // A sphere that has been pressed against the top of the throat moves out over the rim, and back in. Without
    // adhesion the deepest overlap of a contact that lasts never falls.
    RuledWorld world = canister();
    world.law = paperLaw(0);
    world.gravity = Vec3(0, 2000, 0);  // holds a sphere 5 um deep
    const double along = GENERATE(0.4, -0.4);
    Particles p;
    const double before = along > 0 ? 3e-5 : -1e-5;  // on the rim, a little out of line, or in the throat
    const double rise = std::sqrt(kA * kA - before * before * (along > 0 ? 1 : 0)) - kA;
    p.add({0, kHalf - kA + 5e-6 - rise, kFrontZ - before}, kA, {0, 0, along});
    onBoth([&](Backend& backend, double) {
        backend.load(world, p);
        double deepest = 0;
        for (int n = 0; n < 60; ++n) {
            backend.advance(1, 0);
            const Held now = held(backend);
            CAPTURE(n, backend.particles().position[0].z - kFrontZ);
            REQUIRE(now.contacts == 1);
            CHECK(now.deepest >= deepest * (1 - 1e-6));
            deepest = now.deepest;
        }
        REQUIRE((backend.particles().position[0].z - kFrontZ) * along > 1e-6);
    });
}

TEST_CASE("throat: the energy book closes while contacts pass from wall to wall") {
    RuledWorld world = canister();
    world.energyBook = true;
    world.law = paperLaw(0.873);
    world.gravity = Vec3(0, -9.81, 0);
    Particles p;
    for (int k = 0; k < 5; ++k) {
        const double angle = (-150 + 30 * k) * kDegree;
        p.add(inWall(kHalf, 3e-6, angle, kFrontZ - 5e-5 * (k % 2 == 0 ? 1 : -1)), kA,
              {0.02, -0.02, k % 2 == 0 ? 0.3 : -0.3}, {20, -30, 40});
    }
    onBoth([&](Backend& backend, double) {
        backend.load(world, p);
        EnergyLedger ledger;
        for (int n = 0; n < 20; ++n) ledger.add(*backend.advance(20, 0).energy);
        const double loaded = std::abs(ledger.sum.loaded);
        CHECK(near(ledger.residual(), 0, loaded, 1e-5));
        // A contact that lost its history would leave what its springs held to the numerical loss.
        CHECK(near(ledger.sum.numerical, 0, loaded, 1e-4));
    });
}
