// Bodies in the reference backend: the same motion as with the surfaces and the coil they stand for, loads, energy,
// restart and errors.

#include <cmath>

#include "geometry/shape.h"
#include "host/core/error.h"
#include "host/sim/energy_ledger.h"
#include "tests/law/setups.h"
#include "tests/support/catch.h"
#include "tests/support/near.h"

using namespace vkdose;
using namespace vkdose::test;
using Catch::Contains;

namespace {

constexpr double kStep = 2e-6;

RigidBody bodyOf(std::vector<geometry::Shape> shapes, geometry::Motion motion = geometry::Rest{},
                 Clock clock = Clock::Time) {
    return {"thing", std::move(shapes), {geometry::Pose{}, std::move(motion), {}}, clock, kWallMaterial};
}

/// A drum of 30 mm in diameter and 8 mm in length about z, closed at both ends, that turns at 12 rad/s.
RuledWorld drumWorld(const ContactParameters& p) {
    RuledWorld world = freeWorld(p, kStep);
    world.gravity = Vec3(0, -kGravity, 0);
    const double radius = 15e-3, length = 8e-3;
    world.bodies.push_back(bodyOf({geometry::Cone{Vec3(0), Vec3(0, 0, 1), radius, radius, length},
                                   geometry::Cone{Vec3(0), Vec3(0, 0, 1), 0, radius, 0},
                                   geometry::Cone{Vec3(0, 0, length), Vec3(0, 0, 1), 0, radius, 0}},
                                  geometry::Turn{Vec3(0, 0, 1), Vec3(0), 12.0}));
    return world;
}

/// Twelve spheres in three layers, the lowest at height `y` [m].
Particles handful(double y) {
    Particles particles;
    for (int i = 0; i < 12; ++i) {
        const double x = (i % 4 - 1.5) * 2.6e-3, height = y + (i / 4) * 2.6e-3;
        particles.add(Vec3(x, height, 4e-3 + (i % 3 - 1) * 1e-3), kRadius * (1 - 0.01 * i),
                      Vec3(0.05, 0, 0.02 * (i % 3 - 1)), Vec3(i, 2, -i));
    }
    return particles;
}

double farthest(const Particles& a, const Particles& b) {
    double most = 0;
    for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, glm::length(a.position[i] - b.position[i]));
    return most;
}

/// The way of the particles in two worlds, in units of the radius.
double apart(const RuledWorld& one, const RuledWorld& other, const Particles& particles, std::uint32_t steps,
             double rate) {
    auto a = makeReferenceBackend(), b = makeReferenceBackend();
    a->load(one, particles);
    b->load(other, particles);
    a->advance(steps, rate);
    b->advance(steps, rate);
    REQUIRE(farthest(a->particles(), particles) > 0.2 * kRadius);
    return farthest(a->particles(), b->particles()) / kRadius;
}

}  // namespace

