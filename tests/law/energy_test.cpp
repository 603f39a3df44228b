// The energy book of the reference backend: single collisions and slides against closed forms, and the balance of
// everything at once.

#include <cmath>
#include <random>

#include "host/law/eepa.h"
#include "host/law/hertz.h"
#include "host/law/jkr.h"
#include "host/sim/energy_ledger.h"
#include "tests/law/setups.h"
#include "tests/support/catch.h"
#include "tests/support/near.h"

using namespace vkdose;
using namespace vkdose::test;

namespace {

/// Runs `steps` steps in calls of `stride` and joins their books. After every call the balance must close to rounding.
EnergyLedger played(Backend& backend, const RuledWorld& world, const Particles& particles, int steps, int stride,
                    double coilRate = 0) {
    RuledWorld booked = world;
    booked.energyBook = true;
    backend.load(booked, particles);
    EnergyLedger ledger;
    double worst = 0, scale = 0;
    for (int n = 0; n < steps; n += stride) {
        const Sensors sensors = backend.advance(static_cast<std::uint32_t>(stride), coilRate);
        REQUIRE(sensors.energy);
        ledger.add(*sensors.energy);
        worst = std::max(worst, std::abs(ledger.residual()));
        scale = std::max(scale, std::abs(ledger.sum.loaded) + std::abs(ledger.sum.coilWork));
    }
    // The balance is exact: what is left is rounding, 1e-16 of the energy for every contact and step.
    CHECK(near(worst, 0, scale, 1e-11));
    return ledger;
}

EnergyLedger played(const RuledWorld& world, const Particles& particles, int steps, int stride = 1) {
    auto backend = makeReferenceBackend();
    return played(*backend, world, particles, steps, stride);
}

/// Two mean spheres that meet head-on, each at `speed`.
Particles headOn(double speed) {
    Particles two;
    two.add(Vec3(0), kRadius, Vec3(speed, 0, 0));
    two.add(Vec3(2.001 * kRadius, 0, 0), kRadius, Vec3(-speed, 0, 0));
    return two;
}

double motionOf(const EnergyLedger& ledger) {
    return ledger.sum.kinetic + ledger.sum.rotational;
}

ContactParameters undamped(double kcRatio) {
    ContactParameters p = paperParameters(kcRatio);
    p.gamma = p.gammaT = p.gammaR = 0;
    return p;
}

}  // namespace

TEST_CASE("energy: a head-on collision without damping loses what Luding's law says, to plasticity and adhesion") {
    const double m12 = massOf(kRadius) / 2;
    for (const double kcRatio : {0.0, 0.1, 0.3})
        for (const double speed : {0.05, 0.2}) {
            const double dt = 2e-7, incoming = massOf(kRadius) * speed * speed;
            const ContactParameters p = undamped(kcRatio);
            const EnergyLedger ledger = played(freeWorld(p, dt), headOn(speed), 3000);
            // delta_max = v_rel sqrt(m12 / k1); e^2 = 1/kappa - chi (kappa - 1)^2 / (kappa (kappa + chi)).
            const double deepest = 2 * speed * std::sqrt(m12 / p.k1);
            const double limit = p.k2Max / (p.k2Max - p.k1) * p.plasticityDepth * kRadius;
            REQUIRE(deepest < limit);
            const double kappa = (p.k1 + (p.k2Max - p.k1) * deepest / limit) / p.k1, chi = p.kc / p.k1;
            const double restitution2 = 1 / kappa - chi * (kappa - 1) * (kappa - 1) / (kappa * (kappa + chi));
            CAPTURE(kcRatio, speed, restitution2, ledger.sum.numerical / incoming);
            REQUIRE(restitution2 > 0);
            REQUIRE(ledger.elastic() == 0);
            CHECK(near(ledger.sum.plastic + ledger.sum.adhesive, incoming * (1 - restitution2), incoming, 1e-3));
            CHECK(near(motionOf(ledger), incoming * restitution2, incoming, 1e-3));
            CHECK(ledger.sum.plastic > 0.1 * incoming);
            CHECK((ledger.sum.adhesive > 0) == (kcRatio > 0));
            CHECK(ledger.sum.viscous == 0);
        }
}

