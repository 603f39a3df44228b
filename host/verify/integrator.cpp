// The time step itself: free flight, one contact with gravity, and how the error falls with the step.

#include <fmt/format.h>

#include "host/verify/cases.h"
#include "host/verify/setups.h"

namespace vkdose::verify {

// y = y0 - g t^2/2 and v = -g t, which the leapfrog renders exactly.
void freeFall(Stage& stage) {
    RuledWorld world = space(spring(1000), 1e-5);
    world.gravity = Vec3(0, -kGravity, 0);
    Particles one;
    const Vec3 start(0.3, 0.4, -0.2), push(0.05, 0, -0.02);
    one.add(start, kRadius, push);
    Trial trial(stage, world, one);
    trial.advance(2000);
    const double t = trial.time(), fall = kGravity * t * t / 2;
    const Tolerance tolerance{1e-6, "g and the time step are rounded to single precision"};
    stage.check("way fallen", "m", fall, start.y - trial.now().position[0].y, tolerance);
    stage.check("speed", "m/s", kGravity * trial.halfStep(), -trial.now().velocity[0].y, tolerance);
    const double drift = glm::length(push) * t;
    stage.check("sideways drift", "m", drift, glm::length((trial.now().position[0] - start) * Vec3(1, 0, 1)),
                {1e-6, "rounding"});
}

namespace {

/// Overlap of a sphere that met the floor at t = 0 with speed `v`: m d'' = m g - k d - gamma d'.
struct Landing {
    double m, k, gamma, v;
    double decay() const { return gamma / (2 * m); }
    double frequency() const { return std::sqrt(k / m - decay() * decay()); }
    double overlap(double t) const {
        const double rest = m * kGravity / k, w = frequency();
        const double a = -rest, b = (v + decay() * a) / w;
        return rest + std::exp(-decay() * t) * (a * std::cos(w * t) + b * std::sin(w * t));
    }
    double rate(double t) const {
        const double rest = m * kGravity / k, w = frequency();
        const double a = -rest, b = (v + decay() * a) / w;
        return std::exp(-decay() * t) *
               ((b * w - decay() * a) * std::cos(w * t) - (a * w + decay() * b) * std::sin(w * t));
    }
};

}  // namespace

// Three stages in closed form: fall from h, the damped oscillator with gravity until the overlap is zero again,
// rebound.
void bounce(Stage& stage) {
    const double height = 1e-3, k = 2000, gamma = 0.035, dt = 1e-6;
    Particles one;
    one.add(Vec3(0, kRadius + height, 0), kRadius);
    Trial trial(stage, floor(spring(k, gamma), dt), one);

    const double fall = std::sqrt(2 * height / kGravity);
    const Landing landing{massOf(kRadius), k, gamma, kGravity * fall};
    const double halfPeriod = kPi / landing.frequency();
    const double deepest = root([&](double t) { return landing.rate(t); }, 0, halfPeriod);
    const double parting = root([&](double t) { return landing.overlap(t); }, deepest, 1.5 * halfPeriod);
    const double rebound = -landing.rate(parting);

    const Sensors sensors = trial.advanceTo(fall + 2 * parting);
    const double share = gamma / massOf(kRadius) * dt;
    const Tolerance tolerance{share, "damping sets in and ends within a step: gamma dt/m"};
    stage.check("deepest overlap", "m", landing.overlap(deepest), sensors.maxOverlapRatio * kRadius, tolerance);
    const double up = rebound - kGravity * (trial.halfStep() - fall - parting);
    stage.check("speed after the contact", "m/s", up, trial.now().velocity[0].y, tolerance);
    trial.advanceTo(fall + parting + rebound / kGravity);
    stage.check("height of the rebound", "m", rebound * rebound / (2 * kGravity), trial.now().position[0].y - kRadius,
                {2 * share, "twice that of the speed"});
}

namespace {

/// A sphere on the floor that never leaves it: the error of its height after `periods` periods of `perPeriod` steps, in
/// amplitudes. Strong gravity makes the overlap at rest large enough for an oscillation within it.
double oscillatorError(Stage& stage, double gamma, double perPeriod, double periods) {
    const double k = 5000, m = massOf(kRadius), decay = gamma / (2 * m);
    const double w = std::sqrt(k / m - decay * decay);
    const double gravity = 0.01 * kRadius * k / m, rest = m * gravity / k, amplitude = rest / 2;
    Particles one;
    one.add(Vec3(0, kRadius - rest + amplitude, 0), kRadius);
    Trial trial(stage, floor(spring(k, gamma), 2 * kPi / w / perPeriod, gravity), one);
    trial.advance(static_cast<std::uint64_t>(std::llround(periods * perPeriod)));
    const double t = trial.time();
    const double exact =
        kRadius - rest + amplitude * std::exp(-decay * t) * (std::cos(w * t) + decay / w * std::sin(w * t));
    return (trial.now().position[0].y - exact) / amplitude;
}

void checkOrder(Stage& stage, double gamma, double order, int coarsest, const std::string& why) {
    // The sphere is a quarter period past the turning point. The height changes fastest there, so that it shows the
    // phase.
    double before = oscillatorError(stage, gamma, coarsest, 3.25);
    for (const int finer : {2 * coarsest, 4 * coarsest}) {
        const double now = oscillatorError(stage, gamma, finer, 3.25);
        stage.check(fmt::format("order, from T/{} to T/{}", finer / 2, finer), "-", order, std::log2(before / now),
                    {0.06, why, 1});
        before = now;
    }
}

}  // namespace

// Without damping the leapfrog is of second order: half the step gives a quarter of the error.
void elasticOrder(Stage& stage) {
    checkOrder(stage, 0, 2, 48, "terms of the next order at these steps; rounding is far below");
}

// Damping is computed from the velocity half a step back: the scheme decays by sqrt(1 - gamma dt/m) a step instead of
// exp(-gamma dt/2m), an error of first order.
void dampedOrder(Stage& stage) {
    checkOrder(stage, 0.04, 1, 96, "terms of the next order at these steps");
}

}  // namespace vkdose::verify
