#include "host/model/normal_law.h"

#include <algorithm>
#include <cmath>

#include "host/model/jkr.h"
#include "host/model/restitution.h"

namespace vkdose {
namespace {

/// Shear modulus of a material over its share of the compliance of a contact [Pa]: G/(2 - nu).
double shear(const Elasticity& m) {
    return m.modulus / (2 * (1 + m.poisson) * (2 - m.poisson));
}

double plainStrain(const Elasticity& m) {
    return m.modulus / (1 - m.poisson * m.poisson);
}

double inSeries(double a, double b) {
    return a * b / (a + b);
}

/// How much steeper the adhesive branch of EEPA can be than the unloading line at the same largest overlap, at least 1.
/// The pull P <= k2 delta_p^(3/2)/2 falls with the slope chi P/delta_min, which is steepest at the smallest delta_min.
double steepestBranch(const ContactParameters& p) {
    if (!(p.surfaceEnergy > 0)) return 1;
    return std::max(1.0, p.adhesionExponent / 1.5 * std::cbrt(p.plasticityRatio / 2));
}

/// From ratios to stiffnesses [N/m] and dampings [kg/s].
void scaleSliders(ContactParameters& p, double k, double gamma) {
    for (double ContactParameters::*stiffness :
         {&ContactParameters::kt, &ContactParameters::kr, &ContactParameters::kTo})
        p.*stiffness *= k;
    for (double ContactParameters::*damping :
         {&ContactParameters::gammaT, &ContactParameters::gammaR, &ContactParameters::gammaTo})
        p.*damping *= gamma;
}

/// Where the path from touch has taken the energy `motion` [J]: beyond the overlap of no load.
double overlapOfAdhesiveImpact(const JkrContact& contact, double motion) {
    const double all = contact.energy(0) + motion;
    double low = contact.overlapUnder(0), high = low;
    for (double way = contact.size * 1e-9; contact.energy(high) < all; way *= 2) high = low + way;
    for (int i = 0; i < 100; ++i) {
        const double middle = (low + high) / 2;
        (contact.energy(middle) < all ? low : high) = middle;
    }
    return high;
}

}  // namespace

ContactParameters hertzMindlin(const Elasticity& a, const Elasticity& b, double restitution,
                               const ContactParameters& rest) {
    ContactParameters p = rest;
    p.law = NormalLaw::HertzMindlin;
    p.modulus = inSeries(plainStrain(a), plainStrain(b));
    p.dampingShare = dampingRatioFor(restitution);
    // Mindlin's 8 G* sqrt(R* delta) over Hertz's 2 E* sqrt(R* delta). Each direction is damped as by Tsuji (1992), with
    // the root of its own stiffness.
    p.kt = 4 * inSeries(shear(a), shear(b)) / p.modulus;
    p.gammaT = std::sqrt(p.kt);
    return p;
}

ContactParameters elastoPlasticAdhesive(const Elasticity& a, const Elasticity& b, double restitution,
                                        const ContactParameters& rest) {
    ContactParameters p = hertzMindlin(a, b, restitution, rest);
    p.law = NormalLaw::Eepa;
    return p;
}

ContactParameters elasticAdhesive(const Elasticity& a, const Elasticity& b, double restitution,
                                  const ContactParameters& rest) {
    ContactParameters p = hertzMindlin(a, b, restitution, rest);
    p.law = NormalLaw::Jkr;
    return p;
}

double hertzStiffness(const ContactParameters& p, double reduced, double overlap) {
    return 2 * p.modulus * std::sqrt(reduced / 2 * overlap);
}

ContactParameters linearised(const ContactParameters& p, double mass, double reduced, double overlap) {
    if (p.law == NormalLaw::Luding) return p;
    if (p.law == NormalLaw::User) {
        ContactParameters linear = p;
        linear.law = NormalLaw::Luding;
        scaleSliders(linear, p.k2Max, p.gamma);
        return linear;
    }
    const double k = p.law == NormalLaw::Jkr ? 2 * p.modulus * JkrContact(p, reduced).radius(overlap)
                                             : hertzStiffness(p, reduced, overlap);
    const double gamma = kHertzDamping * p.dampingShare * std::sqrt(k * mass);
    ContactParameters linear = p;
    linear.law = NormalLaw::Luding;
    linear.k1 = linear.k2Max = k;
    if (p.law == NormalLaw::Eepa) linear.k2Max = k / (1 - p.plasticityRatio) * steepestBranch(p);
    linear.gamma = gamma;
    scaleSliders(linear, k, gamma);
    return linear;
}

double reachOf(const ContactParameters& p, double reduced) {
    if (p.law == NormalLaw::User) return p.reach;
    return p.law == NormalLaw::Jkr ? JkrContact(p, reduced).reach : 0;
}

double longestReach(const World& world, const ContactLaw& law, double largest) {
    double longest = 0;
    for (const MaterialPair& pair : occurringPairs(world))
        longest = std::max(longest, reachOf(law.of(pair), 2 * largest));
    return longest;
}

double overlapUnder(const ContactParameters& p, double reduced, double load) {
    if (p.law == NormalLaw::Luding || p.law == NormalLaw::User) return load / p.k1;
    if (p.law == NormalLaw::Jkr) return JkrContact(p, reduced).overlapUnder(load);
    if (p.law == NormalLaw::Eepa) load += p.constantPull;
    return std::pow(load / (4.0 / 3.0 * p.modulus * std::sqrt(reduced / 2)), 2.0 / 3.0);
}

double overlapOfImpact(const ContactParameters& p, double mass, double reduced, double speed) {
    if (p.law == NormalLaw::Luding || p.law == NormalLaw::User) return speed * std::sqrt(mass / p.k1);
    if (p.law == NormalLaw::Jkr) return overlapOfAdhesiveImpact(JkrContact(p, reduced), mass * speed * speed / 2);
    const double modulus = p.modulus * std::sqrt(reduced / 2);
    double overlap = std::pow(15.0 / 16.0 * mass * speed * speed / modulus, 0.4);
    if (p.law == NormalLaw::HertzMindlin || p.constantPull == 0) return overlap;
    // 8/15 E* sqrt(R*) delta^(5/2) = m v^2/2 + pull delta: each turn leaves at most 0.4 of the error in ln delta.
    constexpr int kTurns = 45;
    for (int i = 0; i < kTurns; ++i)
        overlap = std::pow(15.0 / 8.0 * (mass * speed * speed / 2 + p.constantPull * overlap) / modulus, 0.4);
    return overlap;
}

}  // namespace vkdose
