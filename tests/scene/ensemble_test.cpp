// Canisters that share a device's tables: each computes what it would alone, to the last bit, whatever the others do.
#include <algorithm>
#include <atomic>
#include <thread>

#include "host/law/eepa.h"
#include "host/law/hertz.h"
#include "host/law/jkr.h"
#include "tests/scene/beds.h"
#include "tests/support/records.h"

#include "tests/support/catch.h"

using namespace vkdose;
using namespace vkdose::test;

namespace {

/// A canister and what is done with it: calls of their own lengths, another law half way.
struct Script {
    std::size_t particles;
    double rate;      // of the coil [rad/s]
    double timeStep;  // [s]
    double friction;  // after the second call
    bool energyBook = false;
    NormalLaw law = NormalLaw::Luding;
    std::vector<std::uint32_t> calls{1501, 997, 700};
    Vec3 throwFirst{0};  // extra velocity of particle 0 [m/s]
};

struct Outcome {
    std::vector<Sensors> sensors;
    Particles particles;
    std::vector<Contact> contacts;
    double angle = 0;
    std::string error;
    Record restored;  ///< taken as soon as it was restored
};

Outcome play(Backend& backend, const Script& s, const Record* from = nullptr, Record* to = nullptr) {
    RuledWorld w = canisterWorld();
    w.maxOverlapRatio = 1;
    w.timeStep = s.timeStep;
    w.energyBook = s.energyBook;
    if (s.law == NormalLaw::HertzMindlin) w.law.pairs.fill(hertzMindlin({2e6, 0.25}, {2e6, 0.25}, 0.7));
    if (s.law == NormalLaw::Eepa) {
        ContactParameters sticky;
        sticky.plasticityRatio = 0.5;
        sticky.surfaceEnergy = 2;
        w.law.pairs.fill(elastoPlasticAdhesive({2e6, 0.25}, {2e6, 0.25}, 0.7, sticky));
    }
    if (s.law == NormalLaw::Jkr) {
        ContactParameters sticky;
        sticky.surfaceEnergy = 0.5;
        w.law.pairs.fill(elasticAdhesive({2e6, 0.25}, {2e6, 0.25}, 0.7, sticky));
    }
    Particles p = thrownIn(s.particles);
    p.velocity[0] += s.throwFirst;
    Outcome o;
    try {
        backend.load(w, p);
        if (from != nullptr) {
            backend.restore(*from);
            o.restored = backend.snapshot();
        }
        for (std::size_t call = 0; call < s.calls.size(); ++call) {
            if (call == 2) {
                for (ContactParameters& c : w.law.pairs) c.mu = s.friction;
                backend.setLaw(w.law);
            }
            o.sensors.push_back(backend.advance(s.calls[call], s.rate));
        }
        if (to != nullptr) *to = backend.snapshot();
        o.particles = backend.particles();
        o.contacts = backend.contacts();
        o.angle = backend.coilAngle();
    } catch (const RunError& e) {
        o.error = e.what();
    }
    return o;
}

std::vector<Outcome> playTogether(const std::vector<Script>& scripts, const std::vector<const Record*>& from = {}) {
    std::vector<std::unique_ptr<Backend>> backends = gpuEnsemble(scripts.size());
    std::vector<Outcome> outcomes(scripts.size());
    std::vector<ValidationReport> reports(scripts.size());
    std::vector<std::thread> threads;
    for (std::size_t k = 0; k < scripts.size(); ++k)
        threads.emplace_back([&, k] {
            outcomes[k] = play(*backends[k], scripts[k], from.empty() ? nullptr : from[k]);
            reports[k] = validationReport(*backends[k]);
            backends[k].reset();  // nobody waits for it any more
        });
    for (std::thread& t : threads) t.join();
    for (const ValidationReport& report : reports) requireClean(report);
    return outcomes;
}

void checkSame(const Outcome& alone, const Outcome& together) {
    CHECK(alone.error == together.error);
    REQUIRE(alone.sensors.size() == together.sensors.size());
    for (std::size_t k = 0; k < alone.sensors.size(); ++k) {
        const Sensors &a = alone.sensors[k], &b = together.sensors[k];
        CHECK(a.count == b.count);
        CHECK(a.mass == b.mass);
        CHECK(a.kineticEnergy == b.kineticEnergy);
        CHECK(a.coilTorque == b.coilTorque);
        CHECK(a.maxOverlapRatio == b.maxOverlapRatio);
        REQUIRE(a.energy.has_value() == b.energy.has_value());
        if (a.energy) {
            CHECK(a.energy->coilWork == b.energy->coilWork);
            CHECK(a.energy->plastic == b.energy->plastic);
            CHECK(a.energy->elasticNormal == b.energy->elasticNormal);
        }
    }
    if (!alone.error.empty()) return;
    CHECK(sameBits(alone.particles, together.particles));
    CHECK(sameBits(alone.contacts, together.contacts));
    CHECK(alone.angle == together.angle);
}

std::ptrdiff_t coilContacts(const Outcome& o) {
    return std::count_if(o.contacts.begin(), o.contacts.end(),
                         [](const Contact& c) { return c.kind == ContactClass::ParticleCoil; });
}

Outcome playAlone(const Script& s, const Record* from = nullptr, Record* to = nullptr) {
    const auto backend = gpu();
    return play(*backend, s, from, to);
}

void requireSameAloneAndTogether(bool energyBook) {
    std::vector<Script> scripts{{203, -9.5, 2.26e-6, 0.3}, {61, 7.0, 3e-6, 0.5}, {140, 0.0, 2.26e-6, 0.1}};
    scripts[1].calls = {300, 2500, 61};
    scripts[2].calls = {64};  // over long before the others
    for (Script& s : scripts) s.energyBook = energyBook;
    const std::vector<Outcome> together = playTogether(scripts);
    for (std::size_t k = 0; k < scripts.size(); ++k) {
        INFO("canister " << k);
        const Outcome alone = playAlone(scripts[k]);
        REQUIRE(alone.error.empty());
        if (k < 2) REQUIRE(alone.contacts.size() > 10);
        if (k < 2) REQUIRE(coilContacts(alone) > 0);
        checkSame(alone, together[k]);
    }
}

}  // namespace

