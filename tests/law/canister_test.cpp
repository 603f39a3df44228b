// The reference backend with a coil and a whole small canister.

#include <algorithm>
#include <random>

#include "host/core/error.h"
#include "tests/law/setups.h"
#include "tests/support/catch.h"
#include "tests/support/near.h"

using namespace vkdose;
using namespace vkdose::test;
using geometry::Coil;

namespace {

constexpr double kTroughRadius = 11.5e-3;

/// Softer than the paper's powder, to be simulated quickly; settles without ringing.
ContactParameters softParameters() {
    ContactParameters p;
    p.k1 = 500;
    p.k2Max = 1000;
    p.kc = 100;
    p.plasticityDepth = 0.05;
    p.gamma = 0.02;
    p.kt = p.kr = 200;
    p.gammaT = p.gammaR = 5e-3;
    p.mu = 0.3;
    p.muR = 0.05;
    return p;
}

Coil coilOf(double length, int hand) {
    return {10.4e-3, 8.75e-3, 1e-3, length, 0, 0.3, hand};
}

/// A trough of 24 mm with a coil, an outlet and a throat of 6 mm.
RuledWorld smallCanister() {
    RuledWorld world = freeWorld(softParameters(), 1e-5);
    world.gravity = Vec3(0, -kGravity, 0);
    world.skin = 0.2e-3;
    world.walls = {geometry::Trough{kTroughRadius, 24e-3}, geometry::Plane{Vec3(0), Vec3(0, 0, 1)},
                   geometry::Front{24e-3, kTroughRadius, 6e-3}};
    world.coil = coilOf(30e-3, 1);
    world.throatZ = 24e-3;
    world.outletZ = 30e-3;
    world.domain = {Vec3(-12e-3, -12e-3, -1e-3), Vec3(12e-3, 60e-3, 32e-3)};
    return world;
}

/// 4 x 4 x 6 particles of several sizes above the coil.
Particles heap() {
    std::mt19937_64 random(99);
    std::uniform_real_distribution<double> unit(0, 1);
    Particles particles;
    for (int y = 0; y < 6; ++y)
        for (int x = 0; x < 4; ++x)
            for (int z = 0; z < 4; ++z) {
                const double a = 1e-3 + 0.8e-3 * unit(random);
                const double dx = unit(random), dz = unit(random);
                particles.add(Vec3(-6e-3 + 4e-3 * x + 0.3e-3 * dx, 14e-3 + 4e-3 * y, 4e-3 + 4e-3 * z + 0.3e-3 * dz), a);
            }
    return particles;
}

double totalMass(const Particles& p) {
    double mass = 0;
    for (const double a : p.radius) mass += massOf(a);
    return mass;
}

}  // namespace

TEST_CASE("canister: a coil turns in an empty one") {
    auto backend = makeReferenceBackend();
    backend->load(smallCanister(), {});
    const double rate = -9.42;
    Sensors sensors{};
    for (int n = 0; n < 10; ++n) sensors = backend->advance(1000, rate);
    CHECK(nearRelative(backend->coilAngle(), rate * 10000 * 1e-5, 1e-12));
    backend->advance(1000, 0);
    CHECK(nearRelative(backend->coilAngle(), rate * 10000 * 1e-5, 1e-12));
    CHECK(sensors.coilTorque == 0);
    CHECK(sensors.count == std::array<std::uint64_t, 4>{0, 0, 0, 0});
}

TEST_CASE("canister: the coil pushes a particle at V_z = p Omega / 2 pi") {
    for (const int hand : {1, -1}) {
        RuledWorld world = freeWorld(softParameters(), 1e-5);
        world.gravity = Vec3(0, -kGravity, 0);
        for (ContactParameters& p : world.law.pairs) p.kc = 0;
        world.walls = {geometry::Trough{kTroughRadius}};
        const Coil coil = coilOf(70e-3, hand);
        world.coil = coil;
        Particles one;
        const Vec3 bottom(0, -(kTroughRadius - kRadius), 20e-3);
        const double between = geometry::closestPoint(coil, 0, bottom).point.z + coil.pitch / 2;
        one.add(Vec3(bottom.x, bottom.y, between), kRadius);
        auto backend = makeReferenceBackend();
        backend->load(world, one);

        const double speed = 3 * kPi, rate = geometry::conveyingRate(coil, speed);  // 90 rpm
        backend->advance(60000, rate);  // the next turn arrives and takes it along
        const double before = backend->particles().position[0].z;
        const Sensors sensors = backend->advance(120000, rate);
        const double pushed = (backend->particles().position[0].z - before) / 1.2;
        // It rests on the wire behind it and goes with it; a wobble of tenths of a millimetre in 16 would be allowed.
        const double expected = coil.pitch * speed / (2 * kPi);
        CHECK(nearRelative(pushed, expected, 0.02));
        CHECK(sensors.coilTorque * rate < 0);  // the particle holds the coil back
    }
}

