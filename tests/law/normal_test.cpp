// The normal law against its closed forms.

#include "host/law/luding.h"
#include "tests/law/setups.h"
#include "tests/support/catch.h"
#include "tests/support/near.h"

using namespace vkdose;
using namespace vkdose::test;

namespace {

const double kReduced = kRadius;  // two mean spheres: 2 a a / (a + a)

double plasticLimit(const ContactParameters& p) {
    return p.k2Max / (p.k2Max - p.k1) * p.plasticityDepth * kReduced;
}

double stiffnessAfter(const ContactParameters& p, double maxOverlap) {
    return p.k1 + (p.k2Max - p.k1) * std::min(1.0, maxOverlap / plasticLimit(p));
}

/// Force at `overlap` after the contact has been pressed to `maxOverlap`.
double forceAfter(const ContactParameters& p, double maxOverlap, double overlap, double* history = nullptr) {
    double h = maxOverlap;
    const double f = normalForce(p, overlap, kReduced, h);
    if (history) *history = h;
    return f;
}

}  // namespace

TEST_CASE("normal: first loading follows k1 up to the plastic limit, then the k2Max line") {
    const ContactParameters p = paperParameters(0.873);
    const double limit = plasticLimit(p), scale = p.k1 * limit;
    double history = 0;
    for (int n = 1; n <= 40; ++n) {
        const double overlap = limit * n / 20;
        const double expected = overlap <= limit ? p.k1 * overlap : p.k1 * limit + p.k2Max * (overlap - limit);
        CHECK(near(normalForce(p, overlap, kReduced, history), expected, scale, kRounding));
        CHECK(history == overlap);
    }
}

TEST_CASE("normal: unloads along k2, which grows with the largest overlap, to zero at delta_0") {
    const ContactParameters p = paperParameters(0.873);
    for (const double fraction : {0.1, 0.5, 0.9, 1.0, 1.7}) {
        const double largest = fraction * plasticLimit(p), acting = std::min(largest, plasticLimit(p));
        const double k2 = stiffnessAfter(p, largest), plastic = (1 - p.k1 / k2) * acting;
        const double scale = p.k1 * acting;
        CHECK(near(forceAfter(p, largest, plastic), 0, scale, kRounding));
        CHECK(near(forceAfter(p, largest, 0.5 * (acting + plastic)), 0.5 * scale, scale, kRounding));
        // Reloading takes the same line back: delta_max has not changed in between.
        double history = largest;
        normalForce(p, 0.5 * (acting + plastic), kReduced, history);
        CHECK(history == largest);
        CHECK(near(normalForce(p, acting, kReduced, history), p.k1 * acting, scale, kRounding));
    }
}

TEST_CASE("normal: the adhesive branch is -kc delta and pulls delta_max back to where the lines meet") {
    const ContactParameters p = paperParameters(0.873);
    for (const double fraction : {0.3, 1.0, 2.0}) {
        const double acting = std::min(1.0, fraction) * plasticLimit(p), largest = fraction * plasticLimit(p);
        const double k2 = stiffnessAfter(p, largest);
        const double strongest = (k2 - p.k1) / (k2 + p.kc) * acting;  // overlap of the largest attraction
        double history = 0;
        CHECK(near(forceAfter(p, largest, 1.001 * strongest, &history),
                   p.k1 * acting + k2 * (1.001 * strongest - acting), p.k1 * acting, kRounding));
        CHECK(history == largest);
        for (const double part : {0.999, 0.5, 0.01}) {
            const double overlap = part * strongest;
            CHECK(near(forceAfter(p, largest, overlap, &history), -p.kc * overlap, p.k1 * acting, kRounding));
            CHECK(nearRelative(history, overlap * (k2 + p.kc) / (k2 - p.k1), kRounding));
        }
    }
}

TEST_CASE("normal: the pull-off force is the strongest that the law exerts on the way out") {
    for (const double kcRatio : {0.0, 0.3, 0.873, 10.0})
        for (const double fraction : {0.05, 0.5, 1.0, 2.0}) {
            const ContactParameters p = paperParameters(kcRatio);
            const double largest = fraction * plasticLimit(p);
            double history = 0, strongest = 0;
            normalForce(p, largest, kReduced, history);
            for (int n = 1000000; n > 0; --n)
                strongest = std::max(strongest, -normalForce(p, n * 1e-6 * largest, kReduced, history));
            CAPTURE(kcRatio, fraction);
            // A step of a millionth of the overlap misses the corner by as much on k2.
            CHECK(near(strongest, pullOff(p, kReduced, largest), p.k2Max * largest, 2e-6));
            CHECK((strongest > 0) == (kcRatio > 0));
        }
    CHECK(pullOff(spring(1000), kReduced, 1e-5) == 0);
}

