// The coil whose surface contacts see at rest: the law sees no motion of it, but it turns, pushes and takes work.

#include <array>
#include <random>

#include "host/sim/energy_ledger.h"
#include "tests/law/setups.h"
#include "tests/support/catch.h"
#include "tests/support/near.h"

using namespace vkdose;
using namespace vkdose::test;

namespace {

constexpr double kRate = -9.42;  // 90 rpm, conveying

/// A coil in free space, and a sphere at rest that is pressed into its wire.
RuledWorld coilWorld(bool surfaceMoves) {
    RuledWorld world = freeWorld(paperParameters(), 1e-6);
    world.coil = geometry::Coil{10.4e-3, 8.75e-3, 1e-3, 70e-3, 0, 0.3, 1};
    world.coilSurfaceMoves = surfaceMoves;
    return world;
}

Particles pressedIn(const geometry::Coil& coil, double overlap) {
    const geometry::CoilTouch wire = geometry::closestPoint(coil, 0, Vec3(0, -9e-3, 30e-3));
    Particles one;
    one.add(wire.point + (kRadius - overlap) * wire.normal, kRadius);
    return one;
}

/// A short canister that soon doses, with every force on.
RuledWorld dosingWorld() {
    ContactParameters p = paperParameters(0.3);
    p.kTo = 4000;
    p.gammaTo = 0.01;
    p.muTo = 0.3;
    RuledWorld world = freeWorld(p, 2e-6);
    world.gravity = Vec3(0, -kGravity, 0);
    world.maxOverlapRatio = 1;
    world.energyBook = true;
    world.walls = {geometry::Trough{8e-3, 16e-3}, geometry::Plane{Vec3(0), Vec3(0, 0, 1)},
                   geometry::Front{16e-3, 8e-3, 3e-3}};
    world.coil = geometry::Coil{6.5e-3, 6e-3, 0.9e-3, 19e-3};
    world.coilSurfaceMoves = false;
    world.coilWireCurved = true;
    world.domain = {Vec3(-0.02), Vec3(0.02, 0.1, 0.05)};
    world.throatZ = 16e-3;
    world.outletZ = 19e-3;
    return world;
}

Particles thrownIn() {
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> unit(-1, 1);
    Particles p;
    for (int y = 0; y < 4; ++y)
        for (int x = -2; x <= 2; ++x)
            for (int z = 0; z < 5; ++z)
                p.add(Vec3(2.8e-3 * x, 10e-3 + 2.8e-3 * y, 1.6e-3 + 2.8e-3 * z), kRadius * (0.9 + 0.15 * unit(random)),
                      Vec3(0.1 * unit(random), -0.3, 0.2), 50.0 * Vec3(unit(random), unit(random), unit(random)));
    return p;
}

}  // namespace

TEST_CASE(
    "surface velocity: a sphere at rest on the turning coil is dragged along, unless the surface is seen at rest") {
    const double overlap = 2e-6;
    const auto firstForce = [&](bool surfaceMoves, double rate) {
        const RuledWorld world = coilWorld(surfaceMoves);
        auto backend = makeReferenceBackend();
        backend->load(world, pressedIn(*world.coil, overlap));
        backend->advance(1, rate);
        return backend->contacts().at(0).force;
    };
    const Vec3 still = firstForce(true, 0), moving = firstForce(true, kRate), seenAtRest = firstForce(false, kRate);
    CHECK(near(glm::length(still), kK1 * overlap, kK1 * overlap, 1e-6));
    // The first step sees the loaded place, so that nothing but the surface's velocity can make a difference: not a
    // bit when it is seen at rest, and gamma_t V_t along the wire, 2.3 mN beside the 9.6 mN of the spring, when not.
    CHECK(seenAtRest == still);
    CHECK(glm::length(moving - still) > 0.1 * glm::length(still));
}

TEST_CASE("surface velocity: without damping and friction nothing sees it, and both readings are the same bits") {
    Particles ends[2];
    for (const bool surfaceMoves : {true, false}) {
        RuledWorld world = coilWorld(surfaceMoves);
        for (ContactParameters& p : world.law.pairs) p.gamma = p.gammaT = p.gammaR = p.mu = p.muR = 0;
        auto backend = makeReferenceBackend();
        backend->load(world, pressedIn(*world.coil, 2e-6));
        backend->advance(2000, kRate);
        ends[surfaceMoves ? 1 : 0] = backend->particles();
    }
    CHECK(ends[0].position == ends[1].position);
    CHECK(ends[0].velocity == ends[1].velocity);
    CHECK(glm::length(ends[0].velocity[0]) > 0.01);
}

