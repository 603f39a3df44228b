// Sliding friction under gravity: a sphere that slips until it rolls, and one that always slips.

#include "host/verify/cases.h"
#include "host/verify/setups.h"

namespace vkdose::verify {

namespace {

constexpr double kStiffness = 500;  // soft, so that steps are long; the sphere sinks in by 2e-4 radii [N/m]

ContactParameters rough(double mu) {
    ContactParameters p = spring(kStiffness, 0.02);
    p.mu = mu;
    p.kt = 0.5 * kStiffness;
    p.gammaT = 0.01;
    return p;
}

/// Sphere at rest on the floor, as deep as its weight presses it.
Particles resting(const RuledWorld& world, double speed) {
    const double sinking = -massOf(kRadius) * world.gravity.y / kStiffness;
    Particles p;
    p.add(Vec3(0, kRadius - sinking, 0), kRadius, Vec3(speed, 0, 0));
    return p;
}

}  // namespace

// Friction mu m g brakes the sphere and spins it up, until after t = 2/7 u0/(mu g) it rolls with 5/7 of its speed.
void slipThenRoll(Stage& stage) {
    const double mu = 0.3, start = 0.1, dt = 1e-5;
    const RuledWorld world = floor(rough(mu), dt);
    Trial trial(stage, world, resting(world, start));
    const double rolls = 2.0 / 7 * start / (mu * kGravity);
    // The spring first stretches to mu m g/k_t. This takes the following part of the slipping.
    const double stretched = mu * massOf(kRadius) * kGravity / (0.5 * kStiffness) / (start * rolls);
    const Tolerance tolerance{stretched + 2e-4, "stretch of the tangential spring, time step", start};

    trial.advanceTo(rolls / 2);
    stage.check("speed half way", "m/s", start - mu * kGravity * trial.halfStep(), trial.now().velocity[0].x,
                tolerance);
    double ended = 0;
    while (ended == 0 && trial.time() < 2 * rolls) {
        trial.advance(5);
        const double surface = trial.now().velocity[0].x + kRadius * trial.now().spin[0].z;
        if (surface < 0) ended = trial.halfStep();
    }
    stage.check("mu g t/u0 when slipping ends", "-", 2.0 / 7, mu * kGravity * ended / start,
                {5e-3, "looked at every 5 of 970 steps", 2.0 / 7});
    trial.advanceTo(2 * rolls);
    stage.check("speed of rolling", "m/s", 5.0 / 7 * start, trial.now().velocity[0].x, tolerance);
    stage.check("surface speed of rolling", "m/s", 5.0 / 7 * start, -trial.now().spin[0].z * kRadius, tolerance);
}

// On a slope with tan(tilt) > 7/2 mu: acceleration g (sin - mu cos), spin 5/2 mu g cos t/a.
void inclineSlides(Stage& stage) {
    const double mu = 0.2, tilt = kPi / 4, dt = 1e-5;
    const RuledWorld world = floor(rough(mu), dt, kGravity, tilt);
    Trial trial(stage, world, resting(world, 0));
    trial.advance(1000);  // the spring stretches first
    const Particles early = trial.now();
    trial.advance(2000);
    const double seconds = 2000 * dt;
    const double speed = kGravity * (std::sin(tilt) - mu * std::cos(tilt)) * seconds;
    const double surface = 2.5 * mu * kGravity * std::cos(tilt) * seconds;
    const Tolerance tolerance{2e-4, "lever a - delta/2, rounding"};
    stage.check("speed gained", "m/s", speed, trial.now().velocity[0].x - early.velocity[0].x, tolerance);
    stage.check("spin gained, times radius", "m/s", surface, (early.spin[0].z - trial.now().spin[0].z) * kRadius,
                tolerance);
}

// An adhesive sphere on the floor is pressed in by m g/k1. Friction is mu m g with the limit on |f_n|. With Luding's
// limit, which starts from the adhesive branch, it is (1 + k_c/k1) times that.
void coulombLimit(Stage& stage) {
    const double mu = 0.1, dt = 1e-5, chi = 2;
    ContactParameters p = rough(mu);
    p.k2Max = 2 * kStiffness;
    p.kc = chi * kStiffness;
    p.plasticityDepth = 0.05;
    for (const CoulombLimit limit : {CoulombLimit::Luding, CoulombLimit::Absolute}) {
        RuledWorld world = floor(p, dt);
        world.law.limitFriction(limit);
        Trial trial(stage, world, resting(world, 0.2));
        trial.advance(200);  // the spring stretches first
        const double before = trial.now().velocity[0].x;
        trial.advance(1000);
        const bool luding = limit == CoulombLimit::Luding;
        stage.check(luding ? "deceleration, limit \"luding\"" : "deceleration, limit \"absolute\"", "m/s2",
                    mu * kGravity * (luding ? 1 + chi : 1), (before - trial.now().velocity[0].x) / (1000 * dt),
                    {8e-4, "mu g dt is rounded to the last bit of a single-precision velocity, 660 of them"});
    }
}

}  // namespace vkdose::verify
