// The energy book of the Vulkan backend: it closes, agrees with the reference's, and moves nothing.

#include <array>
#include <random>

#include "host/law/eepa.h"
#include "host/law/hertz.h"
#include "host/law/jkr.h"
#include "host/sim/energy_ledger.h"
#include "tests/scene/agreement.h"

using namespace vkdose;
using namespace vkdose::test;

namespace {

/// A short canister whose coil soon doses. Soft contacts, so that much happens in few steps.
RuledWorld dosingWorld() {
    RuledWorld w = emptyWorld();
    w.energyBook = true;
    w.maxOverlapRatio = 1;
    w.timeStep = 4e-6;
    for (ContactParameters& p : w.law.pairs) {
        p.k1 /= 10, p.k2Max /= 10, p.kc /= 10, p.kt /= 10, p.kr /= 10, p.kTo /= 10;
        p.gamma /= 3, p.gammaT /= 3, p.gammaR /= 3, p.gammaTo /= 3;
    }
    w.walls = {geometry::Trough{8e-3, 16e-3}, geometry::Plane{{0, 0, 0}, {0, 0, 1}},
               geometry::Front{16e-3, 8e-3, 3e-3}};
    w.coil = geometry::Coil{6.5e-3, 6e-3, 0.9e-3, 19e-3};
    w.domain = {Vec3(-0.02), Vec3(0.02, 0.1, 0.05)};
    w.throatZ = 16e-3;
    w.outletZ = 19e-3;
    return w;
}

/// Gives the contacts the law of Hertz and Mindlin, about as stiff, or Edinburgh's, or JKR's.
void follow(NormalLaw law, RuledWorld& w) {
    if (law == NormalLaw::Luding) return;
    ContactParameters rest;
    rest.plasticityRatio = 0.4;
    rest.surfaceEnergy = 3;
    rest.constantPull = 2e-5;
    rest.adhesionExponent = 2;
    const auto between = law == NormalLaw::Eepa  ? elastoPlasticAdhesive
                         : law == NormalLaw::Jkr ? elasticAdhesive
                                                 : hertzMindlin;
    if (law == NormalLaw::Jkr) rest.surfaceEnergy = 1;
    for (ContactParameters& p : w.law.pairs) {
        ContactParameters elastic = between({3e6, 0.25}, {3e6, 0.25}, 0.6, rest);
        elastic.mu = p.mu, elastic.muR = p.muR, elastic.muTo = p.muTo;
        elastic.kr = elastic.kTo = 0.3;
        elastic.gammaR = elastic.gammaTo = 0.3;
        p = elastic;
    }
}

Particles thrownAbout(std::size_t n) {
    Particles p;
    std::mt19937 random(3);
    std::uniform_real_distribution<double> unit(-1, 1);
    const auto add = [&](double x, double y, double z) {
        const double jitter = 1e-4 * unit(random);
        if (p.size() < n)
            p.add({x + jitter, y, z - jitter}, single(1.25e-3 + 1e-4 * unit(random)),
                  {0.1 * unit(random), -0.2, 0.2 + 0.1 * unit(random)}, 50.0 * Vec3(unit(random), 1, unit(random)));
    };
    for (int z = 0; z < 5; ++z)
        for (const double x : {-2.8e-3, 2.8e-3})
            for (const double y : {-2.8e-3, 2.8e-3}) add(x, y, 4.6e-3 + 2.9e-3 * z);
    for (int layer = 0; p.size() < n; ++layer)
        for (int z = 0; z < 5; ++z)
            for (int x = -2; x <= 2; ++x) add(2.9e-3 * x, 10e-3 + 2.9e-3 * layer, 1.6e-3 + 2.9e-3 * z);
    return p;
}

/// A kick of g dt = 4e-5 m/s on a velocity of 0.3 m/s is rounded by up to 1.5e-8 m/s, and in free fall always the same
/// way: up to 4e-4 of gravity's work, which is a tenth of all there is here.
constexpr double kRounding = 4e-5;

using Term = double EnergyBook::*;
constexpr std::array kFlows{&EnergyBook::plastic, &EnergyBook::adhesive, &EnergyBook::viscous,  &EnergyBook::sliding,
                            &EnergyBook::rolling, &EnergyBook::torsion,  &EnergyBook::coilWork, &EnergyBook::left};
constexpr std::array kStates{&EnergyBook::kinetic,       &EnergyBook::rotational,     &EnergyBook::potential,
                             &EnergyBook::elasticNormal, &EnergyBook::elasticSliding, &EnergyBook::elasticRolling,
                             &EnergyBook::elasticTorsion};

double scaleOf(const EnergyLedger& ledger) {
    return std::abs(ledger.sum.loaded) + std::abs(ledger.sum.coilWork);
}

/// A bed under the coil that doses: its book closes, and it loses energy in every way.
void bedClosesOnTheDevice(CoulombLimit limit) {
    RuledWorld w = dosingWorld();
    w.law.limitFriction(limit);
    auto device = gpu();
    device->load(w, thrownAbout(97));
    EnergyLedger ledger;
    std::uint64_t dosed = 0;
    for (int n = 0; n < 40; ++n) {
        const Sensors s = device->advance(499, n < 10 ? 0 : -60);
        ledger.add(*s.energy);
        dosed = s.count[2];
        CHECK(near(ledger.residual(), 0, scaleOf(ledger), kRounding));
        if (n == 20) {
            for (ContactParameters& p : w.law.pairs) p.kc *= 2;
            device->setLaw(w.law);
        }
    }
    CHECK(dosed > 3);
    for (const Term term : kFlows) CHECK(std::abs(ledger.sum.*term) > 1e-4 * scaleOf(ledger));
    INFO("residual " << ledger.residual() / scaleOf(ledger) << ", of the coil's work "
                     << ledger.residual() / ledger.sum.coilWork);
    CHECK(ledger.sum.coilWork > 0.1 * ledger.sum.loaded);
    requireClean(*device);
}

}  // namespace