TEST_CASE("normal: one stiffness is a linear spring, whatever the plasticity depth and kc") {
    ContactParameters p = spring(1000);
    for (const double depth : {0.0, 0.05})
        for (const double kc : {0.0, 500.0}) {
            p.plasticityDepth = depth;
            p.kc = kc;
            double history = 0;
            for (const double overlap : {1e-6, 5e-6, 2e-6, 1e-9}) {
                CHECK(nearRelative(normalForce(p, overlap, kReduced, history), 1000 * overlap, kRounding));
                CHECK(history == overlap);  // so that a law with two stiffnesses may follow
            }
        }
}

TEST_CASE("normal: without plastic depth the contact is stiff from the start") {
    ContactParameters p = paperParameters(0.3);
    p.plasticityDepth = 0;
    double history = 0;
    for (const double overlap : {1e-6, 5e-6, 2e-6, 1e-9})
        CHECK(nearRelative(normalForce(p, overlap, kReduced, history), p.k2Max * overlap, kRounding));
}

TEST_CASE("normal: the force never jumps while the overlap changes smoothly") {
    const ContactParameters p = paperParameters(0.873);
    const double limit = plasticLimit(p), step = limit / 20000;
    double history = 0, before = 0, overlap = 0;
    const auto go = [&](double target) {
        while (std::abs(target - overlap) > step / 2) {
            overlap += target > overlap ? step : -step;
            if (overlap <= 0) break;
            const double f = normalForce(p, overlap, kReduced, history);
            // The steepest branch is k2Max; on the adhesive branch delta_max trails by one step, worth (k2 + kc) step.
            CHECK(std::abs(f - before) <= 2.01 * (p.k2Max + p.kc) * step);
            before = f;
        }
    };
    go(0.6 * limit);
    go(0.3 * limit);
    go(1.4 * limit);
    go(0.1 * limit);
    go(0.5 * limit);
    go(step);
}

TEST_CASE("normal: two spheres on a damped linear spring follow the closed form") {
    ContactParameters p = spring(kK1);
    p.gamma = 0.0827;
    const double m12 = massOf(kRadius) / 2, speed = 0.2;
    const double decay = p.gamma / (2 * m12), omega = std::sqrt(p.k1 / m12 - decay * decay);
    const double peak = speed / omega;
    const auto worst = [&](int stepsPerContact) {
        const double dt = kPi / omega / stepsPerContact;
        Particles two;
        two.add(Vec3(0, 0, 0), kRadius, Vec3(speed / 2, 0, 0));
        two.add(Vec3(2 * kRadius, 0, 0), kRadius, Vec3(-speed / 2, 0, 0));
        Stepper run(freeWorld(p, dt), two);
        double error = 0;
        for (int n = 1; n < stepsPerContact; ++n) {
            run.step();
            const double t = n * dt, closed = peak * std::exp(-decay * t) * std::sin(omega * t);
            const double overlap = 2 * kRadius - glm::length(run.now().position[0] - run.now().position[1]);
            error = std::max(error, std::abs(overlap - closed) / peak);
        }
        return error;
    };
    // Damping takes the velocity from half a step back: first order, so the error stays below decay dt and halves with
    // the step.
    const double coarse = worst(500), fine = worst(1000);
    CHECK(coarse < decay * kPi / omega / 500);
    CHECK(coarse > 1.8 * fine);
    CHECK(coarse < 2.2 * fine);
}

TEST_CASE("normal: restitution of the undamped adhesive law is Luding's closed form") {
    for (const double kcRatio : {0.0, 0.1, 0.3})
        for (const double speed : {0.3, 0.6}) {
            ContactParameters p = paperParameters(kcRatio, 0, 0);
            p.gamma = 0;
            const double m12 = massOf(kRadius) / 2;
            const double largest = speed * std::sqrt(m12 / p.k1);
            REQUIRE(largest < plasticLimit(p));
            const double kappa = stiffnessAfter(p, largest) / p.k1, chi = p.kc / p.k1;
            const double square = 1 / kappa - chi * (kappa - 1) * (kappa - 1) / (kappa * (kappa + chi));
            REQUIRE(square > 0);

            Particles two;
            two.add(Vec3(0, 0, 0), kRadius, Vec3(speed / 2, 0, 0));
            two.add(Vec3(2 * kRadius, 0, 0), kRadius, Vec3(-speed / 2, 0, 0));
            Stepper run(freeWorld(p, 5e-9), two);
            do run.step();
            while (run.touching() || run.steps() < 10);
            const double out = run.now().velocity[1].x - run.now().velocity[0].x;
            // First order in the step: 23000 steps a contact, with the adhesive branch one step behind.
            CAPTURE(kcRatio, speed, kappa, chi);
            CHECK(near(out, std::sqrt(square) * speed, speed, 2e-3));
        }
}
