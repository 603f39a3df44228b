#include "host/model/contact_targets.h"

#include <fmt/format.h>

#include <cmath>

#include "host/core/vec.h"
#include "host/law/impact.h"
#include "host/law/luding.h"
#include "host/model/bed_weight.h"

namespace vkdose {
namespace {

constexpr const char* kNoBed = "the weight of a bed is known only in a canister into which gravity pulls down";

/// The parameters as they follow from a share of critical damping. Where a restitution is wanted, that share is what
/// has to be found.
class Solver {
  public:
    Solver(const ContactTargets& targets, const MeanContact& contact, const Ratios& given)
        : targets_(targets), contact_(contact), given_(given) {}

    /// The parameters with the damping `zeta` of critical; if no restitution is wanted, with the given damping.
    /// `reached`: whether some adhesion has the wanted Bond number.
    Ratios at(double zeta, bool* reached = nullptr) const {
        Ratios r = given_;
        double k1 = r.k1 * r.k;
        if (targets_.overlap) k1 = kChain * *contact_.load / (*targets_.overlap * contact_.radius);
        if (targets_.duration) {
            const double frequency = kPi / *targets_.duration;
            const double decay = r.damping / (2 * contact_.mass);
            k1 = contact_.mass * frequency * frequency;
            k1 = targets_.restitution ? k1 / (1 - zeta * zeta) : k1 + contact_.mass * decay * decay;
        }
        if (targets_.overlap || targets_.duration) r.k = k1 / r.k1;
        if (targets_.restitution) r.damping = 2 * zeta * std::sqrt(k1 * contact_.mass);
        if (targets_.bond) {
            const auto kc =
                adhesionFor(*targets_.bond * contact_.weight, r.parameters(0), contact_.reduced, bondLoad());
            r.kc = kc ? *kc / r.k : kInfinity;
            if (reached != nullptr) *reached = kc.has_value();
        }
        return r;
    }

    double restitution(double zeta) const {
        const Ratios r = at(zeta);
        return restitutionAt(r.parameters(r.kc), contact_.mass, contact_.reduced, targets_.speed);
    }

    /// Load after which the Bond number is wanted [N].
    double bondLoad() const { return targets_.bondUnderBed ? contact_.load.value_or(0) : kInfinity; }

