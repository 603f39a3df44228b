// Sliding friction: the element alone, then impacts and slides with known outcomes.

#include "host/backend/reference/sliding.h"

#include "tests/law/setups.h"
#include "tests/support/catch.h"
#include "tests/support/near.h"

using namespace vkdose;
using namespace vkdose::test;
using reference::FrictionElement;
using reference::frictionForce;
using reference::intoTangentPlane;

namespace {
const Vec3 kUp(0, 1, 0);
}  // namespace

TEST_CASE("sliding: below the limit it is a spring with a dashpot") {
    const FrictionElement element{1000, 0.5, 0.5};
    Vec3 spring(2e-6, 0, 1e-6);
    const Vec3 v(0.01, 0, -0.02);
    const double dt = 1e-5;
    const Vec3 force = frictionForce(element, 1.0, kUp, v, dt, spring);
    CHECK(near(spring, Vec3(2.1e-6, 0, 0.8e-6), 1e-6, kRounding));
    CHECK(near(force, Vec3(-2.1e-3 - 0.005, 0, -0.8e-3 + 0.01), 1e-2, kRounding));
}

TEST_CASE("sliding: beyond the limit the force is the limit and the spring what the slider bears") {
    const FrictionElement element{1000, 0.5, 0.5};
    Vec3 spring(3e-6, 0, 4e-6);
    const Vec3 v(0.03, 0, 0.04);
    const double bearing = 1e-3;
    const Vec3 force = frictionForce(element, bearing, kUp, v, 0, spring);
    CHECK(near(force, -0.5 * bearing * Vec3(0.6, 0, 0.8), bearing, kRounding));
    CHECK(near(-1000.0 * spring - 0.5 * v, force, bearing, 1e-10));
    // At the same velocity the next step finds the slider exactly at its limit.
    CHECK(near(frictionForce(element, bearing, kUp, v, 0, spring), force, bearing, 1e-10));
}

TEST_CASE("sliding: the limit itself still sticks") {
    const FrictionElement element{1024, 0, 0.5};  // powers of two: no rounding in this test
    Vec3 spring(0x1p-10, 0, 0);
    CHECK(frictionForce(element, 2.0, kUp, Vec3(0), 0, spring) == Vec3(-1, 0, 0));
    CHECK(spring == Vec3(0x1p-10, 0, 0));
    CHECK(frictionForce(element, 1.0, kUp, Vec3(0), 0, spring) == Vec3(-0.5, 0, 0));
    CHECK(spring == Vec3(0x1p-11, 0, 0));
}

TEST_CASE("sliding: without stiffness it is a dashpot with a limit") {
    const FrictionElement element{0, 0.5, 0.5};
    Vec3 spring(0);
    CHECK(near(frictionForce(element, 1.0, kUp, Vec3(0.1, 0, 0), 1e-5, spring), Vec3(-0.05, 0, 0), 0.05, kRounding));
    CHECK(near(frictionForce(element, 1.0, kUp, Vec3(10, 0, 0), 1e-5, spring), Vec3(-0.5, 0, 0), 0.5, kRounding));
    CHECK(spring == Vec3(0));
}

TEST_CASE("sliding: without friction there is neither force nor spring, and no load gives no force") {
    Vec3 spring(1e-6, 0, 0);
    CHECK(frictionForce({1000, 0.5, 0}, 1.0, kUp, Vec3(0.1, 0, 0), 1e-5, spring) == Vec3(0));
    CHECK(spring == Vec3(0));
    spring = Vec3(1e-6, 0, 0);
    CHECK(frictionForce({1000, 0.5, 0.5}, 0.0, kUp, Vec3(0.1, 0, 0), 1e-5, spring) == Vec3(0));
    CHECK(near(spring, Vec3(-0.5 * 0.1 / 1000, 0, 0), 1e-6, kRounding));
}

