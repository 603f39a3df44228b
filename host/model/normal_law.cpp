#include "host/model/normal_law.h"

#include <cmath>

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

double hertzStiffness(const ContactParameters& p, double reduced, double overlap) {
    return 2 * p.modulus * std::sqrt(reduced / 2 * overlap);
}

ContactParameters linearised(const ContactParameters& p, double mass, double reduced, double overlap) {
    if (p.law == NormalLaw::Luding) return p;
    const double k = hertzStiffness(p, reduced, overlap);
    const double gamma = kHertzDamping * p.dampingShare * std::sqrt(k * mass);
    ContactParameters linear = p;
    linear.law = NormalLaw::Luding;
    linear.k1 = linear.k2Max = k;
    linear.gamma = gamma;
    for (double ContactParameters::*stiffness :
         {&ContactParameters::kt, &ContactParameters::kr, &ContactParameters::kTo})
        linear.*stiffness *= k;
    for (double ContactParameters::*damping :
         {&ContactParameters::gammaT, &ContactParameters::gammaR, &ContactParameters::gammaTo})
        linear.*damping *= gamma;
    return linear;
}

double overlapUnder(const ContactParameters& p, double reduced, double load) {
    if (p.law == NormalLaw::Luding) return load / p.k1;
    return std::pow(load / (4.0 / 3.0 * p.modulus * std::sqrt(reduced / 2)), 2.0 / 3.0);
}

double overlapOfImpact(const ContactParameters& p, double mass, double reduced, double speed) {
    if (p.law == NormalLaw::Luding) return speed * std::sqrt(mass / p.k1);
    return std::pow(15.0 / 16.0 * mass * speed * speed / (p.modulus * std::sqrt(reduced / 2)), 0.4);
}

}  // namespace vkdose