TEST_CASE("canister: torque on the coil is the moment of the opposite of the force on the particle") {
    RuledWorld world = freeWorld(softParameters(), 1e-6);
    const Coil coil = coilOf(70e-3, 1);
    world.coil = coil;
    const double overlap = 2e-6;
    const geometry::CoilTouch wire = geometry::closestPoint(coil, 0, Vec3(0, -9e-3, 30e-3));
    Particles one;
    one.add(wire.point + (kRadius - overlap) * wire.normal, kRadius);
    auto backend = makeReferenceBackend();
    backend->load(world, one);
    const Sensors sensors = backend->advance(1, 0);
    const Vec3 force = massOf(kRadius) * backend->particles().velocity[0] / 0.5e-6;  // of the first half kick
    const Vec3 point = wire.point - 0.5 * overlap * wire.normal;
    const double expected = -glm::cross(point, force).z;
    REQUIRE(glm::length(force) > 0);
    CHECK(near(sensors.coilTorque, expected, glm::length(force) * coil.radius, 1e-6));
    CHECK(near(force, 500 * overlap * wire.normal, 500 * overlap, 1e-6));  // at rest: the k1 branch alone
}

TEST_CASE("canister: the coil's torque is what the particles' angular momentum about it loses") {
    RuledWorld world = freeWorld(softParameters(), 1e-5);
    for (ContactParameters& p : world.law.pairs) {
        p.kTo = 100;
        p.gammaTo = 1e-3;
        p.muTo = 0.05;
    }
    const Coil coil = coilOf(70e-3, 1);
    world.coil = coil;
    const geometry::CoilTouch wire = geometry::closestPoint(coil, 0, Vec3(1e-3, -9e-3, 30e-3));
    Particles one;
    one.add(wire.point + 1.01 * kRadius * wire.normal, kRadius, -0.3 * wire.normal + Vec3(0.05, 0, 0.05),
            Vec3(20, -30, 40));
    auto backend = makeReferenceBackend();
    backend->load(world, one);
    const auto aboutAxis = [&]() {
        const Particles p = backend->particles();
        const double m = massOf(kRadius);
        return m * glm::cross(p.position[0], p.velocity[0]).z + 0.4 * m * kRadius * kRadius * p.spin[0].z;
    };
    const double rate = -9.42, dt = world.timeStep;
    backend->advance(1, rate);
    const double before = aboutAxis();
    std::size_t touching = 0;
    double impulse = 0;
    for (int n = 0; n < 300; ++n) {
        impulse += backend->advance(1, rate).coilTorque * dt;
        touching += backend->contacts().size();
    }
    REQUIRE(touching > 20);
    REQUIRE(std::abs(impulse) > 0.01 * std::abs(before));
    // Exact in every step of the leapfrog: only rounding is left.
    CHECK(near(aboutAxis() - before, -impulse, std::abs(before), 1e-10));
}

TEST_CASE("canister: a coil wound so close that a sphere lies on a dozen turns is one surface for it") {
    RuledWorld world = freeWorld(softParameters(), 1e-5);
    const Coil coil{30e-3, 0.7e-3, 0.3e-3, 30e-3, 0, 0, 1};
    world.coil = coil;
    const double a = 10e-3;
    Particles one;
    one.add(Vec3(30e-3 + 0.3e-3 + a - 0.9e-3, 0, 15e-3), a);
    REQUIRE(geometry::touches(coil, 0, one.position[0], a).size() > 10);
    auto backend = makeReferenceBackend();
    backend->load(world, one);
    backend->advance(1, 0);
    CHECK(backend->contacts().size() == 1);
}

