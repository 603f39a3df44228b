// Edinburgh's elasto-plastic adhesive law against its published form, quadratures and its limits.

#include "host/law/eepa.h"

#include <cmath>

#include "host/law/hertz.h"
#include "host/model/stability.h"
#include "host/sim/energy_ledger.h"
#include "tests/law/setups.h"
#include "tests/support/catch.h"
#include "tests/support/near.h"

using namespace vkdose;
using namespace vkdose::test;

namespace {

constexpr Elasticity kSoft{5e6, 0.25};
constexpr double kReduced = 0.8e-3, kMass = 3e-6;  // R* = 0.4 mm

struct Adhesion {
    double ratio, energy, pull = 0, exponent = 1.5;
};

ContactParameters sticky(const Adhesion& a, double restitution = 1) {
    ContactParameters rest;
    rest.plasticityRatio = a.ratio;
    rest.surfaceEnergy = a.energy;
    rest.constantPull = a.pull;
    rest.adhesionExponent = a.exponent;
    return elastoPlasticAdhesive(kSoft, kSoft, restitution, rest);
}

const std::vector<Adhesion> kMany{{0, 0},         {0.5, 0},         {0.5, 1},         {0.5, 10},
                                  {0.9, 1, 1e-4}, {0.3, 1, 0, 3.0}, {0.5, 1, 0, 1.0}, {0.7, 0.3, 2e-4, 5.0}};
constexpr double kDepths[] = {1e-6, 2e-5, 2e-4};  // [m]

double hertzLine(const ContactParameters& p, double reduced) {
    return 4.0 / 3.0 * p.modulus * std::sqrt(reduced / 2);
}

/// The published law: its three branches and the conditions between them, with n = 3/2.
struct Published {
    double f0, k1, k2, n = 1.5, chi, plastic, least, strongest, adhesive;

    Published(const ContactParameters& p, double reduced, double largest)
        : f0(-p.constantPull), k1(hertzLine(p, reduced)), k2(k1 / (1 - p.plasticityRatio)), chi(p.adhesionExponent) {
        plastic = std::pow(p.plasticityRatio, 1 / n) * largest;
        const double patch = std::sqrt(2 * plastic * reduced / 2 - plastic * plastic);
        strongest = std::min(1.5 * kPi * p.surfaceEnergy * patch, k2 * std::pow(plastic, n) / 2);
        least = std::pow(std::pow(plastic, n) - strongest / k2, 1 / n);
        adhesive = strongest > 0 ? strongest / std::pow(least, chi) : 0;
    }

    double force(double overlap) const {
        const double loading = k1 * std::pow(overlap, n),
                     unloading = k2 * (std::pow(overlap, n) - std::pow(plastic, n)),
                     pull = -adhesive * std::pow(overlap, chi);
        if (unloading >= loading * (1 - 1e-12)) return f0 + loading;
        return f0 + (unloading > pull ? unloading : pull);
    }

    /// Area under the path from 0, by Simpson's rule on both sides of the pole.
    double area(double overlap) const {
        const auto simpson = [&](double from, double to) {
            const int pieces = 4000;
            const double h = (to - from) / pieces;
            double sum = force(from) + force(to);
            for (int i = 1; i < pieces; ++i) sum += (i % 2 == 1 ? 4 : 2) * force(from + i * h);
            return sum * h / 3;
        };
        return overlap > least ? simpson(0, least) + simpson(least, overlap) : simpson(0, overlap);
    }

    /// Area under the line of first loading.
    double pressing(double overlap) const { return f0 * overlap + 0.4 * k1 * std::pow(overlap, 2.5); }
};

NormalAnswer answerAt(const ContactParameters& p, double overlap, double& memory) {
    return normalAnswer(p, overlap, kReduced, kMass, memory);
}

template <class Do>
void forAll(const Do& visit) {
    for (const Adhesion& a : kMany)
        for (const double largest : kDepths) {
            CAPTURE(a.ratio, a.energy, a.pull, a.exponent, largest);
            const ContactParameters p = sticky(a);
            visit(p, largest, Published(p, kReduced, largest));
        }
}

}  // namespace