  private:
    const ContactTargets& targets_;
    const MeanContact& contact_;
    const Ratios& given_;
};

/// The damping with the wanted restitution at a speed. Damping takes energy, but it also makes the impact shallower,
/// which saves some of what plasticity and adhesion take: near the speed at which spheres stick, a little damping
/// raises the restitution. Beyond that maximum it falls to 0. The share is looked for there.
struct DampingAtSpeed {
    double zeta = 0;
    double most = 0;  ///< the highest restitution that some damping reaches
};

DampingAtSpeed dampingAtSpeed(const Solver& solver, double wanted) {
    constexpr int kSamples = 100;
    DampingAtSpeed found;
    double low = 0, high = 1;
    for (int i = 0; i < kSamples; ++i) {
        const double zeta = static_cast<double>(i) / kSamples, e = solver.restitution(zeta);
        if (e <= found.most) continue;
        found.most = e;
        low = zeta;
    }
    for (int i = 0; i < 50 && found.most >= wanted; ++i) {
        const double middle = 0.5 * (low + high);
        (solver.restitution(middle) >= wanted ? low : high) = middle;
    }
    found.zeta = low;
    return found;
}

std::optional<MissedTarget> withoutBed(const ContactTargets& targets, const MeanContact& contact) {
    if (targets.overlap && !contact.load)
        return MissedTarget{"overlap_under_bed", kNoBed, "give k, or contact_duration_s"};
    if (targets.bond && targets.bondUnderBed && !contact.load)
        return MissedTarget{"bond_load", kNoBed, "give bond_load = \"limit\""};
    if (targets.bond && contact.weight == 0)
        return MissedTarget{"bond_number", "nothing has a weight without gravity", "give kc_over_k"};
    return {};
}

/// The Bond number needs an adhesive branch, and one that is wide enough.
MissedTarget unreachableBond(const ContactTargets& targets, const MeanContact& contact, const Ratios& r,
                             double bondLoad) {
    if (r.k1 >= 1)
        return {"bond_number", "with k1_over_k = 1 a contact has no adhesion", "give k1_over_k below 1, or kc_over_k"};
    const double most = strongestPull(r.parameters(0), contact.reduced, bondLoad) / contact.weight;
    std::string remedy = fmt::format("give less than {:.3g}", most);
    // The pull goes as delta_max^2/delta* while delta_max < delta*, and delta* as the depth; beyond, as delta* itself.
    if (targets.bondUnderBed)
        remedy +=
            ", a smaller plasticity_depth, or bond_load = \"limit\" for that after a load beyond the plastic limit";
    else
        remedy += ", or a larger plasticity_depth";
    return {"bond_number",
            fmt::format("no adhesion reaches it: after {} a contact pulls with at most {:.3g} weights of a mean sphere",
                        targets.bondUnderBed ? "the bed's weight" : "a load beyond the plastic limit", most),
            remedy};
}

}  // namespace

void Ratios::soften(double s) {
    k /= s;
    damping /= std::sqrt(s);
    plasticity *= s;
}

ContactParameters Ratios::parameters(double adhesion) const {
    ContactParameters p;
    p.k2Max = k;
    p.k1 = k1 * k;
    p.kc = k1 < 1 ? adhesion * k : 0;  // without plasticity there is no adhesive branch that it could act on
    p.plasticityDepth = plasticity;
    p.gamma = damping;
    p.mu = mu;
    p.kt = kt * k;
    p.gammaT = dampingT * damping;
    p.muR = muR;
    p.kr = kr * k;
    p.gammaR = dampingR * damping;
    p.muTo = muTo;
    p.kTo = kTo * k;
    p.gammaTo = dampingTo * damping;
    return p;
}

std::optional<MissedTarget> meetTargets(const ContactTargets& targets, const MeanContact& contact, Ratios& r) {
    if (!targets.any()) return {};
    const double known = contact.mass + contact.weight + contact.load.value_or(0) + r.k + r.k1 + r.kc + r.plasticity +
                         r.damping + targets.overlap.value_or(0) + targets.duration.value_or(0) +
                         targets.bond.value_or(0) + targets.restitution.value_or(0) + targets.speed;
    if (!std::isfinite(known)) return {};
    if (auto missed = withoutBed(targets, contact)) return missed;

    const Solver solver(targets, contact, r);
    double zeta = targets.restitution ? dampingRatioFor(*targets.restitution) : 0;
    bool bondReached = true;
    Ratios met = solver.at(zeta, &bondReached);
    if (!bondReached) return unreachableBond(targets, contact, met, solver.bondLoad());
    if (targets.restitution && targets.speed > 0) {
        const DampingAtSpeed found = dampingAtSpeed(solver, *targets.restitution);
        if (found.most < *targets.restitution)
            return MissedTarget{
                "restitution",
                found.most > 0
                    ? fmt::format("no damping reaches it: at {:.3g} m/s plasticity and adhesion leave at most {:.3g}",
                                  targets.speed, found.most)
                    : fmt::format("no damping reaches it: at {:.3g} m/s the two stick", targets.speed),
                found.most > 0 ? fmt::format("give at most {:.3g}, a slower restitution_speed, less adhesion or a "
                                             "larger plasticity_depth",
                                             std::floor(found.most * 1e3) * 1e-3)
                               : "give a slower restitution_speed, less adhesion or a larger plasticity_depth"};
        met = solver.at(found.zeta, &bondReached);
        if (!bondReached) return unreachableBond(targets, contact, met, solver.bondLoad());
    }
    const double deepest = contact.radius * std::sqrt(met.k / contact.mass);  // the speed that presses so deep
    if (targets.speed > deepest)
        return MissedTarget{"restitution_speed", "presses mean spheres by more than their radius",
                            fmt::format("give less than {:.3g} m/s", deepest)};
    r = met;
    return {};
}

}  // namespace vkdose