TEST_CASE("energy: a damped linear collision loses its energy to viscosity alone") {
    ContactParameters p = spring(4000);
    p.gamma = 0.0827;
    const double dt = 2e-7, speed = 0.1, m12 = massOf(kRadius) / 2, incoming = massOf(kRadius) * speed * speed;
    const EnergyLedger ledger = played(freeWorld(p, dt), headOn(speed), 3000);
    // Half a period of the damped oscillator; the contact law lets it pull at the end, until the overlap is zero.
    const double eta = p.gamma / (2 * m12), restitution = std::exp(-eta * kPi / std::sqrt(p.k1 / m12 - eta * eta));
    CHECK(near(ledger.sum.viscous, incoming * (1 - restitution * restitution), incoming, 1e-3));
    // Linear springs have no hysteresis at all.
    CHECK(near(ledger.sum.plastic, 0, incoming, 1e-9));
    CHECK(ledger.sum.adhesive == 0);
    CHECK(near(ledger.sum.numerical, 0, incoming, 1e-3));
}

TEST_CASE("energy: a sphere that slips until it rolls loses two sevenths of its energy to friction") {
    ContactParameters p = spring(4000);
    p.kt = 1000;
    p.gammaT = 0.01;
    p.mu = 0.3;
    RuledWorld world = planeWorld(p, 2e-6);
    world.gravity = Vec3(0, -kGravity, 0);
    const double weight = massOf(kRadius) * kGravity, speed = 0.05;
    Particles one;
    one.add(Vec3(0, kRadius - weight / p.k1, 0), kRadius, Vec3(speed, 0, 0));
    const EnergyLedger ledger = played(world, one, 20000, 100);
    const double incoming = massOf(kRadius) * speed * speed / 2;
    // Slipping ends after 2 v / (7 mu g) = 4.9 ms of 40 ms; the spring's last swing is damped within a per mille.
    CHECK(near(ledger.sum.sliding + ledger.sum.viscous, incoming * 2 / 7, incoming, 1e-4));
    CHECK(near(ledger.sum.sliding, incoming * 2 / 7, incoming, 2e-3));
    CHECK(near(ledger.sum.rotational, incoming * 2 / 7 * 5 / 7, incoming, 1e-3));
}

TEST_CASE("energy: a sphere that spins on a plane loses its spin to torsion, one that rolls to rolling") {
    ContactParameters p = spring(4000);
    p.kTo = p.kr = 500;
    p.gammaTo = p.gammaR = 0.005;
    RuledWorld world = planeWorld(p, 2e-6);
    world.gravity = Vec3(0, -kGravity, 0);
    const double weight = massOf(kRadius) * kGravity, inertia = 0.4 * massOf(kRadius) * kRadius * kRadius;
    const double rate = 40, incoming = inertia * rate * rate / 2;
    // Slipping takes all but what the spring holds at its limit in the end; of that it takes what the spring slips
    // while it swings to rest, and the dashpot the remainder.
    const double friction = 0.1, held = friction * weight * friction * weight / (2 * p.kTo);
    REQUIRE(held < 1e-4 * incoming);
    Particles one;
    const Vec3 place(0, kRadius - weight / p.k1, 0);
    SECTION("torsion") {
        for (ContactParameters& c : world.law.pairs) c.muTo = friction;
        one.add(place, kRadius, Vec3(0), Vec3(0, rate, 0));
        const EnergyLedger ledger = played(world, one, 40000, 100);
        CHECK(near(ledger.sum.torsion, incoming - held / 2, held / 2, 1));
        CHECK(near(ledger.sum.torsion + ledger.sum.viscous + ledger.elastic() + motionOf(ledger),
                   incoming + weight * weight / p.k1 / 2, incoming, 1e-6));
        CHECK(ledger.sum.rolling == 0);
    }
    SECTION("rolling resistance, without friction to turn it into motion") {
        for (ContactParameters& c : world.law.pairs) c.muR = friction;
        one.add(place, kRadius, Vec3(0), Vec3(rate, 0, 0));
        const EnergyLedger ledger = played(world, one, 40000, 100);
        CHECK(near(ledger.sum.rolling, incoming - held / 2, held / 2, 1));
        CHECK(ledger.sum.torsion == 0);
        CHECK(ledger.sum.sliding == 0);
    }
}

TEST_CASE("energy: the time step's own loss falls with its square") {
    double before = 0;
    for (const double dt : {8e-7, 4e-7, 2e-7, 1e-7}) {
        // Many pairs at distances that fill the way of one step evenly, so that the time within a step at which
        // contacts begin averages out.
        Particles many;
        for (int n = 0; n < 400; ++n) {
            const Vec3 place(0.02 * (n % 20) - 0.2, 0.02 * (n / 20) - 0.2, 0);
            many.add(place, kRadius, Vec3(0, 0, 0.2));
            many.add(place + Vec3(0, 0, 2.002 * kRadius + 0.4 * 8e-7 * (n + 0.5) / 400), kRadius, Vec3(0, 0, -0.2));
        }
        const EnergyLedger ledger = played(freeWorld(undamped(0.3), dt), many, static_cast<int>(3e-4 / dt), 100);
        const double incoming = 800 * massOf(kRadius) * 0.02, share = ledger.sum.numerical / incoming;
        CAPTURE(dt, share);
        CHECK(share > 0);
        // By the law of the mean, (pi dt / t_c)^2 / 12 of what meets, less what parting gives back.
        if (before > 0) CHECK(near(before / share, 4, 4, 0.1));
        before = share;
    }
}