TEST_CASE("eepa: force on loading, unloading, reloading and on the adhesive branch") {
    bool capped = false, free = false;
    forAll([&](const ContactParameters& p, double largest, const Published& known) {
        const double scale = known.k1 * std::pow(largest, 1.5);
        double memory = 0;
        for (int i = 1; i <= 50; ++i) {  // the first loading
            const double overlap = largest * i / 50;
            CHECK(near(answerAt(p, overlap, memory).force, known.f0 + known.k1 * std::pow(overlap, 1.5), scale, 1e-12));
            CHECK(memory == overlap);
        }
        for (int pass = 0; pass < 2; ++pass)  // down, and up on the same path
            for (int i = 1; i < 200; ++i) {
                const double overlap = largest * (pass == 0 ? 200 - i : i) / 200;
                CHECK(near(answerAt(p, overlap, memory).force, known.force(overlap), scale, 1e-11));
                CHECK(memory == largest);
            }
        const double deeper = 1.1 * largest;  // and beyond, on the first line
        CHECK(nearRelative(answerAt(p, deeper, memory).force - known.f0, known.k1 * std::pow(deeper, 1.5), 1e-11));
        CHECK(memory == deeper);
        const double jkr =
            1.5 * kPi * p.surfaceEnergy * std::sqrt(kReduced * known.plastic - known.plastic * known.plastic);
        if (p.surfaceEnergy > 0) (known.strongest < jkr ? capped : free) = true;
    });
    CHECK((capped && free));  // both limits of the pull were met
}

TEST_CASE("eepa: the branches meet") {
    forAll([&](const ContactParameters& p, double largest, const Published& known) {
        const double scale = known.k1 * std::pow(largest, 1.5) + known.strongest, nudge = 1e-9;
        double memory = largest;
        for (const double seam : {known.least, known.plastic, largest}) {
            if (seam == 0) continue;
            const double below = answerAt(p, seam * (1 - nudge), memory).force;
            const double above = answerAt(p, std::min(seam * (1 + nudge), largest), memory).force;
            CHECK(memory == largest);
            // A nudge moves along the steepest of the branches.
            const double steepest = 1.5 * known.k2 * std::pow(largest, 1.5) + known.chi * known.strongest;
            CHECK(std::abs(above - below) <= 2 * nudge * steepest + 1e-14 * scale);
        }
        CHECK(near(answerAt(p, largest, memory).force, known.f0 + known.k1 * std::pow(largest, 1.5), scale, 1e-12));
    });
}

TEST_CASE("eepa: a contact pulls most at the pole") {
    forAll([&](const ContactParameters& p, double largest, const Published& known) {
        double memory = largest, lowest = INFINITY;
        for (int i = 1; i <= 20000; ++i) lowest = std::min(lowest, answerAt(p, largest * i / 20000, memory).force);
        const double strongest = known.strongest + p.constantPull;
        CHECK(near(-lowest, strongest, known.k1 * std::pow(largest, 1.5), 1e-3));
        CHECK(-lowest <= strongest * (1 + 1e-12));
        if (known.strongest > 0) {
            CHECK(nearRelative(-answerAt(p, known.least, memory).force, strongest, 1e-9));
            CHECK(nearRelative(answerAt(p, known.least, memory).pull, strongest, 1e-9));
            CHECK(known.least >= 0.999999 * std::cbrt(0.25) * known.plastic);
        }
        CHECK(nearRelative(pullOff(p, kReduced, largest) + 1, strongest + 1, 1e-12));
        const double load = known.f0 + known.k1 * std::pow(largest, 1.5);
        if (load > 0) CHECK(near(pullOffUnder(p, kReduced, load), strongest, strongest + load, 1e-12));
    });
    // A patch as wide as R*: the pull-off of JKR.
    const ContactParameters hard = elastoPlasticAdhesive({1e9, 0.2}, {1e9, 0.2}, 1, sticky({0.5, 2}));
    CHECK(nearRelative(pullOffUnder(hard, kReduced, INFINITY), 1.5 * kPi * 2 * kReduced / 2, 1e-12));
}

