// Elastic adhesive spheres against the theory of Johnson, Kendall and Roberts with the contact radius as its parameter.

#include "host/law/jkr.h"
#include "host/law/hertz.h"

#include <cmath>

#include "host/backend/reference/contact.h"
#include "host/sim/energy_ledger.h"
#include "tests/law/setups.h"
#include "tests/support/catch.h"
#include "tests/support/near.h"

using namespace vkdose;
using namespace vkdose::test;

namespace {

constexpr Elasticity kSoft{5e6, 0.25};
constexpr double kReduced = 0.8e-3, kSize = kReduced / 2, kMass = 3e-6;

ContactParameters sticky(double energy, double restitution = 1) {
    ContactParameters rest;
    rest.surfaceEnergy = energy;
    return elasticAdhesive(kSoft, kSoft, restitution, rest);
}

/// The published law: Hertz's pressure less that of a flat punch, which the surface energy sets.
struct Published {
    double modulus, energy, size;

    explicit Published(const ContactParameters& p, double reduced = kReduced)
        : modulus(p.modulus), energy(p.surfaceEnergy), size(reduced / 2) {}

    double overlap(double a) const { return a * a / size - std::sqrt(2 * kPi * energy * a / modulus); }
    double force(double a) const {
        return 4 * modulus * a * a * a / (3 * size) - std::sqrt(8 * kPi * energy * modulus * a * a * a);
    }
    /// Contact radius where the overlap is least, by d overlap/da = 0.
    double lost() const { return std::cbrt(kPi * energy * size * size / (8 * modulus)); }
    double reach() const { return -overlap(lost()); }
    double pullOff() const { return 1.5 * kPi * energy * size; }
    /// Work from the overlap at which the contact is lost to that of the radius, by Simpson's rule over the radius.
    double area(double a) const {
        const int pieces = 2000;
        const double h = (a - lost()) / pieces;
        const auto rate = [&](double x) {
            return force(x) * (2 * x / size - std::sqrt(kPi * energy / (2 * modulus * x)));
        };
        double sum = rate(lost()) + rate(a);
        for (int i = 1; i < pieces; ++i) sum += (i % 2 == 1 ? 4 : 2) * rate(lost() + i * h);
        return sum * h / 3;
    }
    /// The contact radius at which the overlap is zero.
    double touching() const { return std::cbrt(2 * kPi * energy * size * size / modulus); }
    /// What is lost as the spheres snap together: Thornton and Ning 1998, Powder Technology 99:154.
    double snap() const { return 7.09 * std::cbrt(std::pow(energy, 5) * std::pow(size, 4) / (modulus * modulus)); }
};

}  // namespace

TEST_CASE("jkr: force and overlap are those of the theory at every contact radius") {
    for (const double energy : {1e-6, 1e-3, 0.05, 1.0}) {
        const ContactParameters p = sticky(energy);
        const Published known(p);
        for (int i = 0; i <= 400; ++i) {
            const double a = known.lost() * std::pow(10.0, 1e-3 + 0.01 * i);
            const double overlap = known.overlap(a);
            double memory = 1e-9;
            const NormalAnswer answer = normalAnswer(p, overlap, kReduced, kMass, memory);
            CAPTURE(energy, a / known.lost());
            CHECK(near(answer.force, known.force(a), known.pullOff() + std::abs(known.force(a)), 1e-8));
            CHECK(near(memory, overlap + known.reach(), known.reach() + std::abs(overlap), 1e-11));
            CHECK(memory > 0);
            CHECK(nearRelative(answer.kt, p.kt * 2 * p.modulus * a, 1e-6));
            CHECK(nearRelative(answer.pull, 2 * known.pullOff(), 1e-12));
        }
    }
}

TEST_CASE("jkr: pull-off, the pull at touch and the pull at which the contact is lost") {
    for (const double energy : {1e-3, 0.2}) {
        const ContactParameters p = sticky(energy);
        const Published known(p);
        double lowest = 0, memory = 1e-9;
        for (int i = 0; i <= 20000; ++i)
            lowest = std::min(lowest, normalAnswer(p, known.reach() * (2e-4 * i - 1), kReduced, kMass, memory).force);
        CHECK(nearRelative(-lowest, known.pullOff(), 1e-6));
        CHECK(nearRelative(normalAnswer(p, 0, kReduced, kMass, memory).force, -8.0 / 9 * known.pullOff(), 1e-9));
        CHECK(nearRelative(JkrContact(p, kReduced).force(-known.reach()), -5.0 / 9 * known.pullOff(), 1e-6));
        CHECK(nearRelative(reachOf(p, kReduced), known.reach(), 1e-12));
        CHECK(nearRelative(pullOff(p, kReduced, 0), known.pullOff(), 1e-12));
        CHECK(nearRelative(pullOffUnder(p, kReduced, INFINITY), known.pullOff(), 1e-12));
        for (const double load : {0.0, 0.3, 4.0, 1e3}) {
            const double overlap = overlapUnder(p, kReduced, load * known.pullOff());
            CHECK(near(JkrContact(p, kReduced).force(overlap), load * known.pullOff(), known.pullOff() * (1 + load),
                       1e-9));
            CHECK(overlap > 0);
        }
        const ContactLaw law = lawOf(p);
        CHECK(longestReach(World(), law, kReduced / 2) == reachOf(p, kReduced));
        CHECK(longestReach(World(), lawOf(spring(1e3)), 1) == 0);
    }
}

