// Several materials on a device: against the reference, and to the last bit through restarts, ensembles, and changes
// that must not matter.
#include <algorithm>
#include <array>
#include <set>
#include <thread>

#include "host/law/hertz.h"
#include "host/law/jkr.h"
#include "host/sim/energy_ledger.h"
#include "tests/scene/mixed_beds.h"
#include "tests/support/catch.h"
#include "tests/support/records.h"

using namespace vkdose;
using namespace vkdose::test;

namespace {

/// The materials by new numbers; everything else as it was.
struct Renumbered {
    RuledWorld world;
    Particles particles;
};

Renumbered renumbered(const RuledWorld& w, const Particles& p, const std::array<int, kHere>& number) {
    Renumbered r{w, p};
    for (int a = 0; a < kHere; ++a) {
        r.world.materials[std::size_t(number[std::size_t(a)])] = w.materials[std::size_t(a)];
        for (int b = 0; b <= a; ++b)
            r.world.law.between(number[std::size_t(a)], number[std::size_t(b)]) = w.law.between(a, b);
    }
    for (Wall& wall : r.world.walls) wall.material = number[std::size_t(wall.material)];
    for (RigidBody& body : r.world.bodies) body.material = number[std::size_t(body.material)];
    for (std::uint8_t& m : r.particles.material) m = std::uint8_t(number[m]);
    return r;
}

/// All that a run tells, for comparison to the bit.
struct Told {
    Sensors sensors;
    Particles particles;
    std::vector<Contact> contacts;
};

Told run(Backend& backend, const RuledWorld& w, const Particles& p, std::uint32_t steps) {
    backend.load(w, p);
    const Sensors sensors = backend.advance(steps, kRate);
    return {sensors, backend.particles(), backend.contacts()};
}

void checkSame(const Told& a, const Told& b) {
    CHECK(a.sensors.mass == b.sensors.mass);
    CHECK(a.sensors.kineticEnergy == b.sensors.kineticEnergy);
    CHECK(a.sensors.coilTorque == b.sensors.coilTorque);
    REQUIRE(a.sensors.energy.has_value() == b.sensors.energy.has_value());
    if (a.sensors.energy) {
        CHECK(a.sensors.energy->kinetic == b.sensors.energy->kinetic);
        CHECK(a.sensors.energy->plastic == b.sensors.energy->plastic);
        CHECK(a.sensors.energy->elasticNormal == b.sensors.energy->elasticNormal);
    }
    CHECK(sameBits(a.particles, b.particles));
    CHECK(sameBits(a.contacts, b.contacts));
}

void elastic(RuledWorld& w, bool sticky) {
    ContactParameters rest;
    rest.mu = 0.5;
    if (sticky) rest.surfaceEnergy = 0.3;
    w.law.pairs.fill(sticky ? elasticAdhesive({2e6, 0.25}, {2e6, 0.25}, 0.7, rest)
                            : hertzMindlin({2e6, 0.25}, {2e6, 0.25}, 0.7, rest));
    vary(w.law);
}

/// Which pairs of materials touch.
std::set<std::size_t> pairsMet(const Backend& backend, const RuledWorld& w) {
    std::set<std::size_t> met;
    const Particles p = backend.particles();
    for (const Contact& c : backend.contacts()) {
        int other = 0;
        if (c.kind == ContactClass::ParticleParticle)
            other = p.material[c.other];
        else if (c.other < w.walls.size())
            other = w.walls[c.other].material;
        else
            other = allBodies(w)[c.other - w.walls.size()].material;
        met.insert(PairTable::index({p.material[c.particle], other}));
    }
    return met;
}

}  // namespace

TEST_CASE("materials: a mixed bed on the device is that of the reference", "[every-driver]") {
    const bool book = GENERATE(false, true);
    RuledWorld w = mixedWorld();
    w.energyBook = book;
    double share = 1;
    SECTION("Luding") {}
    SECTION("Hertz and Mindlin") {
        elastic(w, false);
    }
    SECTION("JKR") {
        elastic(w, true);
        share = 4;
    }
    w.timeStep = single(w.timeStep);
    const Particles p = packed(w);
    const auto reference = makeReferenceBackend(), device = gpu();
    reference->load(w, p);
    device->load(w, p);
    std::set<std::size_t> met;
    Sensors a, b;
    for (const std::uint32_t steps : {5U, 45U, 50U, 100U}) {
        a = reference->advance(steps, kRate);
        b = device->advance(steps, kRate);
        met.merge(pairsMet(*reference, w));
    }
    CAPTURE(met);
    CHECK(met.size() == 15);  // six of powders, each powder with trough, block and coil
    const Differences d = differences(*reference, *device, 1);
    CHECK(d.unmatched == 0);
    CHECK(d.position < share * 1e-5);
    CHECK(d.velocity < share * 1e-4);
    CHECK(d.spin < share * 1e-4);
    CHECK(d.force < share * 2e-3);
    for (int r = 0; r < kRegions; ++r) CHECK(near(b.mass[r], a.mass[r], a.mass[0], 1e-6));
    CHECK(nearRelative(a.kineticEnergy, b.kineticEnergy, share * 1e-5));
    if (w.energyBook) {
        CHECK(nearRelative(a.energy->kinetic, b.energy->kinetic, share * 1e-5));
        CHECK(nearRelative(a.energy->potential, b.energy->potential, share * 1e-5));
        CHECK(nearRelative(a.energy->elasticNormal, b.energy->elasticNormal, share * 2e-3));
    }
    requireClean(*device);
}

