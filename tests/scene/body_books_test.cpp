// Energy book and contact stress beside bodies: the device keeps them as the reference does.

#include <array>

#include "host/sim/energy_ledger.h"
#include "tests/scene/body_beds.h"
#include "tests/support/catch.h"

using namespace vkdose;
using namespace vkdose::test;

namespace {

using Term = double EnergyBook::*;
constexpr std::array kTerms{&EnergyBook::plastic,        &EnergyBook::adhesive,      &EnergyBook::viscous,
                            &EnergyBook::sliding,        &EnergyBook::rolling,       &EnergyBook::torsion,
                            &EnergyBook::bodyWork,       &EnergyBook::coilWork,      &EnergyBook::left,
                            &EnergyBook::kinetic,        &EnergyBook::potential,     &EnergyBook::rotational,
                            &EnergyBook::elasticNormal,  &EnergyBook::numerical,     &EnergyBook::elasticSliding,
                            &EnergyBook::elasticRolling, &EnergyBook::elasticTorsion};

RuledWorld bookedWorld() {
    RuledWorld w = deviceWorld();
    w.energyBook = true;
    return w;
}

/// The energies that the balance adds up.
double scaleOf(const EnergyLedger& ledger) {
    const EnergyBook& b = ledger.sum;
    return std::abs(b.loaded) + std::abs(b.bodyWork) + b.kinetic + std::abs(b.potential);
}

}  // namespace

TEST_CASE("body books: device and reference book contacts with moving bodies alike, term by term", "[every-driver]") {
    const RuledWorld w = bookedWorld();
    struct Throw {
        const char* at;
        Vec3 from, velocity;
    };
    const std::array throws{Throw{"drum's corner", {-17.3e-3, -5e-3, 1.3e-3}, {-0.5, -0.05, -0.3}},
                            Throw{"drum", {-12e-3, -13.9e-3, 5e-3}, {-0.2, -0.4, 0.02}},
                            Throw{"block that shakes", {6e-3, -8.2e-3, 5e-3}, {0.01, -0.4, 0.03}},
                            Throw{"stirrer of the drive", {-14e-3, 4.4e-3, 5.2e-3}, {0.05, -0.4, 0}}};
    for (const Throw& t : throws) {
        CAPTURE(t.at);
        Particles p;
        p.add(t.from, single(1.25e-3), t.velocity, Vec3(40, -30, 60));
        auto device = gpu();
        auto reference = makeReferenceBackend();
        device->load(w, p);
        reference->load(w, p);
        EnergyLedger a, b;
        double elastic = 0;
        for (const unsigned steps : {1U, 199U, 301U, 150U, 349U, 400U}) {
            a.add(*device->advance(steps, kDrive).energy);
            b.add(*reference->advance(steps, kDrive).energy);
            elastic = std::max(elastic, b.elastic());
            for (std::size_t k = 0; k < kTerms.size(); ++k) {
                CAPTURE(k);
                CHECK(near(a.sum.*kTerms[k], b.sum.*kTerms[k], scaleOf(b), 2e-4));
            }
            CHECK(near(a.residual(), 0, scaleOf(b), 1e-4));
        }
        CHECK(b.sum.plastic > 1e-3 * scaleOf(b));
        CHECK(std::abs(b.sum.bodyWork) > 1e-3 * scaleOf(b));
        requireClean(*device);
    }
}