namespace {

/// Spheres thrown into a corner of a small canister with a coil, and an outlet they soon find.
RuledWorld smallCanister(double timeStep) {
    ContactParameters p = paperParameters(0.3);
    p.kTo = 4000;
    p.gammaTo = 0.01;
    p.muTo = 0.3;
    RuledWorld world = freeWorld(p, timeStep);
    world.gravity = Vec3(0, -kGravity, 0);
    world.maxOverlapRatio = 1;
    world.walls = {geometry::Trough{8e-3, 16e-3}, geometry::Plane{Vec3(0), Vec3(0, 0, 1)},
                   geometry::Front{16e-3, 8e-3, 3e-3}};
    world.coil = geometry::Coil{6.5e-3, 6e-3, 0.9e-3, 19e-3};
    world.domain = {Vec3(-0.02), Vec3(0.02, 0.1, 0.05)};
    world.throatZ = 16e-3;
    world.outletZ = 19e-3;
    return world;
}

Particles throwIn(int layers) {
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> unit(-1, 1);
    Particles p;
    for (int y = 0; y < layers; ++y)
        for (int x = -2; x <= 2; ++x)
            for (int z = 0; z < 5; ++z) {
                const double jitter = 1e-4 * unit(random), radius = kRadius * (0.9 + 0.15 * unit(random));
                const Vec3 spin(50 * unit(random), 50 * unit(random), 50 * unit(random));
                p.add(Vec3(2.8e-3 * x + jitter, -1e-3 + 2.8e-3 * y, 1.6e-3 + 2.8e-3 * z), radius,
                      Vec3(0.1 * unit(random), -0.3, 0.1 * unit(random) + 0.2), spin);
            }
    // Inside the coil and above it, not in it.
    Particles clear;
    for (std::size_t i = 0; i < p.size(); ++i)
        if (p.position[i].y > 9e-3 || std::hypot(p.position[i].x, p.position[i].y) < 3.5e-3)
            clear.add(p.position[i], p.radius[i], p.velocity[i], p.spin[i]);
    return clear;
}

}  // namespace

TEST_CASE("energy: a bed under a turning coil that doses closes to rounding, and loses energy in every way") {
    for (const CoulombLimit limit : {CoulombLimit::Luding, CoulombLimit::Absolute}) {
        RuledWorld world = smallCanister(2e-6);
        world.law.limitFriction(limit);
        auto backend = makeReferenceBackend();
        const EnergyLedger ledger = played(*backend, world, throwIn(7), 70000, 100, -60);
        CHECK(backend->advance(0, 0).count[static_cast<std::size_t>(Region::Dosed)] > 0);
        const EnergyBook& b = ledger.sum;
        for (const double loss : {b.plastic, b.adhesive, b.viscous, b.sliding, b.rolling, b.torsion})
            CHECK(loss > 1e-4 * ledger.losses());
        CHECK(b.coilWork > 0.1 * b.loaded);
        CHECK(b.left != 0);  // of either sign: the outlet reaches below the origin
        // The energy of motion along a normal ends up, by and large, in the three losses of that direction; the time
        // step mistakes (pi dt/t_c)^2/12 of it, at most that of the two smallest spheres on k1.
        const double smallest = 0.75 * kRadius, met = b.plastic + b.adhesive + b.viscous;
        const double share = world.timeStep * world.timeStep * kK1 / (massOf(smallest) / 2) / 12;
        REQUIRE(share < 1e-3);
        CHECK(near(b.numerical, 0, met, share));
    }
}

TEST_CASE("energy: the balance survives the switch of adhesion, up and down") {
    RuledWorld world = smallCanister(2e-6);
    world.energyBook = true;
    auto backend = makeReferenceBackend();
    backend->load(world, throwIn(7));
    EnergyLedger ledger;
    for (const double kcRatio : {0.3, 0.873, 0.1, 0.3}) {
        for (ContactParameters& p : world.law.pairs) p.kc = kcRatio * p.k2Max;
        backend->setLaw(world.law);
        for (int n = 0; n < 20; ++n) ledger.add(*backend->advance(150, n % 2 == 0 ? 0 : -12).energy);
        CHECK(near(ledger.residual(), 0, ledger.sum.loaded, 1e-11));
    }
    CHECK(backend->contacts().size() > 20);
}