TEST_CASE("a canister computes the same bits alone and in an ensemble", "[every-driver]") {
    requireSameAloneAndTogether(false);
}

TEST_CASE("a canister that keeps its energy book computes the same bits alone and in an ensemble") {
    requireSameAloneAndTogether(true);
}

TEST_CASE("canisters whose contacts follow different laws share tables") {
    std::vector<Script> scripts{
        {90, -9.5, 2.26e-6, 0.3}, {120, 7.0, 2.26e-6, 0.3}, {70, 7.0, 2.26e-6, 0.3}, {60, 7.0, 2.26e-6, 0.3}};
    scripts[3].law = NormalLaw::Jkr;
    scripts[1].law = NormalLaw::HertzMindlin;
    scripts[2].law = NormalLaw::Eepa;
    for (Script& s : scripts) {
        s.energyBook = true;
        s.calls = {1200, 700, 300};
    }
    const auto together = playTogether(scripts);
    for (std::size_t k = 0; k < scripts.size(); ++k) checkSame(playAlone(scripts[k]), together[k]);
    CHECK(together[0].sensors[1].energy->plastic > 0);
    CHECK(together[1].sensors[1].energy->plastic == 0);
    CHECK(together[1].sensors[1].energy->viscous > 0);
    CHECK(together[2].sensors[1].energy->plastic > 0);
    CHECK(together[2].sensors[1].energy->adhesive == 0);
    CHECK(together[3].sensors[1].energy->plastic == 0);
    CHECK(together[3].sensors[1].energy->adhesive > 0);
}

TEST_CASE("a canister that fails names its own particle and leaves the others alone") {
    std::vector<Script> scripts{{100, -9.5, 2.26e-6, 0.3}, {61, -9.5, 2.26e-6, 0.3}, {80, -9.5, 2.26e-6, 0.3}};
    scripts[1].throwFirst = {0, 0, -2000};  // through the back
    const std::vector<Outcome> together = playTogether(scripts);
    for (std::size_t k = 0; k < scripts.size(); ++k) {
        INFO("canister " << k);
        checkSame(playAlone(scripts[k]), together[k]);
    }
    CHECK_THAT(together[1].error, Catch::StartsWith("particle 0 "));
}

TEST_CASE("a canister goes on in an ensemble from where it was alone, and the other way round") {
    std::vector<Script> scripts{{120, -9.5, 2.26e-6, 0.3}, {77, 5.0, 2.26e-6, 0.3}, {203, -9.5, 2.26e-6, 0.3}};
    const bool energyBook = GENERATE(false, true);
    for (Script& s : scripts) s.energyBook = energyBook;
    std::vector<Record> taken(scripts.size());
    std::vector<const Record*> from;
    for (std::size_t k = 0; k < scripts.size(); ++k) {
        REQUIRE(playAlone(scripts[k], nullptr, &taken[k]).contacts.size() > 10);
        from.push_back(&taken[k]);
    }
    const std::vector<Outcome> together = playTogether(scripts, from);
    for (std::size_t k = 0; k < scripts.size(); ++k) {
        INFO("canister " << k);
        checkSame(playAlone(scripts[k], from[k]), together[k]);
        checkSameArrays(taken[k], together[k].restored);
    }
}

