// Bodies on hinges in the reference backend: closed forms, stops, phases, work, the automatic step, restart.

#include <algorithm>
#include <cmath>

#include "host/core/record.h"
#include "host/model/stability.h"
#include "host/sim/energy_ledger.h"
#include "tests/law/setups.h"
#include "tests/support/catch.h"
#include "tests/support/near.h"

using namespace vkdose;
using namespace vkdose::test;

namespace {

constexpr double kHingeStep = 2e-6, kHingeInertia = 1e-8, kHingeTorque = 3e-5;
const Vec3 kHingeAxis = glm::normalize(Vec3(1, 2, -2));

geometry::Hinge hingeAt(const Vec3& through) {
    geometry::Hinge hinge;
    hinge.axis = kHingeAxis;
    hinge.through = through;
    hinge.inertia = kHingeInertia;
    return hinge;
}

RuledWorld hingeWorld(std::vector<geometry::Shape> shapes, const geometry::Hinge& hinge, const ContactParameters& p) {
    RuledWorld world = freeWorld(p, kHingeStep);
    world.bodies.push_back(
        {"flap", std::move(shapes), {{{1, 0, 0, 0}, hinge.through}, hinge, {}}, Clock::Forces, kWallMaterial});
    return world;
}

RuledWorld hungAlone(const geometry::Hinge& hinge) {
    return hingeWorld({geometry::Ball{Vec3(5e-3, 0, 0), 3e-3}}, hinge, spring(1e3));
}

/// A disc that falls on spheres on a floor.
RuledWorld flapOverSpheres() {
    const Vec3 z(0, 0, 1);
    geometry::Hinge hinge = hingeAt(Vec3(-8e-3, 0, 2.2 * kRadius));
    hinge.axis = Vec3(0, 1, 0);
    hinge.rate = 10;
    RuledWorld world = hingeWorld({geometry::Cone{Vec3(8e-3, 0, 0), z, 0, 12e-3, 0}}, hinge, paperParameters(0.1));
    world.walls.push_back(geometry::Plane{Vec3(0), z});
    return world;
}

Particles underFlap() {
    Particles p;
    for (int i = 0; i < 9; ++i) p.add(Vec3((i % 3) * 2.6e-3, (i / 3 - 1) * 2.6e-3, kRadius), kRadius);
    return p;
}

/// A sphere far away from all.
Particles farFromHinge() {
    Particles p;
    p.add(Vec3(0.5, 0.5, 0), kRadius);
    return p;
}

FreeBody hingeAfter(const RuledWorld& world, std::uint32_t steps) {
    const auto backend = makeReferenceBackend();
    backend->load(world, farFromHinge());
    backend->advance(steps, 0);
    return backend->freeBodies().at(0);
}

}  // namespace

