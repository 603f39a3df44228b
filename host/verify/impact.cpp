#include "host/verify/impact.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace vkdose::verify {

namespace {

constexpr double kPi = 3.14159265358979323846;

double inverseSum(double a, double b) {
    return 1 / (a + b);
}

/// What both bodies make together.
struct Pair {
    double modulus, shear, radius, mass;  ///< effective ones

    Pair(const Striker& a, const Striker& b)
        : modulus(inverseSum((1 - a.poisson * a.poisson) / a.modulus, (1 - b.poisson * b.poisson) / b.modulus)),
          shear(inverseSum(2 * (2 - a.poisson) * (1 + a.poisson) / a.modulus,
                           2 * (2 - b.poisson) * (1 + b.poisson) / b.modulus)),
          radius(inverseSum(1 / a.radius, 1 / b.radius)),
          mass(inverseSum(1 / a.mass, 1 / b.mass)) {}
};

/// Overlap, its rate, stretch of the sliding spring, and the motions of both.
enum Place : std::size_t { kOverlap, kRate, kStretch, kUpperAlong, kUpperSpin, kLowerAlong, kLowerSpin, kPlaces };
using State = std::array<double, kPlaces>;

struct Model {
    Striker upper, lower;
    Pair pair{upper, lower};
    double damping = 0;  ///< 2 sqrt(5/6) beta
    double friction = 0;

    static double lever(const Striker& s, double overlap) { return std::isinf(s.radius) ? 0 : s.radius - overlap / 2; }
    double slip(const State& s) const {
        return s[kUpperAlong] + s[kUpperSpin] * lever(upper, s[kOverlap]) - s[kLowerAlong] +
               s[kLowerSpin] * lever(lower, s[kOverlap]);
    }
    double patch(const State& s) const { return std::sqrt(pair.radius * std::max(s[kOverlap], 0.0)); }
    double hertz(const State& s) const { return 4.0 / 3.0 * pair.modulus * patch(s) * std::max(s[kOverlap], 0.0); }
    double tangentStiffness(const State& s) const { return 8 * pair.shear * patch(s); }
    double tangent(const State& s) const {
        const double k = tangentStiffness(s), limit = friction * hertz(s);
        const double trial = -k * s[kStretch] - damping * std::sqrt(k * pair.mass) * slip(s);
        return std::clamp(trial, -limit, limit);
    }
    State rates(const State& s) const {
        const double f = tangent(s);
        const auto turning = [&](const Striker& b) {  // torque over moment of inertia, of a full sphere
            return std::isinf(b.mass) ? 0 : lever(b, s[kOverlap]) * f / (0.4 * b.mass * b.radius * b.radius);
        };
        State r{};
        r[kOverlap] = s[kRate];
        r[kRate] = -(hertz(s) + damping * std::sqrt(2 * pair.modulus * patch(s) * pair.mass) * s[kRate]) / pair.mass;
        r[kStretch] = slip(s);
        r[kUpperAlong] = f / upper.mass;
        r[kLowerAlong] = -f / lower.mass;
        r[kUpperSpin] = turning(upper);
        r[kLowerSpin] = turning(lower);
        return r;
    }
};

State moved(const State& s, const State& rates, double dt) {
    State next = s;
    for (std::size_t i = 0; i < kPlaces; ++i) next[i] += dt * rates[i];
    return next;
}

State step(const Model& model, const State& s, double dt) {
    const State a = model.rates(s), b = model.rates(moved(s, a, dt / 2)), c = model.rates(moved(s, b, dt / 2)),
                d = model.rates(moved(s, c, dt));
    State next = s;
    for (std::size_t i = 0; i < kPlaces; ++i) next[i] += dt / 6 * (a[i] + 2 * b[i] + 2 * c[i] + d[i]);
    // A spring that gets stiffer exerts what it did; one that gets softer keeps its length.
    if (next[kOverlap] > s[kOverlap]) next[kStretch] *= std::sqrt(std::max(s[kOverlap], 0.0) / next[kOverlap]);
    // A slider that slips leaves on the spring what it bears.
    const double k = model.tangentStiffness(next), limit = model.friction * model.hertz(next);
    const double trial = -k * next[kStretch] - model.damping * std::sqrt(k * model.pair.mass) * model.slip(next);
    if (k > 0 && std::abs(trial) > limit) next[kStretch] = -std::copysign(limit, trial) / k;
    return next;
}

}  // namespace

AfterImpact impactOf(const Striker& upper, const Striker& lower, double restitution, double friction, double towards) {
    const double fade = -std::log(restitution);
    const Pair pair(upper, lower);
    const Model model{upper, lower, pair, 2 * std::sqrt(5.0 / 6.0) * fade / std::hypot(kPi, fade), friction};
    const double deepest =
        std::pow(15.0 / 16.0 * pair.mass * towards * towards / (pair.modulus * std::sqrt(pair.radius)), 0.4);
    const double dt = 2.943275 * deepest / towards / 20000;
    State s{0, towards, 0, upper.along, upper.spin, lower.along, lower.spin};
    do {
        s = step(model, s, dt);
    } while (s[kOverlap] > 0);
    return {-s[kRate], s[kUpperAlong], s[kUpperSpin], s[kLowerAlong], s[kLowerSpin]};
}

}  // namespace vkdose::verify
