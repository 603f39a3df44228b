#pragma once
// Two equal spheres that meet head on under the adhesive law without damping: set-up and closed forms.

#include <cmath>
#include <vector>

#include "host/verify/setups.h"

namespace vkdose::verify {

inline constexpr double kFar = 0.02;  // between scenes that share a world [m]

/// The paper's normal parameters.
inline ContactParameters plastic(double kc, double gamma) {
    ContactParameters p = spring(kK2Max, gamma);
    p.k1 = kK1;
    p.kc = kc;
    p.plasticityDepth = kPlasticity;
    return p;
}

/// Two equal spheres for every relative speed, about to touch along x.
inline Particles pairsAt(const std::vector<double>& speeds) {
    Particles p;
    for (std::size_t i = 0; i < speeds.size(); ++i) {
        const Vec3 middle(0, kFar * static_cast<double>(i), 0), half(kRadius, 0, 0);
        p.add(middle - half, kRadius, Vec3(speeds[i] / 2, 0, 0));
        p.add(middle + half, kRadius, Vec3(-speeds[i] / 2, 0, 0));
    }
    return p;
}

inline double partingSpeed(const Particles& p, std::size_t pair) {
    return p.velocity[2 * pair + 1].x - p.velocity[2 * pair].x;
}

/// Restitution of two equal spheres under the adhesive law without damping. Loading to delta_max costs
/// E = k1 delta_max^2/2. The unloading line returns E/kappa. The way out along -k_c delta costs
/// E chi (kappa - 1)^2/(kappa (kappa + chi)), with kappa = k2/k1 and chi = k_c/k1. If nothing is left, the spheres
/// stick.
struct HeadOn {
    double reducedMass = massOf(kRadius) / 2;
    double limit = kK2Max / (kK2Max - kK1) * kPlasticity * kRadius;  ///< delta* of equal spheres [m]
    double kc = 0;

    double restitutionSquared(double speed) const {
        const double deepest = speed * std::sqrt(reducedMass / kK1);
        const double kappa = 1 + (kK2Max / kK1 - 1) * deepest / limit, chi = kc / kK1;
        return 1 / kappa - chi * (kappa - 1) * (kappa - 1) / (kappa * (kappa + chi));
    }
    /// Where kappa = 2 + 1/chi.
    double stickingSpeed() const {
        const double chi = kc / kK1;
        return (1 + 1 / chi) / (kK2Max / kK1 - 1) * limit * std::sqrt(kK1 / reducedMass);
    }

    /// Overlaps between which a pair that sticks swings for good [m]. The pair turns back on the adhesive branch at
    /// `low`, where the energy is used up. From then on it moves on the unloading line through that point: delta_max
    /// has shrunk until k2 (delta - delta_0) = -k_c delta there, with k2 - k1 = slope delta_max.
    struct Swing {
        double low, high, remembered;
    };
    Swing swing(double speed) const {
        const double slope = (kK2Max - kK1) / limit, deepest = speed * std::sqrt(reducedMass / kK1);
        const double k2 = kK1 + slope * deepest, rest = (1 - kK1 / k2) * deepest, meets = k2 * rest / (k2 + kc);
        const double left = kK1 * deepest * deepest * kK1 / k2 - k2 * (rest - meets) * (rest - meets);
        const double low = std::sqrt(meets * meets - left / kc);
        const double remembered = (low + std::sqrt(low * low + 4 * low * (kK1 + kc) / slope)) / 2;
        const double middle = (1 - kK1 / (kK1 + slope * remembered)) * remembered;
        return {low, 2 * middle - low, remembered};
    }
};

}  // namespace vkdose::verify