TEST_CASE("materials: restored and uninterrupted are the same bits") {
    RuledWorld w = mixedWorld();
    w.energyBook = GENERATE(false, true);
    const Particles p = mixedParticles(150);
    const auto whole = gpu(), second = gpu();
    whole->load(w, p);
    whole->advance(1501, kRate);
    const Record taken = whole->snapshot();
    second->load(w, p);
    second->restore(taken);
    checkSameArrays(taken, second->snapshot());
    const Sensors a = whole->advance(1501, kRate), b = second->advance(1501, kRate);
    CHECK(second->particles().material == p.material);
    checkSame({a, whole->particles(), whole->contacts()}, {b, second->particles(), second->contacts()});
}

TEST_CASE("materials: the numbers of materials do not matter to the bit") {
    const bool onDevice = GENERATE(false, true);
    RuledWorld w = mixedWorld();
    w.energyBook = GENERATE(false, true);
    const Particles p = mixedParticles(100);
    const std::array<int, kHere> number{4, 5, 2, 6, 0, 3, 1};  // the coil keeps its own
    const Renumbered other = renumbered(w, p, number);
    const auto one = onDevice ? gpu() : makeReferenceBackend(), two = onDevice ? gpu() : makeReferenceBackend();
    checkSame(run(*one, w, p, 1000), run(*two, other.world, other.particles, 1000));
}

TEST_CASE("materials: powders that are all alike are one powder to the bit") {
    const bool onDevice = GENERATE(false, true);
    RuledWorld w = canisterWorld();
    w.maxOverlapRatio = 1;
    w.energyBook = GENERATE(false, true);
    const Particles p = thrownIn(100);
    RuledWorld alike = w;
    alike.materials.push_back({"second", true, w.density()});
    alike.law.pairs.resize(4);
    for (int other = 0; other < 3; ++other) alike.law.between(kSecond, other) = w.law.between(0, other);
    alike.law.between(kSecond, kSecond) = w.law.between(0, 0);
    Particles marked = p;
    for (std::size_t i = 0; i < marked.size(); i += 3) marked.material[i] = kSecond;
    const auto one = onDevice ? gpu() : makeReferenceBackend(), two = onDevice ? gpu() : makeReferenceBackend();
    checkSame(run(*one, w, p, 2000), run(*two, alike, marked, 2000));
}

TEST_CASE("materials: canisters of one powder and of several share a device, each with its own bits") {
    const std::array<RuledWorld, 2> worlds{canisterWorld(), mixedWorld()};
    const std::array<Particles, 2> particles{thrownIn(130), mixedParticles(90)};
    auto backends = gpuEnsemble(2);
    std::array<Told, 2> together, alone;
    std::vector<std::thread> threads;
    for (std::size_t k = 0; k < 2; ++k)
        threads.emplace_back([&, k] {
            RuledWorld w = worlds[k];
            w.maxOverlapRatio = 1;
            together[k] = run(*backends[k], w, particles[k], 1500);
            backends[k].reset();
        });
    for (std::thread& t : threads) t.join();
    for (std::size_t k = 0; k < 2; ++k) {
        RuledWorld w = worlds[k];
        w.maxOverlapRatio = 1;
        const auto single = gpu();
        alone[k] = run(*single, w, particles[k], 1500);
        checkSame(alone[k], together[k]);
    }
}

TEST_CASE("materials: the ledger closes where a wall hands a contact to one of another material") {
    const bool onDevice = GENERATE(false, true);
    RuledWorld w = emptyWorld();
    const double wide = 0.0115, a = single(1.25e-3);
    w.walls = {geometry::Trough{wide, 0.06}, geometry::Front{0.06, wide, 0.01}};
    w.materials.push_back({"second", true, 2600});
    w.materials.push_back({"throat", false, 0});
    w.walls.back().material = 4;
    w.law.pairs.resize(5);
    for (const int powder : {0, kSecond}) {
        w.law.between(powder, 1) = w.law.between(0, 1);
        w.law.between(powder, 4) = w.law.between(0, 1);
        w.law.between(powder, 4).kt *= 0.4;
        w.law.between(powder, 4).kr *= 0.3;
    }
    w.energyBook = true;
    Particles p;
    for (const int powder : {0, kSecond})
        p.add({(powder == 0 ? 1 : -1) * 0.004, -2e-6 - std::sqrt((wide - a) * (wide - a) - 0.004 * 0.004), 0.05995}, a,
              {0, 0, 0.8}, Vec3(0), powder);
    const auto backend = onDevice ? gpu() : makeReferenceBackend();
    backend->load(w, p);
    EnergyLedger ledger;
    std::set<std::uint32_t> touched;
    for (int call = 0; call < 60; ++call) {
        ledger.add(*backend->advance(10, 0).energy);
        for (const Contact& c : backend->contacts()) touched.insert(c.other);
    }
    CHECK(touched == std::set<std::uint32_t>{0, 1});
    const double share = std::abs(ledger.residual()) / ledger.sum.loaded;
    CHECK(share < (onDevice ? 2e-6 : 1e-12));  // rounding of the motion in single precision
}

TEST_CASE("materials: what does not fit the world is refused") {
    const auto backend = GENERATE(false, true) ? gpu() : makeReferenceBackend();
    const RuledWorld w = mixedWorld();
    const Particles p = mixedParticles(20);
    const auto refused = [&](const RuledWorld& world, const Particles& particles, const char* why) {
        CHECK_THROWS_WITH(backend->load(world, particles), Catch::Contains(why));
    };
    RuledWorld few = w;
    few.law.pairs.resize(4);
    refused(few, p, "not of the world's materials");
    Particles odd = p;
    odd.material[3] = kWallMaterial;
    refused(w, odd, "particle 3 is of no powder");
    odd.material[3] = 9;
    refused(w, odd, "particle 3 is of no powder");
    RuledWorld far = w;
    far.bodies[0].material = 7;
    refused(far, p, "body \"block\" is of no material");
}