TEST_CASE("energy: device and reference book the same, term by term, until packings part") {
    RuledWorld w = dosingWorld();
    w.coilSurfaceMoves = GENERATE(true, false);
    w.coilWireCurved = !w.coilSurfaceMoves;
    const NormalLaw law = GENERATE(NormalLaw::Luding, NormalLaw::HertzMindlin, NormalLaw::Eepa, NormalLaw::Jkr);
    follow(law, w);
    const Particles p = thrownAbout(45);
    auto device = gpu();
    auto reference = makeReferenceBackend();
    device->load(w, p);
    reference->load(w, p);
    EnergyLedger a, b;
    CHECK_FALSE(device->advance(0, 0).energy);
    // One step, so that the opening is looked at alone; then odd lengths, with the coil at two rates.
    for (const auto& [steps, rate] : {std::pair{1u, 0.0}, {399u, 0.0}, {301u, -60.0}, {298u, -30.0}}) {
        a.add(*device->advance(steps, rate).energy);
        b.add(*reference->advance(steps, rate).energy);
        // Forces are right to a part in 1e6; a wrong term is wrong by a part in one.
        for (const Term term : kFlows) CHECK(near(a.sum.*term, b.sum.*term, scaleOf(b), kRounding));
        for (const Term term : kStates) CHECK(near(a.sum.*term, b.sum.*term, scaleOf(b), kRounding));
        CHECK(near(a.sum.loaded, b.sum.loaded, scaleOf(b), 1e-6));
        CHECK(near(a.sum.numerical, b.sum.numerical, scaleOf(b), 1e-5));
        CHECK(near(a.residual(), 0, scaleOf(b), kRounding));
        const double momentum = glm::length(b.sum.momentum);
        CHECK(near(a.sum.momentum, b.sum.momentum, momentum, 1e-4));
        CHECK(near(a.sum.angularMomentum, b.sum.angularMomentum, momentum * 0.01, 1e-4));
    }
    // A coil that pushes and does not drag works less.
    const double least = w.coilSurfaceMoves ? 1e-3 : 3e-4;
    for (const Term term : {&EnergyBook::viscous, &EnergyBook::sliding, &EnergyBook::coilWork})
        CHECK(std::abs(b.sum.*term) > least * scaleOf(b));
    if (law == NormalLaw::HertzMindlin || law == NormalLaw::Jkr)
        CHECK(a.sum.plastic == 0);
    else
        CHECK(std::abs(b.sum.plastic) > least * scaleOf(b));
    if (law == NormalLaw::Eepa) CHECK(a.sum.adhesive == 0);
    if (law == NormalLaw::Jkr) CHECK(b.sum.adhesive > 1e-3 * scaleOf(b));
    requireClean(*device);
}