TEST_CASE("canister: two turns touched at once are two contacts, each with its own history while the coil turns") {
    // A spring that hardly stiffens never pulls delta_max back: it must be the largest overlap the turn has had since
    // it was met.
    RuledWorld world = freeWorld(spring(500), 1e-5);
    for (ContactParameters& p : world.law.pairs) p.gamma = 5e-3, p.k2Max *= 1 + 1e-9, p.plasticityDepth = 0.05;
    world.gravity = Vec3(0, -kGravity, 0);
    const Coil coil{10.4e-3, 4e-3, 1e-3, 30e-3, 0, 0, 1};
    world.coil = coil;
    const double a = 1.3e-3, rate = -20;
    Particles one;  // dropped from inside the coil into the groove between two turns, which carries it along
    one.add(Vec3(0, -9.1e-3, 17.1e-3), a);
    Stepper run(world, one);

    struct Turn {
        double wireAngle, deepest;
    };
    std::vector<Turn> turns;
    int both = 0, fallen = 0;
    for (int n = 0; n < 4000; ++n) {
        const double angle = run.backend().coilAngle();
        std::vector<Turn> now;
        for (const geometry::CoilTouch& touch : geometry::touches(coil, angle, run.now().position[0], a)) {
            Turn turn{touch.wireAngle, a - touch.distance};
            for (const Turn& was : turns)
                if (std::abs(was.wireAngle - turn.wireAngle) < 0.1) turn.deepest = std::max(turn.deepest, was.deepest);
            if (turn.deepest > a - touch.distance) ++fallen;
            now.push_back(turn);
        }
        turns = now;
        run.step(rate);
        std::vector<double> expected, found;
        for (const Turn& turn : turns) expected.push_back(turn.deepest);
        for (const Contact& contact : run.backend().contacts()) found.push_back(contact.maxOverlap);
        std::sort(expected.begin(), expected.end());
        std::sort(found.begin(), found.end());
        REQUIRE(found.size() == expected.size());
        // The backend looks in the frame of the coil, the test in the world's.
        for (std::size_t k = 0; k < found.size(); ++k) REQUIRE(nearRelative(found[k], expected[k], 1e-8));
        if (found.size() == 2 && found[0] != found[1]) ++both;
    }
    CHECK(both > 100);
    CHECK(fallen > 100);
}

TEST_CASE("canister: a heap settles on the coil, is dosed, and the ledger closes at every output") {
    const RuledWorld world = smallCanister();
    const Particles start = heap();
    auto backend = makeReferenceBackend();
    backend->load(world, start);
    const double mass = totalMass(start);
    const double rate = geometry::conveyingRate(*world.coil, 6 * kPi);
    double dosed = 0, settled = 0, deepest = 0;
    for (int output = 0; output < 30; ++output) {
        const bool settling = output < 10;
        const Sensors sensors = backend->advance(2000, settling ? 0 : rate);
        CHECK(sensors.count[0] + sensors.count[1] + sensors.count[2] + sensors.count[3] == start.size());
        CHECK(nearRelative(sensors.mass[0] + sensors.mass[1] + sensors.mass[2] + sensors.mass[3], mass, 1e-12));
        CHECK(sensors.count[3] == 0);
        CHECK(sensors.mass[2] >= dosed);  // dosed mass never comes back
        dosed = sensors.mass[2];
        deepest = std::max(deepest, sensors.maxOverlapRatio);
        // Settled: little is left of the fall of some 10 mm. (Grains still trickle out of the open throat.)
        if (output == 9) settled = dosed;
        if (output == 9) CHECK(sensors.kineticEnergy < 0.05 * mass * kGravity * 10e-3);
    }
    CHECK(dosed > settled + 0.05 * mass);
    CHECK(deepest < 0.1);
    const Particles end = backend->particles();
    for (std::size_t i = 0; i < end.size(); ++i) {
        if (end.status[i] != Status::Active) continue;
        const geometry::Closest trough = geometry::closestPoint(world.walls[0].shape, end.position[i]);
        CHECK(trough.distance > 0.9 * end.radius[i]);  // nobody has got through the wall
    }
}