TEST_CASE("wire curvature: a sphere at the wire gets stiff earlier and rolls on a shorter lever") {
    // Pressed so deep that a flat wire is still plastic, 1.25 phi_f 2 a = 156 um, and a curved one, 69 um, is not.
    const double overlap = 100e-6, b = 1e-3, curved = 2 * kRadius * b / (kRadius + b);
    const ContactParameters p = paperParameters();
    REQUIRE(1.25 * p.plasticityDepth * curved < overlap);
    for (const bool isCurved : {false, true}) {
        RuledWorld world = coilWorld(true);
        world.coilWireCurved = isCurved;
        Particles one = pressedIn(*world.coil, overlap);
        one.spin[0] = Vec3(0, 0, 100);
        auto backend = makeReferenceBackend();
        backend->load(world, one);
        backend->advance(1, 0);
        const double limit = 1.25 * p.plasticityDepth * curved;
        const double flat = p.k1 * overlap, stiff = p.k1 * limit + p.k2Max * (overlap - limit);
        const Contact c = backend->contacts().at(0);
        const Vec3 n = glm::normalize(one.position[0] - geometry::closestPoint(*world.coil, 0, one.position[0]).point);
        CHECK(near(glm::dot(c.force, n), isCurved ? stiff : flat, flat, 1e-6));
        // The second step's rolling spring has grown by a_r |n x omega| dt.
        backend->advance(1, 0);
        const double lever = isCurved ? curved : 2 * kRadius;
        const double way = lever * glm::length(glm::cross(n, backend->particles().spin[0])) * world.timeStep;
        CHECK(nearRelative(glm::length(backend->contacts().at(0).rolling), way, 0.05));
    }
}

TEST_CASE("surface velocity: a coil seen at rest still conveys at V_z") {
    RuledWorld world = freeWorld(spring(1000), 1e-5);
    for (ContactParameters& p : world.law.pairs) {
        p.k1 = 500;
        p.plasticityDepth = 0.05;
        p.gamma = 0.02;
        p.mu = 0.3;
        p.kt = p.kr = 200;
        p.gammaT = p.gammaR = 5e-3;
        p.muR = 0.05;
    }
    world.gravity = Vec3(0, -kGravity, 0);
    const double half = 11.5e-3;
    world.walls = {geometry::Trough{half}};
    const geometry::Coil coil{10.4e-3, 8.75e-3, 1e-3, 70e-3, 0, 0.3, 1};
    world.coil = coil;
    world.coilSurfaceMoves = false;
    const Vec3 bottom(0, -(half - kRadius), 20e-3);
    Particles one;
    one.add(Vec3(0, bottom.y, geometry::closestPoint(coil, 0, bottom).point.z + coil.pitch / 2), kRadius);
    auto backend = makeReferenceBackend();
    backend->load(world, one);
    backend->advance(60000, kRate);
    const double before = backend->particles().position[0].z;
    const Sensors sensors = backend->advance(120000, kRate);
    // It rests on the wire behind it, whose shape comes on; a wobble of tenths of a millimetre in 16 would be allowed.
    CHECK(nearRelative((backend->particles().position[0].z - before) / 1.2, coil.pitch * 9.42 / (2 * kPi), 0.02));
    CHECK(sensors.coilTorque * kRate < 0);
}

TEST_CASE("surface velocity: the energy book closes with a coil seen at rest, and its work is torque times rate") {
    RuledWorld world = dosingWorld();
    auto backend = makeReferenceBackend();
    backend->load(world, thrownIn());
    EnergyLedger ledger;
    double worst = 0, byTorque = 0;
    const double rate = -60;
    for (int n = 0; n < 200; ++n) {
        const Sensors s = backend->advance(100, n < 50 ? 0 : rate);
        if (n >= 50) byTorque -= s.coilTorque * rate * 100 * world.timeStep;
        ledger.add(*s.energy);
        worst = std::max(worst, std::abs(ledger.residual()));
    }
    const EnergyBook& b = ledger.sum;
    const double scale = std::abs(b.loaded) + std::abs(b.coilWork);
    CHECK(near(worst, 0, scale, 1e-11));  // exact: only rounding is left
    CHECK(b.coilWork > 0.1 * b.loaded);
    // The book takes each step's mean of two torques; the sum of the torques differs by half a step at either end.
    CHECK(near(b.coilWork, byTorque, byTorque, 1e-2));
    // The laws of damping and friction see another velocity than the books, so that their losses may have either sign.
    for (const double loss : {b.plastic, b.adhesive}) CHECK(loss > 1e-4 * ledger.losses());
    // The spring of the normal force is charged by the true approach of wire and sphere, seen or not. Charged by what
    // the law sees, the loss by the time step would be no small part any more.
    CHECK(near(b.numerical, 0, b.plastic + b.adhesive + b.viscous, 2e-3));
}
