// Rolling resistance: lever, velocity and torque, then a rolling sphere that is braked by it.

#include "host/backend/reference/rolling.h"

#include "tests/law/setups.h"
#include "tests/support/catch.h"
#include "tests/support/near.h"

using namespace vkdose;
using namespace vkdose::test;
using namespace vkdose::reference;

TEST_CASE("rolling: both readings of the lever") {
    CHECK(rollingLever(RollingLever::Full, 2e-3) == 2e-3);
    CHECK(rollingLever(RollingLever::Half, 2e-3) == 1e-3);
}

TEST_CASE("rolling: the velocity is across normal and spin, the torque opposes the rolling") {
    const Vec3 n(0, 1, 0), spin(0, 0, -3);  // rolling towards +x on the ground
    const Vec3 v = rollingVelocity(2e-3, n, spin);
    CHECK(near(v, Vec3(6e-3, 0, 0), 6e-3, 1e-12));
    const Vec3 torque = rollingTorque(2e-3, n, -v);  // a force that resists
    CHECK(glm::dot(torque, spin) < 0);
    CHECK(near(torque, Vec3(0, 0, 1.2e-5), 1.2e-5, 1e-12));
    CHECK(near(rollingVelocity(2e-3, n, Vec3(0, 5, 0)), Vec3(0), 1e-2, 1e-12));  // spinning about n is torsion
}

TEST_CASE("rolling: a rolling sphere is braked by (5/7) mu_r g a_r / a") {
    for (const RollingLever lever : {RollingLever::Full, RollingLever::Half}) {
        ContactParameters p = paperParameters(0, 0.5, 0.02);
        p.gamma = 0.3;  // near critical damping, so that the start leaves no rattle
        p.gammaT = 0.2;
        RuledWorld world = planeWorld(p, 4e-6);
        world.gravity = Vec3(0, -kGravity, 0);
        world.law.rollingLever = lever;
        const double speed = 0.1, sinking = massOf(kRadius) * kGravity / p.k1;
        Particles one;
        one.add(Vec3(0, kRadius - sinking, 0), kRadius, Vec3(speed, 0, 0), Vec3(0, 0, -speed / kRadius));
        Stepper run(world, one);
        while (run.steps() < 1000) run.step();
        const double first = run.now().velocity[0].x;
        while (run.steps() < 6000) run.step();
        const double expected = 5.0 / 7 * p.muR * kGravity * (lever == RollingLever::Full ? 2 : 1);
        // The friction spring settles within the first 1000 steps; what is left is a - delta/2 for a: parts in 1e4.
        CHECK(nearRelative((first - run.now().velocity[0].x) / (5000 * world.timeStep), expected, 1e-3));
        CHECK(near(-run.now().spin[0].z * kRadius, run.now().velocity[0].x, speed, 1e-3));
    }
}

TEST_CASE("rolling: two spheres that turn together do not resist, two that counter-rotate do") {
    const ContactParameters p = paperParameters(0, 0, 0.5);  // rolling alone
    for (const double other : {1.0, -1.0}) {
        Particles two;
        two.add(Vec3(0), kRadius, Vec3(0), Vec3(0, 0, 10));
        two.add(Vec3(2 * kRadius - 1e-6, 0, 0), kRadius, Vec3(0), Vec3(0, 0, 10 * other));
        Stepper run(freeWorld(p, 1e-6), two);
        for (int n = 0; n < 20; ++n) run.step();
        const Vec3 a = run.now().spin[0], b = run.now().spin[1];
        if (other > 0) {
            CHECK(a == Vec3(0, 0, 10));
            CHECK(b == Vec3(0, 0, 10));
        } else {
            CHECK(a.z < 9.99);
            CHECK(near(a, -b, 10, 1e-13));  // equal and opposite couples
        }
    }
}