TEST_CASE("jkr: the stored energy is the area under the path, and what touch loses is as published") {
    for (const double energy : {1e-3, 0.05, 1.0}) {
        const ContactParameters p = sticky(energy);
        const Published known(p);
        for (const double share : {1.001, 1.3, 2.0, 2.51984, 3.5, 9.0}) {
            const double a = share * known.lost(), overlap = known.overlap(a);
            const double stored = storedEnergy(p, overlap, kReduced, 0, 1);
            CHECK(near(stored, known.area(a), known.snap() + std::abs(stored), 1e-7));
            if (overlap <= 0) continue;
            const double arriving = workOfFirstTouch(p, overlap, kReduced, 0);
            CHECK(near(arriving - stored, known.snap(), known.snap() + std::abs(stored), 1e-3));
            CHECK(near(arriving, known.area(a) - known.area(known.touching()), known.snap() + std::abs(stored), 1e-6));
        }
    }
}

TEST_CASE("jkr: without surface energy it is the law of Hertz and Mindlin") {
    ContactParameters p = sticky(0, 0.6);
    p.kr = 0.3, p.kTo = 0.2, p.gammaR = 0.1, p.gammaTo = 0.05;
    ContactParameters elastic = p;
    elastic.law = NormalLaw::HertzMindlin;
    CHECK(reachOf(p, kReduced) == 0);
    for (const double overlap : {1e-7, 3e-6, 2e-5}) {
        double memory = 0, touched = 0;
        const NormalAnswer a = normalAnswer(p, overlap, kReduced, kMass, memory),
                           b = normalAnswer(elastic, overlap, kReduced, kMass, touched);
        for (double NormalAnswer::*same :
             {&NormalAnswer::force, &NormalAnswer::gamma, &NormalAnswer::kt, &NormalAnswer::kr, &NormalAnswer::kTo,
              &NormalAnswer::gammaT, &NormalAnswer::gammaR, &NormalAnswer::gammaTo})
            CHECK(nearRelative(a.*same, b.*same, 1e-12));
        CHECK(a.pull == 0);
        CHECK(memory == overlap);
        CHECK(nearRelative(storedEnergy(p, overlap, kReduced, a.force, memory),
                           storedEnergy(elastic, overlap, kReduced, b.force, touched), 1e-12));
        CHECK(nearRelative(overlapUnder(p, kReduced, a.force), overlap, 1e-9));
    }
    for (const double speed : {0.0, 0.3}) CHECK(near(restitutionAt(p, kMass, kReduced, speed), 0.6, 1, 1e-4));
    CHECK(nearRelative(overlapOfImpact(p, kMass, kReduced, 0.3), overlapOfImpact(elastic, kMass, kReduced, 0.3), 1e-9));
}

TEST_CASE("jkr: slow impacts stick, and faster ones lose what snapping together took") {
    for (const double energy : {1e-3, 0.05}) {
        const ContactParameters p = sticky(energy);
        const Published known(p);
        const double sticking = std::sqrt(2 * known.snap() / kMass);
        CHECK(restitutionAt(p, kMass, kReduced, 0) == 0);
        for (const double share : {0.2, 0.9, 0.99}) CHECK(restitutionAt(p, kMass, kReduced, share * sticking) == 0);
        for (const double share : {1.02, 1.5, 4.0, 30.0}) {
            const double e = restitutionAt(p, kMass, kReduced, share * sticking);
            CHECK(near(e * e, 1 - 1 / (share * share), 1, 1e-3));
            const double deepest = overlapOfImpact(p, kMass, kReduced, share * sticking);
            const JkrContact contact(p, kReduced);
            CHECK(nearRelative(contact.energy(deepest) - contact.energy(0),
                               kMass * share * share * sticking * sticking / 2, 1e-9));
        }
        const ContactParameters damped = sticky(energy, 0.7);
        const double speed = 3 * sticking, dt = overlapOfImpact(p, kMass, kReduced, speed) / speed * 1e-4;
        double overlap = 0, approach = speed, memory = 0;
        for (int i = 0; i < 2000000 && overlap > -known.reach(); ++i) {
            const NormalAnswer now = normalAnswer(damped, overlap, kReduced, kMass, memory);
            approach -= (now.force + now.gamma * approach) / kMass * dt;
            overlap += approach * dt;
        }
        CHECK(near(restitutionAt(damped, kMass, kReduced, speed), -approach / speed, 1, 2e-3));
    }
}