TEST_CASE("energy: the balance survives the end of an elastic settling, which the plastic loss pays for") {
    RuledWorld world = smallCanister(2e-6);
    world.energyBook = true;
    const ContactLaw plastic = world.law;
    for (ContactParameters& p : world.law.pairs) p.k2Max = p.k1;
    auto backend = makeReferenceBackend();
    backend->load(world, throwIn(7));
    EnergyLedger ledger;
    ledger.add(*backend->advance(3000, 0).energy);
    CHECK(near(ledger.residual(), 0, ledger.sum.loaded, 1e-11));
    CHECK(near(ledger.sum.plastic, 0, ledger.sum.loaded, 1e-6));  // the normals turn within a step
    CHECK(ledger.sum.adhesive == 0);
    const double stored = ledger.sum.elasticNormal;
    REQUIRE(stored > 1e-6 * ledger.sum.loaded);
    backend->setLaw(plastic);
    const EnergyBook first = *backend->advance(1, 0).energy;
    ledger.add(first);
    CHECK(near(ledger.residual(), 0, ledger.sum.loaded, 1e-11));
    CHECK(first.plastic > 0);
    CHECK(first.plastic < stored);
    ledger.add(*backend->advance(3000, -12).energy);
    CHECK(near(ledger.residual(), 0, ledger.sum.loaded, 1e-11));
}

TEST_CASE("energy: keeping the book changes no bit of the motion") {
    RuledWorld world = smallCanister(2e-6);
    auto plain = makeReferenceBackend(), booked = makeReferenceBackend();
    plain->load(world, throwIn(7));
    world.energyBook = true;
    booked->load(world, throwIn(7));
    CHECK_FALSE(plain->advance(3000, -12).energy);
    CHECK_FALSE(booked->advance(0, -12).energy);  // before the first step there is nothing to book
    CHECK(booked->advance(3000, -12).energy);
    CHECK(plain->particles().position == booked->particles().position);
    CHECK(plain->particles().spin == booked->particles().spin);
}

TEST_CASE("energy: a state that is loaded again books the next steps as if nothing had happened") {
    const ContactParameters friction = paperParameters(0.5);
    const Elasticity elastic{2e6, 0.25};
    ContactParameters sticky = friction, flattened = friction;
    sticky.surfaceEnergy = flattened.surfaceEnergy = 0.05;
    flattened.plasticityRatio = 0.5;
    flattened.adhesionExponent = 1.5;
    for (const ContactParameters& p :
         {friction, hertzMindlin(elastic, elastic, 0.7, friction),
          elastoPlasticAdhesive(elastic, elastic, 0.7, flattened), elasticAdhesive(elastic, elastic, 0.7, sticky)}) {
        CAPTURE(int(p.law));
        RuledWorld world = freeWorld(p, 2e-7);
        world.energyBook = true;
        Particles two;
        two.add(Vec3(0), kRadius, Vec3(0.1, 0, 0), Vec3(10, 20, 30));
        two.add(Vec3(1.95 * kRadius, 0.5e-3, 0), kRadius, Vec3(-0.1, 0.05, 0));
        auto whole = makeReferenceBackend(), resumed = makeReferenceBackend();
        whole->load(world, two);
        resumed->load(world, two);
        whole->advance(100, 0);
        REQUIRE(whole->contacts().size() == 1);
        resumed->restore(whole->snapshot());
        for (const std::uint32_t steps : {1U, 1U, 5000U}) {  // in the last the two part
            const EnergyBook a = *whole->advance(steps, 0).energy, b = *resumed->advance(steps, 0).energy;
            const auto losses = [](const EnergyBook& e) {
                return std::vector<double>{e.plastic, e.adhesive, e.viscous,  e.sliding,
                                           e.rolling, e.torsion,  e.numerical};
            };
            CHECK(losses(a) == losses(b));
        }
    }
}

TEST_CASE("energy: the book's momenta are the particles'") {
    RuledWorld world = smallCanister(2e-6);
    world.energyBook = true;
    auto backend = makeReferenceBackend();
    backend->load(world, throwIn(7));
    const EnergyBook book = *backend->advance(2000, -12).energy;
    const Particles p = backend->particles();
    Vec3 momentum(0), angular(0);
    double scale = 0;
    for (std::size_t i = 0; i < p.size(); ++i) {
        const double m = massOf(p.radius[i]);
        momentum += m * p.velocity[i];
        angular += m * glm::cross(p.position[i], p.velocity[i]) + 0.4 * m * p.radius[i] * p.radius[i] * p.spin[i];
        scale += m * glm::length(p.velocity[i]);
    }
    CHECK(near(book.momentum, momentum, scale, 1e-12));
    CHECK(near(book.angularMomentum, angular, scale * 1e-2, 1e-12));
}