namespace {

/// Plays the scripts, the first `places` of them from the beginning. Each of the others enters just before one leaves,
/// so that those who stay wait for it in the middle of their calls.
std::vector<Outcome> playInTurn(const std::vector<Script>& scripts, std::size_t places,
                                const std::vector<const Record*>& from = {}) {
    VulkanOptions options;
    options.device = testDevice();
    VulkanEnsemble ensemble(options);
    std::vector<std::unique_ptr<Backend>> backends;
    while (backends.size() < places) backends.push_back(ensemble.enter());
    std::vector<Outcome> outcomes(scripts.size());
    std::vector<ValidationReport> reports(scripts.size());
    std::atomic<std::size_t> next{places};
    std::vector<std::thread> threads;
    for (std::size_t place = 0; place < places; ++place)
        threads.emplace_back([&, place] {
            for (std::size_t k = place; k < scripts.size();) {
                outcomes[k] = play(*backends[place], scripts[k], from.empty() ? nullptr : from[k]);
                reports[k] = validationReport(*backends[place]);
                k = next++;
                backends[place] = k < scripts.size() ? ensemble.enter() : nullptr;
            }
        });
    for (std::thread& t : threads) t.join();
    for (const ValidationReport& report : reports) requireClean(report);
    return outcomes;
}

}  // namespace

TEST_CASE("a canister that takes the place of one that is over computes the same bits, and so do those beside it") {
    const bool energyBook = GENERATE(false, true);
    // The first two go on all the time. What comes after the third is smaller, larger than all tables, one that fails,
    // one under another law, and one that is as large as the largest.
    std::vector<Script> scripts{{203, -9.5, 2.26e-6, 0.3}, {61, 7.0, 3e-6, 0.5},     {140, 0.0, 2.26e-6, 0.1},
                                {90, -9.5, 2.26e-6, 0.3},  {330, 7.0, 2.26e-6, 0.4}, {70, 7.0, 2.26e-6, 0.3},
                                {80, -9.5, 2.26e-6, 0.3},  {330, -9.5, 3e-6, 0.2}};
    scripts[0].calls = {1501, 997, 2700};
    scripts[1].calls = {300, 4500, 61};
    scripts[2].calls = {64};
    for (std::size_t k = 3; k < scripts.size(); ++k) scripts[k].calls = {401, 97, 300};
    scripts[5].throwFirst = {0, 0, -2000};
    scripts[6].law = NormalLaw::HertzMindlin;
    for (Script& s : scripts) s.energyBook = energyBook;
    const std::vector<Outcome> together = playInTurn(scripts, 3);
    for (std::size_t k = 0; k < scripts.size(); ++k) {
        INFO("canister " << k);
        const Outcome alone = playAlone(scripts[k]);
        CHECK(alone.error.empty() == (k != 5));
        if (k < 2) REQUIRE(coilContacts(alone) > 0);
        checkSame(alone, together[k]);
    }
}

TEST_CASE("a canister goes on from where it was in a place that another one left") {
    std::vector<Script> scripts{{120, -9.5, 2.26e-6, 0.3}, {77, 5.0, 2.26e-6, 0.3}, {203, -9.5, 2.26e-6, 0.3}};
    scripts[1].calls = {30};
    std::vector<Record> taken(scripts.size());
    std::vector<const Record*> from;
    for (std::size_t k = 0; k < scripts.size(); ++k) {
        (void)playAlone(scripts[k], nullptr, &taken[k]);
        from.push_back(&taken[k]);
    }
    const std::vector<Outcome> together = playInTurn(scripts, 2, from);
    for (std::size_t k = 0; k < scripts.size(); ++k) {
        INFO("canister " << k);
        checkSame(playAlone(scripts[k], from[k]), together[k]);
        checkSameArrays(taken[k], together[k].restored);
    }
}

TEST_CASE("a canister that cannot share the tables is refused, and the others go on without it") {
    VulkanOptions options;
    options.device = testDevice();
    VulkanEnsemble ensemble(options);
    std::unique_ptr<Backend> first = ensemble.enter();
    const Script script{120, -9.5, 2.26e-6, 0.3};
    first->load(canisterWorld(), thrownIn(20));
    std::unique_ptr<Backend> odd = ensemble.enter();
    std::string said;
    std::thread other([&] {
        RuledWorld world = canisterWorld();
        world.walls.pop_back();
        try {
            odd->load(world, thrownIn(20));
        } catch (const RunError& e) {
            said = e.what();
        }
        odd.reset();
    });
    const Sensors s = first->advance(40, 0);
    other.join();
    CHECK_THAT(said, Catch::Contains("same kinds of surfaces"));
    CHECK(s.count[0] == 20);
    checkSame(playAlone(script), play(*first, script));  // which loads anew
    requireClean(*first);
}

TEST_CASE("canisters with surfaces of other kinds cannot share tables") {
    std::vector<std::unique_ptr<Backend>> backends = gpuEnsemble(2);
    RuledWorld odd = canisterWorld();
    odd.walls.pop_back();
    std::vector<std::string> said(2);
    std::thread other([&] {
        try {
            backends[1]->load(odd, thrownIn(20));
        } catch (const RunError& e) {
            said[1] = e.what();
        }
    });
    try {
        backends[0]->load(canisterWorld(), thrownIn(20));
    } catch (const RunError& e) {
        said[0] = e.what();
    }
    other.join();
    CHECK_THAT(said[0], Catch::Contains("same kinds of surfaces"));
    CHECK_THAT(said[1], Catch::Contains("same kinds of surfaces"));
}