TEST_CASE("eepa: friction is counted from the adhesive branch") {
    const ContactParameters p = sticky({0.5, 1, 1e-4, 2.0});
    const double largest = 2e-5;
    const Published known(p, kReduced, largest);
    double memory = largest;
    for (const double overlap : {0.2 * known.least, known.least, 1.2 * known.least, largest}) {
        const NormalAnswer a = answerAt(p, overlap, memory);
        CHECK(nearRelative(a.pull, known.adhesive * std::pow(overlap, 2) + 1e-4, 1e-11));
        if (overlap < known.least) CHECK(near(a.force, -a.pull, a.pull, 1e-12));
    }
}

TEST_CASE("eepa: without plasticity it is the law of Hertz and Mindlin") {
    ContactParameters p = sticky({0, 0}, 0.6);
    p.kr = 0.3, p.kTo = 0.2, p.gammaR = 0.1, p.gammaTo = 0.05;
    ContactParameters elastic = p;
    elastic.law = NormalLaw::HertzMindlin;
    const double largest = 2e-5;
    for (const double overlap : {1e-7, 3e-6, 2e-5}) {
        double memory = largest, touched = 0;
        const NormalAnswer a = answerAt(p, overlap, memory), b = answerAt(elastic, overlap, touched);
        CHECK(nearRelative(a.force, b.force, 1e-13));
        CHECK(a.pull == 0);
        for (double NormalAnswer::*same :
             {&NormalAnswer::gamma, &NormalAnswer::kt, &NormalAnswer::kr, &NormalAnswer::kTo, &NormalAnswer::gammaT,
              &NormalAnswer::gammaR, &NormalAnswer::gammaTo})
            CHECK(a.*same == b.*same);
        CHECK(a.springAlone == b.springAlone);
        CHECK(nearRelative(storedEnergy(p, overlap, kReduced, a.force, largest),
                           storedEnergy(elastic, overlap, kReduced, b.force, overlap), 1e-12));
    }
    CHECK(near(restitutionAt(p, kMass, kReduced, 0.3), 0.6, 1, 1e-4));
}

TEST_CASE("eepa: the stored energy is the area under the path, the work of a first touch that under the first line") {
    forAll([&](const ContactParameters& p, double largest, const Published& known) {
        const double scale = known.k1 * std::pow(largest, 2.5);
        for (const double share : {0.05, 0.3, 0.5, 0.62, 0.9, 1.0}) {
            const double overlap = share * largest;
            double memory = largest;
            const double force = answerAt(p, overlap, memory).force;
            CHECK(near(storedEnergy(p, overlap, kReduced, force, largest), known.area(overlap), scale, 1e-6));
        }
        double fresh = 0;
        const double force = answerAt(p, largest, fresh).force;
        CHECK(near(workOfFirstTouch(p, largest, kReduced, force), known.pressing(largest), scale, 1e-12));
    });
}

TEST_CASE("eepa: restitution is that of the areas, and with damping that of an integral in small steps") {
    for (const Adhesion& a : kMany)
        for (const double largest : {5e-6, 1e-4}) {
            CAPTURE(a.ratio, a.energy, a.pull, a.exponent, largest);
            const ContactParameters p = sticky(a);
            const Published known(p, kReduced, largest);
            const double energy = known.pressing(largest), back = known.area(largest);
            if (energy <= 0) continue;
            const double speed = std::sqrt(2 * energy / kMass);
            CHECK(nearRelative(overlapOfImpact(p, kMass, kReduced, speed), largest, 1e-9));
            const double e = restitutionAt(p, kMass, kReduced, speed);
            CHECK(near(e * e, std::max(0.0, back / energy), 1, 2e-4));

            const ContactParameters damped = sticky(a, 0.7);
            const double dt = largest / speed * std::sqrt(1 - a.ratio) * 1e-4;
            double overlap = 0, approach = speed, memory = 0;
            for (int i = 0; i < 2000000 && overlap >= 0 && !(i > 0 && approach > 0 && overlap < 0.9 * memory); ++i) {
                const NormalAnswer now = normalAnswer(damped, overlap, kReduced, kMass, memory);
                approach -= (now.force + now.gamma * approach) / kMass * dt;
                overlap += approach * dt;
            }
            const double expected = overlap < 0 ? -approach / speed : 0;
            CHECK(near(restitutionAt(damped, kMass, kReduced, speed), expected, 1, 2e-3));
        }
}

