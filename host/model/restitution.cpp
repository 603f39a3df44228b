#include "host/model/restitution.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "host/core/vec.h"
#include "host/model/eepa.h"
#include "host/model/jkr.h"
#include "host/model/normal_law.h"
#include "host/model/stability.h"

namespace vkdose {
namespace {

double ofDampingRatio(double zeta) {
    return zeta < 1 ? std::exp(-kPi * zeta / std::sqrt(1 - zeta * zeta)) : 0;
}

struct Motion {
    double overlap, speed;  ///< speed > 0: the overlap grows
};

/// One step of Runge and Kutta's fourth-order rule.
template <class Acceleration>
Motion steppedBy(Motion now, double dt, const Acceleration& acceleration) {
    const auto moved = [&](Motion rate, double share) {
        return Motion{now.overlap + share * dt * rate.overlap, now.speed + share * dt * rate.speed};
    };
    const auto rateAt = [&](Motion at) { return Motion{at.speed, acceleration(at)}; };
    const Motion a = rateAt(now), b = rateAt(moved(a, 0.5)), c = rateAt(moved(b, 0.5)), d = rateAt(moved(c, 1));
    return {now.overlap + dt / 6 * (a.overlap + 2 * b.overlap + 2 * c.overlap + d.overlap),
            now.speed + dt / 6 * (a.speed + 2 * b.speed + 2 * c.speed + d.speed)};
}

/// A head-on impact on one line of the law, force = slope (overlap - rest), with damping.
struct Line {
    double slope, rest, gamma, mass;

    Motion stepped(Motion now, double dt) const {
        return steppedBy(now, dt, [&](Motion m) { return -(slope * (m.overlap - rest) + gamma * m.speed) / mass; });
    }

    /// A hundredth of the fastest of the line's times; `way` is the time that the motion takes at its present speed.
    double step(double way) const {
        const double swing = slope == 0 ? way : std::sqrt(mass / std::abs(slope));
        return 1e-2 * std::min({swing, gamma > 0 ? mass / gamma : swing, way});
    }