TEST_CASE("bodies: walls as a body move particles as the same walls as surfaces") {
    RuledWorld surfaces = freeWorld(paperParameters(0.1), kStep);
    surfaces.gravity = Vec3(0, -kGravity, 0);
    const geometry::Plane floor{Vec3(0, -12e-3, 0), Vec3(0, 1, 0)}, side{Vec3(-6e-3, 0, 0), Vec3(1, 0, 0)};
    RuledWorld bodies = surfaces;
    surfaces.walls = {floor, side};
    bodies.bodies.push_back(bodyOf({floor, side}));
    CHECK(apart(surfaces, bodies, handful(-9e-3), 20'000, 0) < 1e-6);
    // The same room, turned and shifted in its own frame.
    RuledWorld turned = bodies;
    const geometry::Pose pose{glm::angleAxis(0.7, glm::normalize(Vec3(1, 2, 3))), Vec3(0.01, -0.02, 0.005)};
    for (geometry::Shape& shape : turned.bodies[0].shapes) {
        auto& plane = std::get<geometry::Plane>(shape);
        plane.point = pose.toBody(plane.point);
        plane.normal = pose.directionToBody(plane.normal);
    }
    turned.bodies[0].course.start = pose;
    CHECK(apart(surfaces, turned, handful(-9e-3), 20'000, 0) < 1e-6);
}

TEST_CASE("bodies: a coil that follows the drive is the world's coil") {
    RuledWorld own = freeWorld(paperParameters(0.1), kStep);
    own.gravity = Vec3(0, -kGravity, 0);
    RuledWorld body = own;
    const geometry::Coil coil{8e-3, 6e-3, 1e-3, 12e-3, -2e-3, 0.3, 1};
    own.coil = coil;
    body.bodies.push_back(bodyOf({coil}, geometry::Turn{Vec3(0, 0, 1), Vec3(0), 1.0}, Clock::Drive));
    const Particles particles = handful(10.6e-3);  // just over the wire
    CHECK(apart(own, body, particles, 10'000, -9.0) < 1e-6);

    auto a = makeReferenceBackend(), b = makeReferenceBackend();
    a->load(own, particles);
    b->load(body, particles);
    const double torque = a->advance(12'000, -9.0).coilTorque;
    const Sensors sensors = b->advance(12'000, -9.0);
    REQUIRE(std::abs(torque) > 1e-9);
    CHECK(near(sensors.bodies.at(0).torque, torque, std::abs(torque), 1e-6));
    // A body that follows the drive stands when the drive does, and goes on from there.
    b->advance(10, 0);
    CHECK(near(b->coilAngle(), 12'000 * -9.0 * kStep, 1, 1e-12));
}

TEST_CASE("bodies: a turning drum exerts what it feels, and its work is torque by rate") {
    RuledWorld world = drumWorld(paperParameters(0.1));
    world.energyBook = true;
    auto backend = makeReferenceBackend();
    backend->load(world, handful(-12.4e-3));
    EnergyLedger ledger;
    double worst = 0, scale = 0, work = 0, torque = 0;
    for (int call = 0; call < 400; ++call) {
        const Sensors sensors = backend->advance(100, 0);
        ledger.add(*sensors.energy);
        worst = std::max(worst, std::abs(ledger.residual()));
        scale = std::max(scale, std::abs(ledger.sum.loaded) + std::abs(ledger.sum.bodyWork));
        work += sensors.bodies.at(0).work;
        torque += sensors.bodies.at(0).torque * 100 * kStep;
    }
    CHECK(near(worst, 0, scale, 1e-11));
    CHECK(ledger.sum.bodyWork > 1e-7);
    // The drum's work is that against the torque it bears. The first step's half kick gives no work.
    CHECK(near(work, -12.0 * torque, work, 1e-3));
    CHECK(near(ledger.sum.bodyWork, work, work, 1e-2));

    // What the particles gain in momentum in one step is gravity and what the drum does not bear.
    const Particles before = backend->particles();
    const Sensors sensors = backend->advance(1, 0);
    const Particles after = backend->particles();
    Vec3 gained(0), weight(0);
    for (std::size_t i = 0; i < before.size(); ++i) {
        const double m = massOf(before.radius[i]);
        gained += m * (after.velocity[i] - before.velocity[i]);
        weight += m * kStep * world.gravity;
    }
    CHECK(near(gained + kStep * sensors.bodies.at(0).force, weight, glm::length(weight), 1e-9));
    CHECK(glm::length(sensors.bodies.at(0).force) > 0.1 * glm::length(weight) / kStep);
}

TEST_CASE("bodies: a floor that shakes lifts its spheres, and the energy closes") {
    RuledWorld world = freeWorld(paperParameters(0.05), kStep);
    world.gravity = Vec3(0, -kGravity, 0);
    world.energyBook = true;
    // 5 g at the turning point: spheres leave it.
    const double w = 2 * kPi * 50, amplitude = 5 * kGravity / (w * w);
    world.bodies.push_back(bodyOf({geometry::Cone{Vec3(0, -12e-3, 0), Vec3(0, 1, 0), 0, 30e-3, 0}},
                                  geometry::Shake{Vec3(0, 1, 0), amplitude, 50, 0}));
    auto backend = makeReferenceBackend();
    backend->load(world, handful(-10e-3));
    EnergyLedger ledger;
    double worst = 0, scale = 0;
    for (int call = 0; call < 100; ++call) {
        ledger.add(*backend->advance(500, 0).energy);
        worst = std::max(worst, std::abs(ledger.residual()));
        scale = std::max(scale, std::abs(ledger.sum.loaded) + std::abs(ledger.sum.bodyWork));
    }
    CHECK(near(worst, 0, scale, 1e-11));
    CHECK(ledger.sum.bodyWork > 1e-6);
}

TEST_CASE("bodies: a run goes on from its record with the same bits") {
    const RuledWorld world = drumWorld(paperParameters(0.1));
    auto whole = makeReferenceBackend(), cut = makeReferenceBackend(), on = makeReferenceBackend();
    for (Backend* b : {whole.get(), cut.get(), on.get()}) b->load(world, handful(-12.4e-3));
    whole->advance(60'000, 0);
    cut->advance(40'000, 0);
    const Record record = cut->snapshot();
    on->restore(record);
    on->advance(20'000, 0);
    CHECK(on->snapshot() == whole->snapshot());
    REQUIRE_FALSE(whole->contacts().empty());

    Record broken = record;
    broken.put("contact_direction", std::vector<double>{});
    CHECK_THROWS_AS(on->restore(broken), RecordError);
}

TEST_CASE("bodies: an overlap that is too deep names the body") {
    RuledWorld world = drumWorld(paperParameters());
    Particles one;
    one.add(Vec3(0, -14.5e-3, 4e-3), kRadius);
    auto backend = makeReferenceBackend();
    backend->load(world, one);
    CHECK_THROWS_WITH(backend->advance(1, 0), Contains("particle 0 and body \"thing\""));
}
