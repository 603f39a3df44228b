#include "host/law/hertz.h"

#include <cmath>

#include "host/law/impact.h"
#include "host/law/law_keys.h"

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

constexpr Key kYoungsModulus =
    key::number("youngs_modulus", {1, "Pa"}, kPositive, told("required unless `luding`"),
                "E; in `[contact]` of the particles, in the other two of the wall's and the coil's material");
constexpr Key kPoissonRatio = key::number("poisson_ratio", kPlain, kNonNegative, told("required unless `luding`"),
                                          "ν of that material; at most 0.5");

}  // namespace

ContactParameters ofModuli(NormalLaw law, const Elasticity& a, const Elasticity& b, double restitution,
                           const ContactParameters& rest) {
    ContactParameters p = rest;
    p.law = law;
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

std::string_view Hertz::meaning() const {
    return "elastic spheres without adhesion, with the moduli of the materials; its contacts get stiffer with the "
           "overlap, and the time step is right up to `max_overlap_ratio`";
}

std::vector<LawKey> Hertz::keys() const {
    return {{kYoungsModulus}, {kPoissonRatio}, {kRestitutionKey}};
}

double Hertz::stiffness(const ContactParameters& p, double reduced, double overlap) const {
    return hertzStiffness(p, reduced, overlap);
}

ContactParameters Hertz::linearised(const ContactParameters& p, double mass, double reduced, double overlap) const {
    const double k = stiffness(p, reduced, overlap);
    const double gamma = kHertzDamping * p.dampingShare * std::sqrt(k * mass);
    ContactParameters linear = p;
    linear.law = NormalLaw::Luding;
    linear.k1 = linear.k2Max = k;
    linear.gamma = gamma;
    scaleSliders(linear, k, gamma);
    return linear;
}

double Hertz::overlapUnder(const ContactParameters& p, double reduced, double load) const {
    return std::pow(load / (4.0 / 3.0 * p.modulus * std::sqrt(reduced / 2)), 2.0 / 3.0);
}

double Hertz::overlapOfImpact(const ContactParameters& p, double mass, double reduced, double speed) const {
    return std::pow(15.0 / 16.0 * mass * speed * speed / (p.modulus * std::sqrt(reduced / 2)), 0.4);
}

double Hertz::restitution(const ContactParameters& p, double /*mass*/) const {
    return restitutionOf(p.dampingShare);
}

LawLanes Hertz::lanes(const ContactParameters& p) const {
    return {{p.modulus, kHertzDamping * p.dampingShare}, 0, p.gamma};
}

NormalAnswer Hertz::answerOf(const ContactParameters& p, double overlap, double reduced, double mass, double force,
                             double pull) const {
    const ContactParameters now = linearised(p, mass, reduced, overlap);
    return {force, now.gamma, pull, now.kt, now.kr, now.kTo, now.gammaT, now.gammaR, now.gammaTo, true};
}

/// Hertz (1882): f = 4/3 E* sqrt(R*) delta^(3/2).
NormalAnswer Hertz::answer(const ContactParameters& p, double overlap, double reduced, double mass,
                           double& memory) const {
    memory = overlap;
    return answerOf(p, overlap, reduced, mass, 2.0 / 3.0 * stiffness(p, reduced, overlap) * overlap, 0);
}

double Hertz::stored(const ContactParameters& /*p*/, double overlap, double /*reduced*/, double force,
                     double /*memory*/) const {
    return 0.4 * force * overlap;
}

double Hertz::lost(const NormalStep& /*step*/) const {
    return 0;
}

const Law& hertzLaw() {
    static const Hertz kLaw;
    return kLaw;
}

}  // namespace vkdose
