// Rolling: down a slope, and held up by rolling friction.

#include <fmt/format.h>

#include "host/verify/cases.h"
#include "host/verify/setups.h"

namespace vkdose::verify {

namespace {

constexpr double kStiffness = 500;  // [N/m]

ContactParameters grippy(double rollingFriction) {
    ContactParameters p = spring(kStiffness, 0.02);
    p.mu = 2;
    p.kt = 0.5 * kStiffness;
    p.gammaT = 0.01;
    p.muR = rollingFriction;
    p.kr = 0.2 * kStiffness;
    p.gammaR = 0.01;
    return p;
}

Particles resting(const RuledWorld& world) {
    Particles p;
    p.add(Vec3(0, kRadius + massOf(kRadius) * world.gravity.y / kStiffness, 0), kRadius);
    return p;
}

}  // namespace

// Without slipping: acceleration 5/7 g sin(tilt).
void inclineRolls(Stage& stage) {
    const double tilt = kPi / 6, dt = 1e-5;
    const RuledWorld world = floor(grippy(0), dt, kGravity, tilt);
    Trial trial(stage, world, resting(world));
    trial.advance(2000);
    const double speed = 5.0 / 7 * kGravity * std::sin(tilt) * trial.halfStep();
    const Tolerance tolerance{2e-4, "tangential oscillation on the spring's stretch, lever a - delta/2"};
    stage.check("speed", "m/s", speed, trial.now().velocity[0].x, tolerance);
    stage.check("spin times radius", "m/s", speed, -trial.now().spin[0].z * kRadius, tolerance);
}

// Rolling friction bears a torque of at most a_r mu_r m g cos(tilt). Gravity turns the sphere about the contact with
// a m g sin(tilt). So the sphere starts to roll at tan(tilt) = (a_r/a) mu_r, with a_r = 2 a ("full") or a ("half").
// Beyond that it accelerates at 5/7 g (sin(tilt) - (a_r/a) mu_r cos(tilt)).
void rollingResistance(Stage& stage) {
    const double friction = 0.1, dt = 1e-5;
    for (const RollingLever lever : {RollingLever::Full, RollingLever::Half}) {
        const double ratio = lever == RollingLever::Full ? 2 : 1;
        const std::string name = lever == RollingLever::Full ? "full" : "half";
        for (const double factor : {0.97, 1.2}) {
            const double tilt = std::atan(factor * ratio * friction);
            RuledWorld world = floor(grippy(friction), dt, kGravity, tilt);
            world.law.rollingLever = lever;
            Trial trial(stage, world, resting(world));
            trial.advance(3000);
            const Vec3 before = trial.now().velocity[0];
            trial.advance(3000);
            const double gained = (trial.now().velocity[0].x - before.x) / (3000 * dt);
            const double steepness = kGravity * std::sin(tilt);
            const double expected =
                factor < 1 ? 0 : 5.0 / 7 * (steepness - ratio * friction * kGravity * std::cos(tilt));
            stage.check(fmt::format("acceleration at {:.2f} of the tilt that starts it, {} lever", factor, name),
                        "m/s2", expected, gained,
                        {2e-4, "oscillation of the springs, in units of g sin(tilt)", steepness});
        }
    }
}

}  // namespace vkdose::verify