    /// The motion until `left` of it has fallen to zero; what the last step goes too far is taken back along its chord.
    /// A motion that takes longer than kMostSteps creeps; it is given back as it is then.
    template <class Left>
    Motion followed(Motion now, double dt, const Left& left) const {
        constexpr int kMostSteps = 100000;
        for (int i = 0; i < kMostSteps && left(now) > 0; ++i) {
            const Motion next = stepped(now, dt);
            const double before = left(now), after = left(next);
            if (after <= 0) return stepped(now, dt * before / (before - after));
            now = next;
        }
        return now;
    }
};

/// Restitution of an impact with plasticity: the lines of physics.md, "Contact law", one after the other.
double plasticImpact(const ContactParameters& p, double mass, double reduced, double speed) {
    constexpr double kUnbounded = std::numeric_limits<double>::infinity();
    const double limit = p.k2Max / (p.k2Max - p.k1) * p.plasticityDepth * reduced;  // delta*
    const auto speedLeft = [](Motion m) { return m.speed; };
    const Line loading{p.k1, 0, p.gamma, mass}, beyond{p.k2Max, (1 - p.k1 / p.k2Max) * limit, p.gamma, mass};
    Motion m = loading.followed({0, speed}, loading.step(limit > 0 ? limit / speed : kUnbounded),
                                [&](Motion now) { return std::min(now.speed / speed, 1 - now.overlap / limit); });
    if (m.overlap > 0.999999 * limit && m.speed > 0) m = beyond.followed(m, beyond.step(kUnbounded), speedLeft);

    const double acting = std::min(m.overlap, limit);
    const double k2 = p.k1 + (p.k2Max - p.k1) * acting / limit, rest = (1 - p.k1 / k2) * acting;
    const Line unloading{k2, rest, p.gamma, mass}, adhesive{-p.kc, 0, p.gamma, mass};
    const double meets = k2 * rest / (k2 + p.kc);
    // Pulled back before the adhesive branch, the sphere swings: it sticks.
    m = unloading.followed({m.overlap, 0}, unloading.step(kUnbounded),
                           [&](Motion now) { return now.speed > 0 ? 0 : now.overlap - meets; });
    // It ends where the overlap does, or where the speed does: the two stick.
    const double creep = 1e-6 * speed;
    if (m.speed < -creep && m.overlap > 0)
        m = adhesive.followed(m, adhesive.step(-m.overlap / m.speed),
                              [&](Motion now) { return now.speed < -creep ? now.overlap : 0.0; });
    return m.speed < -creep && m.overlap < 1e-3 * meets + 1e-12 * limit ? -m.speed / speed : 0;
}

/// Restitution of an impact that parts at the overlap -reach [m]. `force(overlap)` is the law's, without damping [N];
/// 0 if the spheres stick.
template <class Force>
double followedImpact(const ContactParameters& p, double mass, double reduced, double speed, double reach,
                      const Force& force) {
    // 1/1500 of the fastest of the impact's times.
    const double deepest = overlapOfImpact(p, mass, reduced, speed);
    const double swing = std::sqrt(mass / linearised(p, mass, reduced, deepest).k2Max);
    const double dt = std::min(swing, deepest / speed) / 1500;
    constexpr int kMostSteps = 1000000;
    Motion now{0, speed};
    for (int i = 0; i < kMostSteps; ++i) {
        const Motion next = steppedBy(now, dt, [&](Motion at) {
            const double overlap = std::max(-reach, at.overlap);
            return -(force(overlap, now) + linearised(p, mass, reduced, overlap).gamma * at.speed) / mass;
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

/// Restitution of an impact under EEPA.
double eepaImpact(const ContactParameters& p, double mass, double reduced, double speed) {
    double largest = 0;
    return followedImpact(p, mass, reduced, speed, 0, [&](double overlap, const Motion& before) {
        largest = std::max(largest, before.overlap);
        return eepaPath(p, reduced, std::max(largest, overlap)).force(overlap);
    });
}

/// Restitution of an impact under JKR.
double jkrImpact(const ContactParameters& p, double mass, double reduced, double speed) {
    const JkrContact contact(p, reduced);
    return followedImpact(p, mass, reduced, speed, contact.reach,
                          [&](double overlap, const Motion& /*before*/) { return contact.force(overlap); });
}

/// The limit of slow impacts under EEPA. A constant pull holds them. Else the law has no scale of its own there,
/// because the pull is as strong as it can be.
double slowEepaImpact(ContactParameters p, double mass, double reduced) {
    if (p.constantPull > 0) return 0;
    if (p.surfaceEnergy > 0) p.surfaceEnergy = std::numeric_limits<double>::max();
    const double overlap = 1e-6 * reduced;
    return eepaImpact(p, mass, reduced, overlap * std::sqrt(hertzStiffness(p, reduced, overlap) / mass));
}

}  // namespace

double reducedSize(double a, double b) {
    return std::isinf(b) ? 2 * a : 2 * a * b / (a + b);
}

double dampingRatioFor(double e) {
    const double log = std::log(e);
    return -log / std::hypot(kPi, log);
}

double restitution(const ContactParameters& p, double mass) {
    if (p.law == NormalLaw::HertzMindlin || p.law == NormalLaw::Eepa || p.law == NormalLaw::Jkr)
        return ofDampingRatio(p.dampingShare);
    return ofDampingRatio(p.gamma / (2 * std::sqrt(p.k1 * mass)));
}

double restitution(const ContactParameters& p, double density, double a, double b) {
    return restitution(p, reducedMass(density, a, b));
}

double dampingFor(double e, const ContactParameters& p, double mass) {
    return 2 * dampingRatioFor(e) * std::sqrt(p.k1 * mass);
}

double dampingFor(double e, const ContactParameters& p, double density, double a, double b) {
    return dampingFor(e, p, reducedMass(density, a, b));
}

double restitutionAt(const ContactParameters& p, double mass, double reduced, double speed) {
    if (p.law == NormalLaw::HertzMindlin) return ofDampingRatio(p.dampingShare);
    if (p.law == NormalLaw::Eepa)
        return speed > 0 ? eepaImpact(p, mass, reduced, speed) : slowEepaImpact(p, mass, reduced);
    if (p.law == NormalLaw::Jkr && p.surfaceEnergy == 0) return ofDampingRatio(p.dampingShare);
    if (p.law == NormalLaw::Jkr) return speed > 0 ? jkrImpact(p, mass, reduced, speed) : 0;
    const double zeta = p.gamma / (2 * std::sqrt(p.k1 * mass));
    if (p.law == NormalLaw::User) return ofDampingRatio(zeta);
    if (!(zeta < 1) || !std::isfinite(p.k2Max + p.kc + p.plasticityDepth)) return 0;
    // With one stiffness the loss does not depend on the speed.
    if (!(speed > 0) || !(p.k2Max > p.k1) || !(p.plasticityDepth > 0)) return ofDampingRatio(zeta);
    return plasticImpact(p, mass, reduced, speed);
}

}  // namespace vkdose