TEST_CASE("eepa: slow impacts tend to a limit, in which a constant pull holds") {
    for (const Adhesion& a : {Adhesion{0.5, 0}, {0.5, 1}, {0.3, 5, 0, 3.0}}) {
        const ContactParameters p = sticky(a, 0.9);
        const double limit = restitutionAt(p, kMass, kReduced, 0);
        CHECK(limit > 0.1);
        CHECK(near(restitutionAt(p, kMass, kReduced, 1e-6), limit, 1, 1e-3));
    }
    CHECK(restitutionAt(sticky({0.5, 1, 1e-5}), kMass, kReduced, 0) == 0);
    CHECK(restitutionAt(sticky({0.5, 1, 1e-5}), kMass, kReduced, 1e-4) == 0);
    CHECK(restitution(sticky({0.5, 1}, 0.8), reducedMass(2500, 1e-3, 2e-3)) == Approx(0.8));
}

TEST_CASE("eepa: head-on collisions lose what the areas say, and their ledger closes") {
    for (const Adhesion& a : kMany)
        for (const double e : {1.0, 0.7})
            for (const double speed : {0.02, 0.1, 0.4}) {
                const ContactParameters p = sticky(a, e);
                const double mass = massOf(kRadius), incoming = mass * speed * speed;
                const double deepest = overlapOfImpact(p, mass / 2, kRadius, 2 * speed);
                const Published known(p, kRadius, deepest);
                const double duration = 3 * deepest / (2 * speed), dt = duration / 4000;
                RuledWorld world = freeWorld(p, dt);
                world.energyBook = true;
                Particles two;
                const double gap = 2e-9;
                two.add(Vec3(0), kRadius, Vec3(speed, 0, 0));
                two.add(Vec3(2 * kRadius + gap, 0, 0), kRadius, Vec3(-speed, 0, 0));
                auto backend = makeReferenceBackend();
                backend->load(world, two);
                EnergyLedger ledger;
                for (int n = 0; n < 40; ++n) ledger.add(*backend->advance(200, 0).energy);
                CAPTURE(a.ratio, a.energy, a.pull, a.exponent, e, speed, ledger.sum.numerical / incoming);
                CHECK(near(ledger.residual(), 0, incoming, 1e-11));
                CHECK(near(ledger.sum.numerical, 0, incoming, 1e-4));
                CHECK(ledger.sum.adhesive == 0);
                CHECK((ledger.sum.viscous > 0.1 * incoming) == (e < 1));
                if (e < 1) continue;
                const double lost = known.pressing(deepest) - known.area(deepest);
                CHECK(near(ledger.sum.plastic, lost, incoming, 1e-3));
                const double left = std::max(0.0, incoming - lost);
                if (lost < incoming) CHECK(near(ledger.sum.kinetic, left, incoming, 1e-3));
            }
}