TEST_CASE("energy: device and reference book the first and the last step of an elasto-plastic contact alike",
          "[every-driver]") {
    RuledWorld w = emptyWorld();
    follow(NormalLaw::Eepa, w);
    w.energyBook = true;
    w.gravity = Vec3(0);
    w.timeStep = 3e-5;  // so long that much happens in each
    Particles p;
    p.add({0, 0, 0}, single(1.25e-3), {0.15, 0, 0});
    p.add({2.5005e-3, 0, 0}, single(1.25e-3), {-0.15, 0, 0});
    auto device = gpu();
    auto reference = makeReferenceBackend();
    device->load(w, p);
    reference->load(w, p);
    bool touched = false, parted = false;
    double scale = 0;
    for (int n = 0; n < 100 && !parted; ++n) {
        const EnergyBook a = *device->advance(1, 0).energy, b = *reference->advance(1, 0).energy;
        if (n == 0) scale = b.loaded;
        for (const Term term : {&EnergyBook::plastic, &EnergyBook::numerical, &EnergyBook::elasticNormal})
            CHECK(near(a.*term, b.*term, scale, 1e-5));
        const bool now = !reference->contacts().empty();
        if (now && !touched) CHECK(b.plastic > 1e-3 * scale);
        parted = touched && !now;
        touched = touched || now;
        if (parted) CHECK(a.plastic == 0);
    }
    CHECK(parted);
}

TEST_CASE("energy: a bed under the coil that doses closes on the device, and loses energy in every way") {
    bedClosesOnTheDevice(CoulombLimit::Luding);
}

TEST_CASE("energy: a bed under the coil that doses closes under the absolute Coulomb limit") {
    bedClosesOnTheDevice(CoulombLimit::Absolute);
}

TEST_CASE(
    "energy: an elastic settling and the plastic law behind it close, and forget alike, on device and reference") {
    RuledWorld w = dosingWorld();
    const ContactLaw plastic = w.law;
    for (ContactParameters& p : w.law.pairs) p.k2Max = p.k1;
    const Particles p = thrownAbout(45);
    auto device = gpu();
    auto reference = makeReferenceBackend();
    device->load(w, p);
    reference->load(w, p);
    EnergyLedger a, b;
    const auto both = [&](std::uint32_t steps, double rate) {
        a.add(*device->advance(steps, rate).energy);
        b.add(*reference->advance(steps, rate).energy);
        for (const Term term : kFlows) CHECK(near(a.sum.*term, b.sum.*term, scaleOf(b), kRounding));
        for (const Term term : kStates) CHECK(near(a.sum.*term, b.sum.*term, scaleOf(b), kRounding));
        CHECK(near(a.residual(), 0, scaleOf(b), kRounding));
        const Differences d = differences(*device, *reference, 0.3);
        CHECK(d.unmatched == 0);
        CHECK(d.maxOverlap < 1e-4);
    };
    both(1, 0);
    both(399, 0);
    CHECK(near(a.sum.plastic, 0, scaleOf(b), 1e-6));
    const double stored = b.sum.elasticNormal;
    CHECK(stored > 0);
    const Particles settled = reference->particles();
    device->setLaw(plastic);
    reference->setLaw(plastic);
    both(1, 0);
    CHECK(near(a.sum.plastic, b.sum.plastic, stored, 1e-3));
    CHECK(b.sum.plastic > 0.05 * stored);
    for (const Contact& c : device->contacts())
        if (c.kind == ContactClass::ParticleParticle) {
            const double apart = glm::distance(settled.position[c.particle], settled.position[c.other]);
            const double radii = settled.radius[c.particle] + settled.radius[c.other];
            CHECK(near(c.maxOverlap, radii - apart, 1.25e-3, 1e-3));
        }
    both(299, -60.0);
    requireClean(*device);
}

