#pragma once
// A head-on impact of two spheres, integrated.

#include <algorithm>
#include <cmath>

#include "host/law/law.h"

namespace vkdose {

/// The restitution that a share zeta of critical damping gives: exp(-pi zeta/sqrt(1 - zeta^2)), 0 if overdamped.
double restitutionOf(double zeta);
/// The share zeta of critical damping at which damping alone gives the restitution e, 0 < e <= 1.
double dampingRatioFor(double e);

struct ImpactMotion {
    double overlap, speed;  ///< speed > 0: the overlap grows
};

/// One step of Runge and Kutta's fourth-order rule.
template <class Acceleration>
ImpactMotion steppedBy(ImpactMotion now, double dt, const Acceleration& acceleration) {
    const auto moved = [&](ImpactMotion rate, double share) {
        return ImpactMotion{now.overlap + share * dt * rate.overlap, now.speed + share * dt * rate.speed};
    };
    const auto rateAt = [&](ImpactMotion at) { return ImpactMotion{at.speed, acceleration(at)}; };
    const ImpactMotion a = rateAt(now), b = rateAt(moved(a, 0.5)), c = rateAt(moved(b, 0.5)), d = rateAt(moved(c, 1));
    return {now.overlap + dt / 6 * (a.overlap + 2 * b.overlap + 2 * c.overlap + d.overlap),
            now.speed + dt / 6 * (a.speed + 2 * b.speed + 2 * c.speed + d.speed)};
}

/// Restitution of an impact at `speed` [m/s] that parts where the overlap is minus the law's reach; 0 if the spheres
/// stick. `force(overlap, before)` is the law's, without damping [N]; `before` is the motion at the step's beginning.
template <class Force>
double followedImpact(const ContactParameters& p, double mass, double reduced, double speed, const Force& force) {
    const Law& law = normalLaw(p);
    const double reach = law.reach(p, reduced), deepest = law.overlapOfImpact(p, mass, reduced, speed);
    // 1/1500 of the fastest of the impact's times.
    const double swing = std::sqrt(mass / law.linearised(p, mass, reduced, deepest).k2Max);
    const double dt = std::min(swing, deepest / speed) / 1500;
    constexpr int kMostSteps = 1000000;
    ImpactMotion now{0, speed};
    for (int i = 0; i < kMostSteps; ++i) {
        const ImpactMotion next = steppedBy(now, dt, [&](ImpactMotion at) {
            const double overlap = std::max(-reach, at.overlap);
            return -(force(overlap, now) + law.linearised(p, mass, reduced, overlap).gamma * at.speed) / mass;
        });
        if (next.overlap <= -reach) {
            const double share = (now.overlap + reach) / (now.overlap - next.overlap);
            return -(now.speed + share * (next.speed - now.speed)) / speed;
        }
        if (now.speed < 0 && next.speed >= 0) break;  // pulled back: it swings, and sticks
        now = next;
    }
    return 0;
}

}  // namespace vkdose