TEST_CASE("hinges: one that nothing touches turns as the closed form says") {
    geometry::Hinge hinge = hingeAt(Vec3(0.01, 0, 0));
    const std::uint32_t steps = 10'000;
    const double t = steps * kHingeStep;
    SECTION("by itself") {
        hinge.rate = 7;
        const FreeBody f = hingeAfter(hungAlone(hinge), steps);
        CHECK(f.angle == Approx(7 * t).epsilon(1e-12));
        CHECK(f.rate == 7);
        CHECK(f.shift == Vec3(0));
    }
    SECTION("by a torque") {
        hinge.rows = {{0, kHingeTorque}};
        CHECK(hingeAfter(hungAlone(hinge), steps).angle ==
              Approx(0.5 * kHingeTorque / kHingeInertia * t * t).epsilon(1e-9));
    }
    SECTION("by a torque that grows from nothing") {
        hinge.rows = {{0, 0}, {t, kHingeTorque}};
        CHECK(hingeAfter(hungAlone(hinge), steps).angle ==
              Approx(kHingeTorque / kHingeInertia * t * t / 6).epsilon(1e-4));
    }
    SECTION("from a time on") {
        hinge.rate = 7;
        RuledWorld world = hungAlone(hinge);
        world.bodies[0].course.schedule.intervals = {{t / 2, geometry::kEndless}};
        CHECK(hingeAfter(world, steps / 2 - 1).rate == 0);
        CHECK(hingeAfter(world, steps).angle == Approx(7 * t / 2).epsilon(1e-12));
    }
    SECTION("in its phases: it goes on without the torque") {
        hinge.rows = {{0, kHingeTorque}};
        RuledWorld world = hungAlone(hinge);
        world.bodies[0].phases = {Phase::Rotate};
        const auto backend = makeReferenceBackend();
        backend->load(world, farFromHinge());
        backend->setClocks({BodyClock{0, true, BodyClock::kNever}});
        backend->advance(steps, 0);
        backend->setClocks({BodyClock{steps, false, BodyClock::kNever}});
        backend->advance(steps, 0);
        CHECK(backend->freeBodies().at(0).rate ==
              Approx(kHingeTorque / kHingeInertia * (t - kHingeStep / 2)).epsilon(1e-9));
    }
    SECTION("to its stop, and back to the other") {
        hinge.rows = {{0, kHingeTorque}, {t, kHingeTorque}, {1.0001 * t, -kHingeTorque}};
        hinge.high = 0.1;
        hinge.low = -0.2;
        const FreeBody there = hingeAfter(hungAlone(hinge), steps), back = hingeAfter(hungAlone(hinge), 2 * steps);
        CHECK(there.angle == Approx(0.1).margin(1e-9));
        CHECK(there.rate == 0);
        CHECK(back.angle == Approx(-0.2).margin(1e-9));
    }
    SECTION("a line of a motor: the torque falls with the speed") {
        const double stalls = kHingeTorque, idles = 50;
        hinge.rows = {{0, stalls}};
        hinge.damping = stalls / idles;
        CHECK(hingeAfter(hungAlone(hinge), 20 * steps).rate == Approx(idles).epsilon(1e-6));
    }
}

TEST_CASE("hinges: a pendulum keeps its energy, whatever the direction of its axis") {
    geometry::Hinge hinge = hingeAt(Vec3(0.01, 0.02, 0));
    hinge.mass = 1e-3;
    hinge.centre = hinge.through + Vec3(2e-3, 0, 1e-3);
    RuledWorld world = hungAlone(hinge);
    world.gravity = Vec3(0, 0, -kGravity);
    const Vec3 arm = hinge.centre - hinge.through;
    const auto backend = makeReferenceBackend();
    backend->load(world, farFromHinge());
    backend->advance(1, 0);
    double least = 1, most = -1, fastest = 0;
    FreeBody before = backend->freeBodies().at(0);
    for (int call = 0; call < 60'000; ++call) {
        backend->advance(1, 0);
        const FreeBody now = backend->freeBodies().at(0);
        const double height = (glm::angleAxis(before.angle, kHingeAxis) * arm).z;
        const double energy = 0.5 * kHingeInertia * before.rate * now.rate + hinge.mass * kGravity * height;
        least = std::min(least, energy);
        most = std::max(most, energy);
        fastest = std::max(fastest, now.rate * now.rate);
        before = now;
    }
    CHECK(0.5 * kHingeInertia * fastest > 1e-6);
    CHECK(most - least < 1e-5 * 0.5 * kHingeInertia * fastest);
}