TEST_CASE("jkr: head-on collisions lose what snapping together takes, and their ledger closes") {
    for (const double energy : {0.0, 1e-3, 0.05})
        for (const double e : {1.0, 0.7})
            for (const double share : {0.5, 2.0, 6.0}) {
                const ContactParameters p = sticky(energy, e);
                const Published known(p, kRadius);
                const double mass = massOf(kRadius);
                const double speed = energy > 0 ? share * std::sqrt(known.snap() / mass) : 0.1 * share;
                const double incoming = mass * speed * speed;
                const double deepest = overlapOfImpact(p, mass / 2, kRadius, 2 * speed);
                RuledWorld world = freeWorld(p, 3 * deepest / (2 * speed) / 8000);
                world.energyBook = true;
                Particles two;
                two.add(Vec3(0), kRadius, Vec3(speed, 0, 0));
                two.add(Vec3(2 * kRadius + 2e-9, 0, 0), kRadius, Vec3(-speed, 0, 0));
                auto backend = makeReferenceBackend();
                backend->load(world, two);
                EnergyLedger ledger;
                for (int n = 0; n < 100; ++n) ledger.add(*backend->advance(200, 0).energy);
                CAPTURE(energy, e, share, ledger.sum.numerical / incoming, ledger.sum.adhesive / incoming);
                CHECK(near(ledger.residual(), 0, incoming, 1e-11));
                CHECK(near(ledger.sum.numerical, 0, incoming, 3e-3));
                CHECK(ledger.sum.plastic == 0);
                CHECK(near(ledger.sum.adhesive, known.snap(), incoming + known.snap(), 1e-3));
                CHECK((ledger.sum.viscous > 0.1 * incoming) == (e < 1));
                // Damping and the loop together hold what the loop alone would let go.
                const bool rebounds = share > (e < 1 ? 3 : 1);
                if (energy > 0) CHECK(backend->contacts().size() == (rebounds ? 0 : 1));
                if (e == 1 && share > 1) CHECK(near(ledger.sum.kinetic, incoming - known.snap(), incoming, 4e-3));
            }
}

TEST_CASE("jkr: friction is counted from twice the pull-off force, also beyond touch") {
    ContactParameters p = sticky(0.05);
    p.mu = 0.4;
    const Published known(p);
    for (const double share : {-0.9, 0.0, 2.0}) {
        reference::Touch touch{};
        touch.normal = Vec3(0, 1, 0);
        touch.overlap = share * known.reach();
        touch.reduced = kReduced;
        touch.smaller = kSize;
        touch.mass = kMass;
        touch.velocity = Vec3(0.1, 0, 0);
        reference::History history;
        history.maxOverlap = 1e-9;
        history.sliding = Vec3(1, 0, 0);  // far beyond any limit
        const reference::Response r = contactResponse(lawOf(p, CoulombLimit::Luding),
                                                      pairOf(ContactClass::ParticleParticle), touch, 1e-9, history);
        CHECK(nearRelative(glm::length(r.parts.sliding), p.mu * (r.parts.hysteretic + 2 * known.pullOff()), 1e-9));
        CHECK(r.parts.slides);
    }
}

TEST_CASE("jkr: a contact that has come about holds on beyond touch, and one that has not does not begin there") {
    const ContactParameters p = sticky(0.05);
    const double reach = reachOf(p, 2 * kRadius), step = reach / 50;
    RuledWorld world = planeWorld(p, 1e-12);
    world.skin = 1e-4;
    for (const bool fromTouch : {false, true}) {
        const double gap = 0.5 * reach;
        Particles one;
        one.add(Vec3(0, kRadius + (fromTouch ? -step : gap), 0), kRadius, Vec3(0));
        auto backend = makeReferenceBackend();
        backend->load(world, one);
        backend->advance(1, 0);
        CHECK(backend->contacts().size() == (fromTouch ? 1 : 0));
        if (!fromTouch) continue;
        // Carried away step by step, with what the backend remembers of the contact.
        double y = kRadius;
        for (int n = 0; n < 60; ++n, y += step) {
            Record record = backend->snapshot();
            std::vector<double> position{0, y, 0}, rest{0, 0, 0};
            record.put("position", position);
            record.put("velocity", rest);
            backend->restore(record);
            backend->advance(1, 0);
            const double out = y - kRadius;
            CAPTURE(out / reach);
            const auto contacts = backend->contacts();
            if (std::abs(out - reach) < step / 2) continue;
            CHECK(contacts.size() == (out < reach ? 1 : 0));
            if (!contacts.empty())
                CHECK(nearRelative(contacts[0].force.y, JkrContact(p, 2 * kRadius).force(-out), 1e-4));
        }
    }
}
