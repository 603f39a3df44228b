// Bodies on hinges on the device: as in the reference, and the same bits after a restart, in other batches and beside
// other canisters.

#include <cmath>

#include "host/law/hertz.h"
#include "host/sim/energy_ledger.h"
#include "tests/scene/free_body_bits.h"
#include "tests/support/catch.h"
#include "tests/support/records.h"

using namespace vkdose;
using namespace vkdose::test;

namespace {

constexpr double kFlapMass = 4e-3, kFlapLength = 11e-3, kFlapStart = -40;  // [kg], [m], [rad/s]
const Vec3 kFlapAxis = glm::normalize(Vec3(0.05, -0.03, 1));

constexpr double kOverBed = 11.4e-3;  ///< height of the flap just over tubeBed [m]

/// A closed tube about y with a flap over the spheres, which falls on them.
RuledWorld flapWorld(double height = 16.2e-3) {
    RuledWorld w = emptyWorld();
    w.domain = {Vec3(-0.02, -0.02, -0.02), Vec3(0.02, 0.06, 0.02)};
    const Vec3 y(0, 1, 0), at(-7.5e-3, height, 0.3e-3);
    w.bodies.push_back(bodyOf("tube", {geometry::Cone{Vec3(0), y, 9e-3, 9e-3, 50e-3}}));
    w.bodies.push_back(bodyOf("floor", {geometry::Cone{Vec3(0), y, 0, 9e-3, 0}}));
    geometry::Hinge hinge{kFlapAxis,  at,        kFlapMass * kFlapLength * kFlapLength / 3,
                          kFlapStart, kFlapMass, at + Vec3(kFlapLength / 2, 0, 0)};
    RigidBody flap = bodyOf("flap", {geometry::Block{Vec3(0, -0.4e-3, -4e-3), Vec3(kFlapLength, 0.4e-3, 4e-3)}}, hinge,
                            Clock::Forces);
    flap.course.start.origin = at;
    w.bodies.push_back(std::move(flap));
    return w;
}

geometry::Hinge& hingeOf(RuledWorld& w) {
    return std::get<geometry::Hinge>(w.bodies[2].course.motion);
}

}  // namespace

TEST_CASE("hinges: on the device a flap swings and meets spheres as in the reference") {
    RuledWorld w = flapWorld();
    SECTION("by its weight") {}
    SECTION("no heavier than a few spheres, under a law whose damping knows the masses") {
        w.law.pairs.fill(hertzMindlin({2e6, 0.25}, {2e6, 0.25}, 0.5));
        hingeOf(w).inertia = 2e-9;
        hingeOf(w).mass = 5e-5;
    }
    SECTION("driven by a torque, against damping") {
        hingeOf(w).rows = {{0, 0}, {1000 * w.timeStep, -2e-3}, {2500 * w.timeStep, 1e-3}};
        hingeOf(w).damping = 1e-5;
    }
    SECTION("from a time on") {
        w.bodies[2].course.schedule.intervals = {{33.5 * w.timeStep, geometry::kEndless}};
    }
    SECTION("as a mesh") {
        w.bodies[2].shapes = {meshOf(w.bodies[2].shapes[0], 2e-3)};
    }
    Particles p;
    p.add({-1e-3, 14.4e-3, 0.4e-3}, single(1.25e-3));
    p.add({2e-3, 13.9e-3, 0.9e-3}, single(1.2e-3));
    auto device = gpu();
    auto reference = makeReferenceBackend();
    device->load(w, p);
    reference->load(w, p);
    bool met = false;
    for (int call = 0; call < 30; ++call) {
        const Sensors a = device->advance(100, 0), b = reference->advance(100, 0);
        met = met || b.maxOverlapRatio > 1e-3;
        const double scale = std::max(1e-2, glm::length(b.bodies[2].force));
        CHECK(near(a.bodies[2].force, b.bodies[2].force, scale, 2e-3));
        CHECK(near(a.bodies[2].torque, b.bodies[2].torque, scale * kFlapLength, 2e-3));
        const FreeBody one = device->freeBodies().at(2), other = reference->freeBodies().at(2);
        CHECK(near(one.angle, other.angle, 1.25e-3 / kFlapLength, 1e-4));  // at its rim a ten-thousandth of a radius
        CHECK(near(one.rate, other.rate, 1 / kFlapLength, 2e-5));
    }
    CHECK(met);
    CHECK(differences(*device, *reference, 1).position < 1e-4);
    requireClean(*device);
}