TEST_CASE("hinges: the pose and the axis of a body follow its angle") {
    RigidBody flap = hungAlone(hingeAt(Vec3(0.01, 0, 0))).bodies[0];
    flap.course.start.origin = Vec3(0.03, 0, 0);
    const geometry::Pose turned = flap.pose(9, 9, Moved(3, FreeBody{Vec3(0), Vec3(0), 2 * kPi / 3, 1}));
    const Vec3 arm = glm::angleAxis(2 * kPi / 3, kHingeAxis) * Vec3(0.02, 0, 0);
    CHECK(near(turned.origin, Vec3(0.01, 0, 0) + arm, 0.02, 1e-12));
    CHECK(flap.axis() == kHingeAxis);
    CHECK(flap.pivot(turned) == Vec3(0.01, 0, 0));
    // Across the axis at the arm L it weighs as I/L^2, along it as a wall.
    const Vec3 at = Vec3(0.01, 0, 0) + 0.04 * glm::normalize(glm::cross(kHingeAxis, Vec3(1, 0, 0)));
    CHECK(flap.perMass(at, glm::normalize(glm::cross(kHingeAxis, at - Vec3(0.01, 0, 0)))) ==
          Approx(0.04 * 0.04 / kHingeInertia));
    CHECK(flap.perMass(at, kHingeAxis) == Approx(0).margin(1e-9));
}

TEST_CASE("hinges: the work of a flap is what its own energy falls by, and the ledger closes") {
    RuledWorld world = flapOverSpheres();
    world.energyBook = true;
    const Particles p = underFlap();
    const auto backend = makeReferenceBackend();
    backend->load(world, p);
    EnergyLedger ledger;
    ledger.add(*backend->advance(1, 0).energy);
    FreeBody before = backend->freeBodies().at(0);
    ledger.add(*backend->advance(1, 0).energy);
    FreeBody now = backend->freeBodies().at(0);
    const auto motion = [&] { return 0.5 * kHingeInertia * before.rate * now.rate; };
    const double first = motion();
    double booked = 0;
    for (int n = 0; n < 8'000; ++n) {
        before = now;
        const Sensors s = backend->advance(1, 0);
        now = backend->freeBodies().at(0);
        booked += s.energy.value().bodyWork;
        ledger.add(*s.energy);
    }
    CHECK(booked > 0.1 * first);
    CHECK(near(first - motion(), booked, booked, 1e-9));
    CHECK(near(ledger.residual(), 0, booked, 1e-9));
}

TEST_CASE("hinges: the automatic step resolves the impact of one that is far lighter than the sphere") {
    const double sphere = massOf(kRadius), arm = 10e-3;
    for (const double share : {0.02, 0.5, 20.0}) {
        CAPTURE(share);
        geometry::Hinge hinge = hingeAt(Vec3(-arm, 0, -1.1e-3));
        hinge.axis = Vec3(0, -1, 0);
        hinge.inertia = share * sphere * arm * arm;
        hinge.rate = 0.5 / arm;
        RuledWorld world = hingeWorld({geometry::Ball{Vec3(arm, 0, 0), 1e-3}}, hinge, spring(1e4));
        Particles one;
        one.add(Vec3(0, 0, kRadius), kRadius);
        world.timeStep = automaticTimeStep(contactModes(world, world.law, powderSizes(world, one)), {});
        const auto backend = makeReferenceBackend();
        backend->load(world, one);
        backend->advance(std::uint32_t(2e-3 / world.timeStep), 0);
        REQUIRE(backend->contacts().empty());
        // An elastic impact. Eight steps in a contact leave an error of some 1 %.
        CHECK(near(backend->particles().velocity[0].z, 2 * share / (share + 1) * 0.5, 0.5, 0.02));
        CHECK(near(arm * backend->freeBodies().at(0).rate, (share - 1) / (share + 1) * 0.5, 0.5, 0.02));
    }
}

TEST_CASE("hinges: a run goes on from its record with the same bits") {
    RuledWorld world = flapOverSpheres();
    const Particles p = underFlap();
    auto whole = makeReferenceBackend(), cut = makeReferenceBackend(), on = makeReferenceBackend();
    for (Backend* b : {whole.get(), cut.get(), on.get()}) b->load(world, p);
    whole->advance(3'000, 0);
    cut->advance(2'000, 0);
    on->restore(cut->snapshot());
    on->advance(1'000, 0);
    CHECK(whole->freeBodies().at(0).angle == on->freeBodies().at(0).angle);
    CHECK(whole->freeBodies().at(0).rate == on->freeBodies().at(0).rate);
    CHECK(whole->particles().position == on->particles().position);
}
