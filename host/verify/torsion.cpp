// Torsion: a sphere that spins about the normal of the floor.

#include "host/verify/cases.h"
#include "host/verify/setups.h"

namespace vkdose::verify {

// The twisting speed is lever times omega, and lever times the force brakes it. A sphere that slips loses lever mu_to m
// g/I of omega a second. One that sticks is a damped oscillator of stiffness lever^2 k_to and damping lever^2 gamma_to
// on I. There is one sphere of each kind.
void spinDecay(Stage& stage) {
    const double k = 500, friction = 0.1, dt = 2e-6, lever = 2 * kRadius, m = massOf(kRadius);
    ContactParameters p = spring(k, 0.02);
    p.muTo = friction;
    p.kTo = 0.2 * k;
    p.gammaTo = 2e-3;
    const double inertia = inertiaOf(kRadius), braking = lever * friction * m * kGravity / inertia;
    const double decay = lever * lever * p.gammaTo / (2 * inertia);
    const double w = std::sqrt(lever * lever * p.kTo / inertia - decay * decay);
    // This speed makes half of the twist at which the spring would slip.
    const double small = 0.5 * friction * m * kGravity / p.kTo / lever * w;
    const double large = braking * 10e-3;

    Particles two;
    const double height = kRadius - m * kGravity / k;
    two.add(Vec3(0, height, 0), kRadius, Vec3(0), Vec3(0, large, 0));
    two.add(Vec3(0.02, height, 0), kRadius, Vec3(0), Vec3(0, small, 0));
    Trial trial(stage, floor(p, dt), two);

    trial.advanceTo(2.1 * 2 * kPi / w);
    const double t = trial.halfStep();
    const double sticking = small * std::exp(-decay * t) * (std::cos(w * t) - decay / w * std::sin(w * t));
    // Phase error of the leapfrog, decay error of its half-step damping.
    const double share = w * t * (w * dt) * (w * dt) / 24 + decay * t * decay * dt + 1e-3;
    stage.check("spin of the oscillation after 2.1 periods", "rad/s", sticking, trial.now().spin[1].y,
                {share, "phase (omega dt)^2/24, decay gamma dt/2m of the scheme", small});
    trial.advanceTo(5e-3);
    stage.check("spin while slipping, half way", "rad/s", large - braking * trial.halfStep(), trial.now().spin[0].y,
                {1e-3, "stretching the spring to its limit takes one step of 1000", large});
    trial.advanceTo(15e-3);
    stage.check("spin in the end", "rad/s", 0, trial.now().spin[0].y,
                {1e-3, "what the damped oscillation leaves", large});
}

}  // namespace vkdose::verify
