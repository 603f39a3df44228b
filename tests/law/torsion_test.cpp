// Torsion friction: the element alone, then a sphere spinning on the spot.

#include "host/backend/reference/torsion.h"

#include "tests/law/setups.h"
#include "tests/support/catch.h"
#include "tests/support/near.h"

using namespace vkdose;
using namespace vkdose::test;
using namespace vkdose::reference;

namespace {

/// A sphere resting on a plane with torsion friction only, spinning about the vertical.
Stepper spinner(const ContactParameters& p, double spin, double timeStep, RollingLever lever) {
    RuledWorld world = planeWorld(p, timeStep);
    world.gravity = Vec3(0, -kGravity, 0);
    world.law.rollingLever = lever;
    Particles one;
    one.add(Vec3(0, kRadius - massOf(kRadius) * kGravity / p.k1, 0), kRadius, Vec3(0), Vec3(0, spin, 0));
    return Stepper(world, one);
}

const double kInertia = 0.4 * massOf(kRadius) * kRadius * kRadius;

}  // namespace

TEST_CASE("torsion: spring, dashpot and limit") {
    const FrictionElement element{1000, 0.5, 0.5};
    double spring = 2e-6;
    CHECK(near(torsionForce(element, 1.0, 0.01, 1e-5, spring), -2.1e-3 - 0.005, 1e-2, 1e-12));
    CHECK(near(spring, 2.1e-6, 1e-6, 1e-12));
    CHECK(near(torsionForce(element, 1e-3, 0.01, 0, spring), -0.5e-3, 1e-3, 1e-12));
    CHECK(near(-1000 * spring - 0.5 * 0.01, -0.5e-3, 1e-3, 1e-10));
    CHECK(near(torsionForce(element, 1e-3, -10, 0, spring), 0.5e-3, 1e-3, 1e-12));
}

TEST_CASE("torsion: a dashpot alone, and nothing when it is off") {
    double spring = 0;
    CHECK(near(torsionForce({0, 0.5, 0.5}, 1.0, 0.1, 1e-5, spring), -0.05, 0.05, 1e-12));
    CHECK(near(torsionForce({0, 0.5, 0.5}, 1.0, 10, 1e-5, spring), -0.5, 0.5, 1e-12));
    CHECK(spring == 0);
    spring = 1e-6;
    CHECK(torsionForce({1000, 0.5, 0}, 1.0, 0.1, 1e-5, spring) == 0);
    CHECK(spring == 0);
}

TEST_CASE("torsion: a fast spin is braked by mu_to a_r m g, until it stops") {
    for (const RollingLever lever : {RollingLever::Full, RollingLever::Half}) {
        ContactParameters p = spring(kK1);
        p.kTo = 1000;
        p.gammaTo = 0.05;
        p.muTo = 0.01;
        const double reach = lever == RollingLever::Full ? 2 * kRadius : kRadius;
        const double braking = p.muTo * reach * massOf(kRadius) * kGravity / kInertia, spin = 20, dt = 1e-6;
        Stepper run = spinner(p, spin, dt, lever);
        const int stop = static_cast<int>(spin / braking / dt);
        while (run.steps() < stop / 2) run.step();
        // Closed form apart from the first steps, in which the spring is wound up: parts in 1e4.
        CHECK(near(run.now().spin[0].y, spin - braking * (run.steps() - 0.5) * dt, spin, 1e-3));
        while (run.steps() < 2 * stop) run.step();
        CHECK(near(run.now().spin[0].y, 0, spin, 1e-3));
        CHECK(near(run.now().velocity[0], Vec3(0), spin * kRadius, 1e-9));  // a pure couple moves nothing
    }
}

TEST_CASE("torsion: a slow twist swings on the spring at a_r sqrt(k_to / I)") {
    ContactParameters p = spring(kK1);
    p.kTo = 1000;
    p.muTo = 0.5;
    const double lever = 2 * kRadius, omega = lever * std::sqrt(p.kTo / kInertia), spin = 0.01;
    const int perPeriod = 2000;
    const double dt = 2 * kPi / omega / perPeriod;
    Stepper run = spinner(p, spin, dt, RollingLever::Full);
    for (int n = 0; n < perPeriod; ++n) {
        run.step();
        if (run.steps() == 1) continue;
        // Full-step spin. The first step leaves the spring at rest, which delays the swing by half a step of 2 pi /
        // 2000.
        CHECK(near(run.full().spin[0].y, spin * std::cos(omega * (run.steps() - 1) * dt), spin, 5e-3));
    }
}
