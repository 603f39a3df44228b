// Particles that are added while others move, in both backends.

#include <array>
#include <thread>

#include "tests/scene/beds.h"
#include "tests/support/catch.h"
#include "tests/support/records.h"

using namespace vkdose;
using namespace vkdose::test;

namespace {

constexpr std::size_t kFirst = 150, kLate = 40;

/// Particles that fly about, and as many as kLate behind them that wait, on a grid that is free for them.
Particles someWait() {
    Particles p = thrownIn(kFirst);
    for (std::size_t i = 0; i < kLate; ++i) {
        p.add(Vec3(0), single(1e-3));
        p.status.back() = Status::Waiting;
    }
    return p;
}

std::vector<Vec3> places() {
    std::vector<Vec3> all;
    for (std::size_t i = 0; i < kLate; ++i) {
        const auto n = static_cast<double>(i % 10), layer = static_cast<double>(i / 10);
        all.emplace_back(-6e-3 + 2.5e-3 * layer, 0.0235 + 1e-7 * n, 5e-3 + 4e-3 * n);
    }
    return all;
}

RuledWorld world() {
    RuledWorld w = canisterWorld();
    w.maxOverlapRatio = 1;
    return w;
}

constexpr std::uint32_t kBefore = 2003;
constexpr double kRate = -9;

}  // namespace

TEST_CASE("refill: those that wait move nothing and are counted nowhere, those that come fall freely",
          "[every-driver]") {
    const bool reference = GENERATE(true, false);
    CAPTURE(reference);
    const RuledWorld w = world();
    const auto backend = made(reference), alone = made(reference);
    backend->load(w, someWait());
    alone->load(w, thrownIn(kFirst));
    const Sensors before = backend->advance(kBefore, kRate), without = alone->advance(kBefore, kRate);
    CHECK(before.count == without.count);
    CHECK(before.mass == without.mass);
    CHECK(before.kineticEnergy == without.kineticEnergy);
    CHECK(backend->contacts().size() > 40);

    backend->addParticles(kFirst, places());
    constexpr std::uint32_t kSteps = 301;
    const Sensors after = backend->advance(kSteps, kRate), still = alone->advance(kSteps, kRate);
    CHECK(after.count[0] + after.count[1] == kFirst + kLate);
    const Particles now = backend->particles(), others = alone->particles();
    for (std::size_t i = 0; i < kFirst; ++i) {
        CHECK(now.position[i] == others.position[i]);
        CHECK(now.velocity[i] == others.velocity[i]);
        CHECK(now.spin[i] == others.spin[i]);
    }
    const double t = kSteps * w.timeStep;
    for (std::size_t i = 0; i < kLate; ++i) {
        const Vec3 fall = now.position[kFirst + i] - places()[i];
        CHECK(fall.x == Approx(0).margin(1e-9));
        CHECK(fall.y == Approx(-9.81 * t * t / 2).epsilon(1e-4));
        // The velocity is that of half a step before.
        CHECK(now.velocity[kFirst + i].y == Approx(-9.81 * (t - w.timeStep / 2)).epsilon(1e-4));
    }
    const double mass = sphereMass(w.density(), 1e-3), speed = 9.81 * (t - w.timeStep / 2);
    CHECK(after.kineticEnergy - still.kineticEnergy == Approx(kLate * mass * speed * speed / 2).epsilon(1e-3));
    if (!reference) requireClean(*backend);
}

TEST_CASE("refill: before the first step it is the same as to load them") {
    const bool reference = GENERATE(true, false);
    RuledWorld w = world();
    w.energyBook = true;
    Particles all = thrownIn(kFirst);
    for (const Vec3& x : places()) all.add(x, single(1e-3));
    const auto added = made(reference), loaded = made(reference);
    added->load(w, someWait());
    added->addParticles(kFirst, places());
    loaded->load(w, all);
    const Sensors a = added->advance(1501, kRate), b = loaded->advance(1501, kRate);
    CHECK(sameBits(added->particles(), loaded->particles()));
    CHECK(sameBits(added->contacts(), loaded->contacts()));
    CHECK(a.energy->loaded == b.energy->loaded);
}

TEST_CASE("refill: a restart before or after it goes on with the same bits") {
    const bool reference = GENERATE(true, false);
    RuledWorld w = world();
    w.energyBook = true;
    const auto whole = made(reference), early = made(reference), late = made(reference);
    whole->load(w, someWait());
    whole->advance(kBefore, kRate);
    const Record before = whole->snapshot();
    whole->addParticles(kFirst, places());
    const Record after = whole->snapshot();
    early->load(w, someWait());
    early->restore(before);
    early->addParticles(kFirst, places());
    late->load(w, someWait());
    late->restore(after);
    for (int call = 0; call < 6; ++call) {
        const Sensors a = whole->advance(1501, kRate), b = early->advance(1501, kRate), c = late->advance(1501, kRate);
        CHECK(a.rebuilds == b.rebuilds);
        CHECK(a.rebuilds == c.rebuilds);
        CHECK(a.kineticEnergy == b.kineticEnergy);
        CHECK(a.kineticEnergy == c.kineticEnergy);
    }
    CHECK(sameBits(whole->particles(), early->particles()));
    CHECK(sameBits(whole->particles(), late->particles()));
    checkSameArrays(whole->snapshot(), early->snapshot());
    checkSameArrays(whole->snapshot(), late->snapshot());
    // They have landed on the others.
    std::size_t touching = 0;
    for (const Contact& c : whole->contacts())
        if (c.kind == ContactClass::ParticleParticle && c.particle < kFirst && c.other >= kFirst) ++touching;
    CHECK(touching > 0);
}

TEST_CASE("refill: one member of an ensemble is refilled, the other is not") {
    const RuledWorld w = world();
    const auto alone = gpu();
    alone->load(w, someWait());
    alone->advance(kBefore, kRate);
    alone->addParticles(kFirst, places());
    alone->advance(2003, kRate);
    auto members = makeVulkanEnsemble(VulkanOptions{}, 2);
    std::array<Particles, 2> ends;
    std::vector<std::thread> threads;
    for (std::size_t m = 0; m < 2; ++m)
        threads.emplace_back([&, m] {
            members[m]->load(w, someWait());
            members[m]->advance(kBefore, kRate);
            if (m == 1) members[m]->addParticles(kFirst, places());
            members[m]->advance(2003, kRate);
            ends[m] = members[m]->particles();
            members[m].reset();
        });
    for (std::thread& t : threads) t.join();
    CHECK(sameBits(ends[1], alone->particles()));
    CHECK(ends[0].status[kFirst] == Status::Waiting);
}