TEST_CASE("energy: the book stays closed when gravity changes") {
    const RuledWorld w = dosingWorld();
    auto device = gpu();
    auto reference = makeReferenceBackend();
    for (Backend* backend : {device.get(), reference.get()}) {
        backend->load(w, thrownAbout(45));
        EnergyLedger ledger;
        const auto closed = [&](std::uint32_t steps, double rate) {
            ledger.add(*backend->advance(steps, rate).energy);
            CHECK(near(ledger.residual(), 0, scaleOf(ledger), kRounding));
        };
        closed(400, 0);
        const Vec3 gentle = w.gravity, strong = 20.0 * w.gravity;
        const double jump = energyOfGravityChange(w, backend->particles(), gentle, strong);
        CHECK(std::abs(jump) > 100 * kRounding * scaleOf(ledger));
        ledger.sum.loaded += jump;
        backend->setGravity(strong);
        closed(1, 0);
        closed(399, -60.0);
    }
    CHECK(differences(*device, *reference, 0.3).unmatched == 0);
    requireClean(*device);
}

TEST_CASE("energy: keeping the book changes no bit of the motion") {
    RuledWorld w = dosingWorld();
    const Particles p = thrownAbout(97);
    VulkanOptions options;
    options.reads = GENERATE(VulkanOptions::Reads::Automatic, VulkanOptions::Reads::Storage);
    auto booked = gpu(options), plain = gpu(options);
    booked->load(w, p);
    w.energyBook = false;
    plain->load(w, p);
    for (const double rate : {0.0, -60.0}) {
        CHECK(booked->advance(4001, rate).energy);
        CHECK_FALSE(plain->advance(4001, rate).energy);
    }
    const Particles a = booked->particles(), b = plain->particles();
    CHECK(a.position == b.position);
    CHECK(a.velocity == b.velocity);
    CHECK(a.spin == b.spin);
    CHECK(booked->contacts().size() == plain->contacts().size());
    CHECK(booked->contacts().size() > 50);
}

TEST_CASE("energy: what a dosed particle had in its contacts leaves with it") {
    RuledWorld w = dosingWorld();
    w.walls.clear();
    w.coil.reset();
    w.gravity = Vec3(0);
    w.outletZ = 1e-3;
    // Two spheres pressed together; the upper one is past the outlet after two steps.
    const double radius = single(1.25e-3), speed = 0.3;
    Particles p;
    p.add({0, 0, w.outletZ - 3e-6 - 1.95 * radius}, radius, {0, 0, speed}, {40, 0, 0});
    p.add({0, 0, w.outletZ - 3e-6}, radius, {0.05, 0, speed}, {0, 30, 20});
    const bool swapped = GENERATE(false, true);  // either of the pair may be the one that stays
    if (swapped) {
        std::swap(p.position[0], p.position[1]);
        std::swap(p.velocity[0], p.velocity[1]);
        std::swap(p.spin[0], p.spin[1]);
    }
    for (const auto& [backend, allowed] : {std::pair{gpu(), 1e-6}, {makeReferenceBackend(), 1e-12}}) {
        backend->load(w, p);
        EnergyLedger ledger;
        double elastic = 0;
        for (int n = 0; n < 6; ++n) {
            const Sensors s = backend->advance(1, 0);
            ledger.add(*s.energy);
            elastic = std::max(elastic, ledger.elastic());
            CHECK(s.count[2] == (n < 2 ? 0 : 1));
            CHECK(near(ledger.residual(), 0, ledger.sum.loaded, allowed));
        }
        CHECK(elastic > 0.05 * ledger.sum.loaded);
        CHECK(ledger.elastic() == 0);
        CHECK(ledger.sum.left > 0.4 * ledger.sum.loaded);
    }
}