TEST_CASE("eepa: the step in which a contact begins loses what the areas say, and the one in which it parts nothing") {
    const ContactParameters p = sticky({0.5, 1, 2e-4, 3.0});
    const double speed = 0.3, mass = massOf(kRadius);
    RuledWorld world = planeWorld(p, overlapOfImpact(p, mass, 2 * kRadius, speed) / speed / 10);
    world.energyBook = true;
    Particles one;
    one.add(Vec3(0, kRadius + 1e-9, 0), kRadius, Vec3(0, -speed, 0));
    auto backend = makeReferenceBackend();
    backend->load(world, one);
    bool touched = false, parted = false;
    for (int n = 0; n < 200 && !parted; ++n) {
        const EnergyBook book = *backend->advance(1, 0).energy;
        const auto contacts = backend->contacts();
        if (!touched && !contacts.empty()) {
            const double overlap = contacts[0].maxOverlap;
            const Published known(p, 2 * kRadius, overlap);
            const double lost = known.pressing(overlap) - known.area(overlap);
            CHECK(near(book.plastic, lost, known.k1 * std::pow(overlap, 2.5), 1e-6));
        }
        parted = touched && contacts.empty();
        touched = touched || !contacts.empty();
        if (parted) {
            CHECK(book.plastic == 0);
            CHECK(book.adhesive == 0);
            CHECK(book.numerical != 0);
        }
    }
    CHECK(parted);
}

TEST_CASE("eepa: a loaded contact brings its energy, and a slider books what the overlap makes stiffer") {
    ContactParameters p = sticky({0.5, 1, 1e-5}, 0.8);
    p.mu = 0.4, p.muR = 0.1, p.muTo = 0.1;
    p.kr = p.kTo = 0.3, p.gammaR = p.gammaTo = 0.2;
    RuledWorld world = planeWorld(p, 1e-6);
    world.gravity = Vec3(0, -kGravity, 0);
    world.energyBook = true;
    Particles one;
    one.add(Vec3(0, kRadius - 1e-5, 0), kRadius, Vec3(0.1, 0, 0.02), Vec3(3, 40, -10));
    auto backend = makeReferenceBackend();
    backend->load(world, one);
    EnergyLedger ledger;
    for (int n = 0; n < 300; ++n) {
        ledger.add(*backend->advance(37, 0).energy);
        CHECK(near(ledger.residual(), 0, ledger.sum.loaded, 1e-11));
    }
    CHECK(ledger.sum.sliding > 0.02 * ledger.sum.loaded);
    CHECK(ledger.sum.rolling > 0);
    CHECK(ledger.sum.torsion > 0);
}

TEST_CASE("eepa: a time step is judged by the steepest branch at the largest overlap that the run allows") {
    const double radius = 1e-3, mass = 2500 * 4.0 / 3.0 * kPi * 1e-9, deepest = 0.02 * radius;
    const auto normal = [&](const Adhesion& a) {
        World world;
        world.density() = 2500;
        world.maxOverlapRatio = 0.02;
        return contactModes(world, lawOf(sticky(a)), {{radius, radius, radius}})[0].duration;
    };
    const ContactParameters p = sticky({0.5, 0});
    const double k = 2 * p.modulus * std::sqrt(radius / 2 * deepest);
    CHECK(nearRelative(normal({0, 0}), kPi * std::sqrt(mass / 2 / k), 1e-12));
    CHECK(nearRelative(normal({0.5, 0}), kPi * std::sqrt(mass / 2 / (2 * k)), 1e-12));
    CHECK(nearRelative(normal({0.75, 1}), kPi * std::sqrt(mass / 2 / (4 * k)), 1e-12));
    // No branch is steeper, however strong the pull and however soon it fades.
    for (const double exponent : {1.0, 1.5, 4.0, 12.0})
        for (const double energy : {0.1, 1.0, 1000.0}) {
            const ContactParameters q = sticky({0.5, energy, 0, exponent});
            double memory = deepest, steepest = 0;
            for (int i = 2; i < 5000; ++i) {
                const double at = deepest * i / 5000, h = deepest * 1e-6;
                const double rise = normalAnswer(q, at + h, radius, mass, memory).force -
                                    normalAnswer(q, at - h, radius, mass, memory).force;
                steepest = std::max(steepest, std::abs(rise / (2 * h)));
            }
            const double judged = linearised(q, mass, radius, deepest).k2Max;
            CAPTURE(exponent, energy, judged, steepest);
            CHECK(steepest <= 1.001 * judged);
            if (energy == 1000) CHECK(steepest > 0.95 * judged);
        }
}
