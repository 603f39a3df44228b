#include "host/law/eepa.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "host/core/vec.h"
#include "host/law/impact.h"
#include "host/law/law_keys.h"

namespace vkdose {
namespace {

constexpr double kSteepest = 10;  ///< largest exponent of the adhesive branch

constexpr Key kPlasticityRatio =
    key::number("plasticity_ratio", kPlain, kNonNegative, told("required with `eepa`"),
                "λ_p = 1 - k₁/k₂, below 1: how much stiffer unloading is than loading. 0 is elastic");
constexpr Key kPullOffForce = key::number("pull_off_force", {1, "N"}, kNonNegative, 0.0,
                                          "-f₀, a pull that every contact of the law `eepa` has, pressed or not");
constexpr Key kAdhesionExponent =
    key::number("adhesion_exponent", kPlain, kPositive, 1.5,
                "χ of the law `eepa`, 1 to 10: with it the pull fades while a contact opens");

double threeHalves(double x) {
    return std::pow(x, 1.5);
}

/// How much steeper the adhesive branch can be than the unloading line at the same largest overlap, at least 1. The
/// pull P <= k2 delta_p^(3/2)/2 falls with the slope chi P/delta_min, which is steepest at the smallest delta_min.
double steepestBranch(const ContactParameters& p) {
    if (!(p.surfaceEnergy > 0)) return 1;
    return std::max(1.0, p.adhesionExponent / 1.5 * std::cbrt(p.plasticityRatio / 2));
}

class Eepa : public Hertz {
  public:
    NormalLaw kind() const override { return NormalLaw::Eepa; }
    std::string_view word() const override { return "eepa"; }
    std::string_view meaning() const override {
        return "the same spheres, which stay flattened and adhere where they were";
    }
    std::vector<LawKey> keys() const override;
    std::vector<ParameterFault> faultsOf(const ContactParameters& p) const override;
    void scaleStress(ContactParameters& p, double s) const override;

    ContactParameters linearised(const ContactParameters& p, double mass, double reduced,
                                 double overlap) const override;
    double overlapUnder(const ContactParameters& p, double reduced, double load) const override;
    /// On Hertz's line, with the work of the constant pull.
    double overlapOfImpact(const ContactParameters& p, double mass, double reduced, double speed) const override;
    double restitutionAt(const ContactParameters& p, double mass, double reduced, double speed) const override;
    /// P - f0.
    double pullOff(const ContactParameters& p, double reduced, double maxOverlap) const override;
    double overlapOfStrongestPull(const ContactParameters& p, double reduced) const override;
    LawLanes lanes(const ContactParameters& p) const override;