TEST_CASE("body books: a heap in a turning drum closes on the device, and the book moves nothing") {
    RuledWorld w = bookedWorld();
    const Particles p = layers(60);
    VulkanOptions options;
    options.reads = GENERATE(VulkanOptions::Reads::Automatic, VulkanOptions::Reads::Storage);
    auto device = gpu(options), plain = gpu(options), second = gpu(byAddress(options));
    device->load(w, p);
    second->load(w, p);
    w.energyBook = false;
    plain->load(w, p);
    EnergyLedger ledger;
    double work = 0;
    for (int call = 0; call < 6; ++call) {
        const Sensors s = device->advance(499, kDrive);
        plain->advance(499, kDrive);
        ledger.add(*s.energy);
        for (const BodyLoad& load : s.bodies) work += load.work;
        CHECK(near(ledger.residual(), 0, scaleOf(ledger), 1e-4));
        // The loads count a force by the velocity of its step, the book by the mean over two: half a step apart.
        CHECK(near(ledger.sum.bodyWork, work, scaleOf(ledger), 2e-3));
        if (call == 2) second->restore(device->snapshot());
        if (call <= 2) continue;
        const Sensors t = second->advance(499, kDrive);
        for (const Term term : kTerms) CHECK(t.energy.value().*term == s.energy.value().*term);
    }
    CHECK(sameBits(device->particles(), plain->particles()));
    CHECK(sameBits(device->contacts(), second->contacts()));
    CHECK(std::abs(ledger.sum.bodyWork) > 0.01 * ledger.sum.loaded);
    requireClean(*device);
}

TEST_CASE("body books: what a sphere had in its contact with a body leaves with it") {
    RuledWorld w = emptyWorld();
    w.energyBook = true;
    w.gravity = Vec3(0);
    w.domain = {Vec3(-0.02), Vec3(0.02)};
    w.outletZ = 1e-3;
    w.bodies.push_back(bodyOf("plate", {geometry::Plane{Vec3(0), {0, 1, 0}}}, geometry::Slide{{0, 0.01, 0.3}}));
    const double radius = single(1.25e-3);
    Particles p;
    p.add({0, 0.98 * radius, w.outletZ - 1e-6}, radius, {0.1, 0, 0.3}, {40, 0, 0});
    for (const auto& [backend, allowed] : {std::pair{gpu(), 1e-6}, {makeReferenceBackend(), 1e-12}}) {
        backend->load(w, p);
        EnergyLedger ledger;
        double elastic = 0;
        for (int n = 0; n < 6; ++n) {
            const Sensors s = backend->advance(1, 0);
            ledger.add(*s.energy);
            elastic = std::max(elastic, ledger.elastic());
            CHECK(near(ledger.residual(), 0, ledger.sum.loaded, allowed));
            if (n == 5) CHECK(s.count[2] == 1);
        }
        CHECK(elastic > 0.05 * ledger.sum.loaded);
        CHECK(ledger.elastic() == 0);
        CHECK(ledger.sum.left > 0.4 * ledger.sum.loaded);
    }
}

TEST_CASE("body books: contact stress at bodies is the reference's") {
    RuledWorld w = deviceWorld();
    w.energyBook = GENERATE(false, true);
    w.maxOverlapRatio = 1;
    // Spheres pressed 2 um into drum, its corner, block and stirrer.
    const double a = single(1.25e-3), pressed = 2e-6, wall = 20e-3 - a + pressed, lift = 3e-3 + a - pressed;
    Particles p;
    p.add({0.8 * wall, 0.6 * wall, 5e-3}, a);
    p.add({0, wall, a - pressed}, a);
    p.add(w.bodies[1].pose(0, 0).toWorld({0.3e-3, lift, -0.5e-3}), a);
    p.add({-14e-3, lift, 5e-3}, a);
    auto device = gpu();
    auto reference = makeReferenceBackend();
    for (Backend* b : {device.get(), reference.get()}) {
        b->load(w, p);
        b->advance(5, kDrive);
    }
    REQUIRE(reference->contacts().size() == 5);
    FieldRequest r;
    r.grid = {Vec3(-0.021, -0.021, 0), Vec3(0.021, 0.021, 0.01), {13, 11, 3}};
    r.kernel = Kernel::Lucy;
    r.width = 4e-3;
    r.contactStress = true;
    // Single precision is good to 1e-10 m, of overlaps of 2e-6 m.
    CHECK(stressDifference(device->fields(r), reference->fields(r)) < 1e-3);
    requireClean(*device);
}