TEST_CASE("sliding: the spring turns with the contact and keeps its length") {
    const Vec3 spring(3e-6, 4e-6, 0);
    const Vec3 turned = intoTangentPlane(spring, kUp);
    CHECK(near(turned, Vec3(5e-6, 0, 0), 5e-6, kRounding));
    CHECK(intoTangentPlane(Vec3(0, 1e-6, 0), kUp) == Vec3(0));  // along the normal: no direction left
    CHECK(intoTangentPlane(Vec3(0), kUp) == Vec3(0));

    // Carried along as the normal goes a quarter round, in small steps, it ends where a rotation would take it.
    Vec3 carried(1e-6, 0, 2e-6);
    for (int n = 1; n <= 1000; ++n) {
        const double phi = kPi / 2 * n / 1000;
        carried = intoTangentPlane(carried, Vec3(std::sin(phi), std::cos(phi), 0));
    }
    CHECK(near(carried, Vec3(0, -1e-6, 2e-6), 2e-6, 1e-2));
    CHECK(near(glm::length(carried), std::sqrt(5.0) * 1e-6, 1e-6, 1e-9));
}

TEST_CASE("sliding: an oblique impact that slides throughout") {
    // Undamped linear contact: e = 1, the friction impulse is mu times the normal one, whatever kt.
    ContactParameters p = spring(kK1);
    p.kt = 6883.162;
    p.mu = 0.2;
    const double vn = 0.1, vt = 2.0;
    for (const CoulombLimit limit : {CoulombLimit::Absolute, CoulombLimit::Luding}) {
        RuledWorld world = planeWorld(p, 1e-8);
        world.law = lawOf(p, limit);
        Particles one;
        one.add(Vec3(0, kRadius, 0), kRadius, Vec3(vt * 0.6, -vn, vt * 0.8));
        Stepper run(world, one);
        do run.step();
        while (run.touching() || run.steps() < 10);
        const Vec3 v = run.now().velocity[0], w = run.now().spin[0];
        const double slowed = 2 * p.mu * vn;
        // Leapfrog keeps the impulse to second order; the contact ends within one of 16000 steps: parts in 1e4.
        CHECK(near(v.y, vn, vn, 1e-4));
        CHECK(near(Vec3(v.x, 0, v.z), (vt - slowed) * Vec3(0.6, 0, 0.8), slowed, 1e-3));
        // The lever is a - delta/2 with delta up to 2.6e-6 m, a thousandth of a.
        const double spin = 2.5 * slowed / kRadius;
        CHECK(near(w, spin * Vec3(0.8, 0, -0.6), spin, 2e-3));
    }
}

TEST_CASE("sliding: a sphere set sliding on a plane ends up rolling at 5/7 of its speed") {
    ContactParameters p = paperParameters(0, 0.3, 0);
    p.gamma = 0.3;  // near critical damping: the bed of the slide stays quiet
    p.gammaT = 0.2;
    RuledWorld world = planeWorld(p, 4e-6);
    world.gravity = Vec3(0, -kGravity, 0);
    const double speed = 0.1, sinking = massOf(kRadius) * kGravity / p.k1;
    Particles one;
    one.add(Vec3(0, kRadius - sinking, 0), kRadius, Vec3(speed, 0, 0));
    Stepper run(world, one);
    const double slide = 2 * speed / (7 * p.mu * kGravity);
    while (run.steps() * world.timeStep < 0.5 * slide) run.step();
    // Half way it slows at mu g. The lever a - delta/2 and the kick's half step are parts in 1e4.
    const double t = (run.steps() - 0.5) * world.timeStep;
    CHECK(near(run.now().velocity[0].x, speed - p.mu * kGravity * t, speed, 1e-3));
    CHECK(near(run.now().spin[0].z * kRadius, -2.5 * p.mu * kGravity * t, speed, 1e-3));
    while (run.steps() * world.timeStep < 1.5 * slide) run.step();
    CHECK(near(run.now().velocity[0].x, 5.0 / 7 * speed, speed, 1e-3));
    CHECK(near(-run.now().spin[0].z * kRadius, 5.0 / 7 * speed, speed, 1e-3));
}