TEST_CASE("hinges: a body that has turned many times stands where its angle says, to nanometres") {
    const double overlap = 2e-6, radius = 3e-3, sphere = 1.25e-3;
    RuledWorld w = emptyWorld();
    w.domain = {Vec3(-0.05), Vec3(0.05)};
    w.gravity = Vec3(0);
    const Vec3 axis = glm::normalize(Vec3(1, -2, 2)), through(3e-3, -2e-3, 5e-3), off(9e-3, 0, 1e-3);
    geometry::Hinge hinge{axis, through, 1e-7, 20'000};
    hinge.damping = 5e-5;  // it comes to rest after 40 rad, at no float
    RigidBody ball = bodyOf("ball", {geometry::Ball{off, radius}}, hinge, Clock::Forces);
    ball.course.start = {glm::angleAxis(0.6, glm::normalize(Vec3(1, 2, 3))), through + 2e-3 * axis};
    w.bodies.push_back(ball);
    Particles p;
    p.add(Vec3(0.04), single(sphere));
    p.add(Vec3(0), single(sphere));
    p.status[1] = Status::Waiting;
    auto device = gpu();
    auto reference = makeReferenceBackend();
    std::vector<double> force;
    for (Backend* b : {device.get(), reference.get()}) {
        b->load(w, p);
        b->advance(std::uint32_t(0.05 / w.timeStep), 0);  // 25 times as long as it takes to lose most of its rate
        const double angle = b->freeBodies().at(0).angle;
        CHECK(near(angle, 40, 40, 1e-3));
        const Vec3 centre = geometry::turned(ball.course.start, axis, through, angle).toWorld(off);
        b->addParticles(1, {centre + (radius + p.radius[1] - overlap) * glm::normalize(Vec3(2, 1, -1))});
        b->advance(1, 0);
        const std::vector<Contact> contacts = b->contacts();
        REQUIRE(contacts.size() == 1);
        force.push_back(glm::length(contacts[0].force));
    }
    CHECK(near(force[0], force[1], force[1], 2e-3));  // of 2 um
    requireClean(*device);
}

TEST_CASE("hinges: a flap that falls into a bed changes no bit by batches, a restart or other canisters") {
    checkSameBitsOverBed(flapWorld(kOverBed), [](const FreeBody& flap) { return flap.rate > 0.9 * kFlapStart; });
}

TEST_CASE("hinges: the bed takes from the flap what the ledger says, on the device as in the reference") {
    RuledWorld w = flapWorld(kOverBed);
    w.energyBook = true;
    const geometry::Hinge hinge = hingeOf(w);
    const Vec3 arm = hinge.centre - hinge.through;
    const auto energyOf = [&](const FreeBody& f) {
        const Vec3 way = glm::angleAxis(f.angle, kFlapAxis) * arm - arm;
        return 0.5 * hinge.inertia * f.rate * f.rate - kFlapMass * glm::dot(w.gravity, way);
    };
    for (const bool onDevice : {false, true}) {
        CAPTURE(onDevice);
        const auto backend = onDevice ? gpu() : makeReferenceBackend();
        backend->load(w, tubeBed());
        EnergyLedger ledger;
        for (int call = 0; call < 8; ++call) ledger.add(*backend->advance(499, 0).energy);
        const double had = 0.5 * hinge.inertia * kFlapStart * kFlapStart,
                     lost = had - energyOf(backend->freeBodies().at(2));
        CHECK(lost > 0.1 * had);
        // The rate of half a step before is at hand.
        CHECK(near(ledger.sum.bodyWork, lost, had, 1e-3));
        CHECK(near(ledger.residual(), 0, had, 1e-4));
        if (onDevice) requireClean(*backend);
    }
}

TEST_CASE("hinges: a rotor that nothing else moves beside makes the contact lists anew as it comes near",
          "[every-driver]") {
    RuledWorld w = flapWorld();
    w.bodies.erase(w.bodies.begin(), w.bodies.begin() + 2);
    w.gravity = Vec3(0);
    auto& hinge = std::get<geometry::Hinge>(w.bodies[0].course.motion);
    hinge.rate = -300;
    Particles p;
    p.add(hinge.through + Vec3(0.3e-3, -8e-3, 0.2e-3), single(1.25e-3));
    auto device = gpu();
    auto reference = makeReferenceBackend();
    for (Backend* b : {device.get(), reference.get()}) {
        b->load(w, p);
        b->advance(std::uint32_t(6e-3 / w.timeStep), 0);  // 1.8 rad; the sphere lies beyond 1.4
    }
    CHECK(reference->freeBodies().at(0).rate > -299.9);
    CHECK(near(device->freeBodies().at(0).rate, reference->freeBodies().at(0).rate, 300, 1e-4));
    CHECK(differences(*device, *reference, 3).position < 1e-2);
    requireClean(*device);
}