    NormalAnswer answer(const ContactParameters& p, double overlap, double reduced, double mass,
                        double& maxOverlap) const override;
    double stored(const ContactParameters& p, double overlap, double reduced, double force,
                  double maxOverlap) const override;
    double arriving(const ContactParameters& p, double overlap, double reduced, double force) const override;
    double lost(const NormalStep& step) const override;
};

}  // namespace

EepaPath eepaPath(const ContactParameters& p, double reduced, double maxOverlap) {
    EepaPath path{};
    path.constant = -p.constantPull;
    path.unloading = 4.0 / 3.0 * p.modulus * std::sqrt(reduced / 2) / (1 - p.plasticityRatio);
    path.flattened = std::cbrt(p.plasticityRatio * p.plasticityRatio) * maxOverlap;
    const double patch = std::sqrt(path.flattened * std::max(0.0, reduced - path.flattened));
    // The unloading line must meet the adhesive branch before the contact opens: at half of delta_p^(3/2) at the least.
    const double most = path.unloading * threeHalves(path.flattened) / 2;
    path.pull = std::min(1.5 * kPi * p.surfaceEnergy * patch, most);
    path.pole = std::cbrt(std::pow(threeHalves(path.flattened) - path.pull / path.unloading, 2));
    path.exponent = p.adhesionExponent;
    return path;
}

double EepaPath::force(double overlap) const {
    if (overlap < pole) return constant - pullAt(overlap);
    return constant + unloading * (threeHalves(overlap) - threeHalves(flattened));
}

double EepaPath::pullAt(double overlap) const {
    return pull > 0 ? pull * std::pow(overlap / pole, exponent) : 0;
}

double EepaPath::energy(double overlap) const {
    const double adhesive = std::min(overlap, pole);
    const double opening = -pullAt(adhesive) * adhesive / (exponent + 1);
    const auto area = [&](double x) { return x * (0.4 * threeHalves(x) - threeHalves(flattened)); };
    return constant * overlap + opening + unloading * (area(std::max(overlap, pole)) - area(pole));
}

namespace {

std::vector<LawKey> Eepa::keys() const {
    std::vector<LawKey> keys = Hertz::keys();
    keys.insert(keys.end(), {{kSurfaceEnergyKey, &ContactParameters::surfaceEnergy},
                             {kPlasticityRatio, &ContactParameters::plasticityRatio},
                             {kPullOffForce, &ContactParameters::constantPull},
                             {kAdhesionExponent, &ContactParameters::adhesionExponent}});
    return keys;
}

std::vector<ParameterFault> Eepa::faultsOf(const ContactParameters& p) const {
    std::vector<ParameterFault> faults;
    if (p.plasticityRatio >= 1)
        faults.push_back({{{"plasticity_ratio", "lets nothing of the overlap spring back"}},
                          "give a number >= 0 and < 1, 0.5 for unloading twice as stiff as loading"});
    if (p.adhesionExponent < 1)
        faults.push_back({{{"adhesion_exponent", "makes the pull end abruptly where the contact opens"}},
                          "give a number >= 1, as a rule 1.5"});
    if (p.adhesionExponent > kSteepest)
        faults.push_back({{{"adhesion_exponent",
                            "lets the force from which friction is counted grow without measure beyond the pole"}},
                          fmt::format("give at most {}, as a rule 1.5", kSteepest)});
    if (p.surfaceEnergy != 0 && !(p.plasticityRatio > 0))
        faults.push_back(
            {{{"surface_energy", "acts on flattened contacts, and with plasticity_ratio = 0 none is"},
              {"plasticity_ratio",
               fmt::format("flattens no contact, and its surface_energy = {:.6g} acts on flattened ones alone",
                           p.surfaceEnergy)}},
             "give a plasticity_ratio > 0, or a surface energy of 0"});
    return faults;
}

void Eepa::scaleStress(ContactParameters& p, double s) const {
    p.surfaceEnergy *= s;
    p.constantPull *= s * s;
}

ContactParameters Eepa::linearised(const ContactParameters& p, double mass, double reduced, double overlap) const {
    ContactParameters linear = Hertz::linearised(p, mass, reduced, overlap);
    linear.k2Max = linear.k1 / (1 - p.plasticityRatio) * steepestBranch(p);
    return linear;
}

double Eepa::overlapUnder(const ContactParameters& p, double reduced, double load) const {
    return Hertz::overlapUnder(p, reduced, load + p.constantPull);
}

double Eepa::overlapOfImpact(const ContactParameters& p, double mass, double reduced, double speed) const {
    double overlap = Hertz::overlapOfImpact(p, mass, reduced, speed);
    if (p.constantPull == 0) return overlap;
    const double modulus = p.modulus * std::sqrt(reduced / 2);
    // 8/15 E* sqrt(R*) delta^(5/2) = m v^2/2 + pull delta: each turn leaves at most 0.4 of the error in ln delta.
    constexpr int kTurns = 45;
    for (int i = 0; i < kTurns; ++i)
        overlap = std::pow(15.0 / 8.0 * (mass * speed * speed / 2 + p.constantPull * overlap) / modulus, 0.4);
    return overlap;
}

double impact(const ContactParameters& p, double mass, double reduced, double speed) {
    double largest = 0;
    return followedImpact(p, mass, reduced, speed, [&](double overlap, const ImpactMotion& before) {
        largest = std::max(largest, before.overlap);
        return eepaPath(p, reduced, std::max(largest, overlap)).force(overlap);
    });
}

double Eepa::restitutionAt(const ContactParameters& p, double mass, double reduced, double speed) const {
    if (speed > 0) return impact(p, mass, reduced, speed);
    // The limit of slow impacts. A constant pull holds them. Else the law has no scale of its own there, because the
    // pull is as strong as it can be.
    if (p.constantPull > 0) return 0;
    ContactParameters slow = p;
    if (p.surfaceEnergy > 0) slow.surfaceEnergy = std::numeric_limits<double>::max();
    const double overlap = 1e-6 * reduced;
    return impact(slow, mass, reduced, overlap * std::sqrt(hertzStiffness(slow, reduced, overlap) / mass));
}

double Eepa::pullOff(const ContactParameters& p, double reduced, double maxOverlap) const {
    return eepaPath(p, reduced, maxOverlap).pull + p.constantPull;
}

/// The patch of a contact is largest when it is as wide as R*.
double Eepa::overlapOfStrongestPull(const ContactParameters& p, double reduced) const {
    return p.plasticityRatio > 0 ? reduced / 2 / std::cbrt(std::pow(p.plasticityRatio, 2)) : 0;
}

LawLanes Eepa::lanes(const ContactParameters& p) const {
    LawLanes lanes = Hertz::lanes(p);
    lanes.normal[2] = 1.5 * kPi * p.surfaceEnergy;
    lanes.normal[3] = p.plasticityRatio;
    lanes.constant = -p.constantPull;
    lanes.damping = p.adhesionExponent / 1.5;
    return lanes;
}

/// The other directions and all damping are those of Hertz's line at this overlap.
NormalAnswer Eepa::answer(const ContactParameters& p, double overlap, double reduced, double mass,
                          double& maxOverlap) const {
    maxOverlap = std::max(maxOverlap, overlap);
    const EepaPath path = eepaPath(p, reduced, maxOverlap);
    return answerOf(p, overlap, reduced, mass, path.force(overlap), path.pullAt(overlap) + p.constantPull);
}

double Eepa::stored(const ContactParameters& p, double overlap, double reduced, double /*force*/,
                    double maxOverlap) const {
    return eepaPath(p, reduced, maxOverlap).energy(overlap);
}

/// Hertz's line bears force - f0.
double Eepa::arriving(const ContactParameters& p, double overlap, double /*reduced*/, double force) const {
    return 0.4 * (force + p.constantPull) * overlap - p.constantPull * overlap;
}

/// A contact that parts takes the path that its stored energy is the area of, so that it loses nothing more.
double Eepa::lost(const NormalStep& step) const {
    return step.touches ? Law::lost(step) : 0;
}

}  // namespace

const Law& eepaLaw() {
    static const Eepa kLaw;
    return kLaw;
}

}  // namespace vkdose
