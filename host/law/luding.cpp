#include "host/law/luding.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "host/law/impact.h"
#include "host/law/law_keys.h"

namespace vkdose {
namespace {

constexpr double kUnbounded = std::numeric_limits<double>::infinity();

/// delta*: the overlap from which a contact has its largest stiffness. Needs k1 < k2Max.
double plasticLimit(const ContactParameters& p, double reduced) {
    return p.k2Max / (p.k2Max - p.k1) * p.plasticityDepth * reduced;
}

/// A contact on its adhesive side: the overlap that acts, and by how much it is stiffer there, k_2 - k_1.
struct Pressed {
    double acting, stiffer;

    Pressed(const ContactParameters& p, double reduced, double maxOverlap) {
        const double limit = plasticLimit(p, reduced);
        acting = std::min(maxOverlap, limit);
        stiffer = (p.k2Max - p.k1) * (limit > 0 ? acting / limit : 1);
    }
};

/// A head-on impact on one line of the law, force = slope (overlap - rest), with damping.
struct Line {
    double slope, rest, gamma, mass;

    ImpactMotion stepped(ImpactMotion now, double dt) const {
        return steppedBy(now, dt,
                         [&](ImpactMotion m) { return -(slope * (m.overlap - rest) + gamma * m.speed) / mass; });
    }

    /// A hundredth of the fastest of the line's times; `way` is the time that the motion takes at its present speed.
    double step(double way) const {
        const double swing = slope == 0 ? way : std::sqrt(mass / std::abs(slope));
        return 1e-2 * std::min({swing, gamma > 0 ? mass / gamma : swing, way});
    }

    /// The motion until `left` of it has fallen to zero; what the last step goes too far is taken back along its chord.
    /// A motion that takes longer than kMostSteps creeps; it is given back as it is then.
    template <class Left>
    ImpactMotion followed(ImpactMotion now, double dt, const Left& left) const {
        constexpr int kMostSteps = 100000;
        for (int i = 0; i < kMostSteps && left(now) > 0; ++i) {
            const ImpactMotion next = stepped(now, dt);
            const double before = left(now), after = left(next);
            if (after <= 0) return stepped(now, dt * before / (before - after));
            now = next;
        }
        return now;
    }
};

/// Restitution of an impact with plasticity: the lines of physics.md, "Contact law", one after the other.
double plasticImpact(const ContactParameters& p, double mass, double reduced, double speed) {
    const double limit = plasticLimit(p, reduced);
    const auto speedLeft = [](ImpactMotion m) { return m.speed; };
    const Line loading{p.k1, 0, p.gamma, mass}, beyond{p.k2Max, (1 - p.k1 / p.k2Max) * limit, p.gamma, mass};
    ImpactMotion m =
        loading.followed({0, speed}, loading.step(limit > 0 ? limit / speed : kUnbounded),
                         [&](ImpactMotion now) { return std::min(now.speed / speed, 1 - now.overlap / limit); });
    if (m.overlap > 0.999999 * limit && m.speed > 0) m = beyond.followed(m, beyond.step(kUnbounded), speedLeft);

    const double acting = std::min(m.overlap, limit);
    const double k2 = p.k1 + (p.k2Max - p.k1) * acting / limit, rest = (1 - p.k1 / k2) * acting;
    const Line unloading{k2, rest, p.gamma, mass}, adhesive{-p.kc, 0, p.gamma, mass};
    const double meets = k2 * rest / (k2 + p.kc);
    // Pulled back before the adhesive branch, the sphere swings: it sticks.
    m = unloading.followed({m.overlap, 0}, unloading.step(kUnbounded),
                           [&](ImpactMotion now) { return now.speed > 0 ? 0 : now.overlap - meets; });
    // It ends where the overlap does, or where the speed does: the two stick.
    const double creep = 1e-6 * speed;
    if (m.speed < -creep && m.overlap > 0)
        m = adhesive.followed(m, adhesive.step(-m.overlap / m.speed),
                              [&](ImpactMotion now) { return now.speed < -creep ? now.overlap : 0.0; });
    return m.speed < -creep && m.overlap < 1e-3 * meets + 1e-12 * limit ? -m.speed / speed : 0;
}

double dampingRatio(const ContactParameters& p, double mass) {
    return p.gamma / (2 * std::sqrt(p.k1 * mass));
}

class Luding : public Law {
  public:
    NormalLaw kind() const override { return NormalLaw::Luding; }
    std::string_view word() const override { return "luding"; }
    std::string_view meaning() const override { return "linear, plastic and adhesive, with stiffnesses"; }
    std::vector<LawKey> keys() const override;
    void scaleStress(ContactParameters& p, double s) const override;

    /// It is linear already.
    ContactParameters linearised(const ContactParameters& p, double /*mass*/, double /*reduced*/,
                                 double /*overlap*/) const override {
        return p;
    }
    double overlapUnder(const ContactParameters& p, double /*reduced*/, double load) const override {
        return load / p.k1;
    }
    /// On k1.
    double overlapOfImpact(const ContactParameters& p, double mass, double /*reduced*/, double speed) const override {
        return speed * std::sqrt(mass / p.k1);
    }
    double restitution(const ContactParameters& p, double mass) const override {
        return restitutionOf(dampingRatio(p, mass));
    }
    double restitutionAt(const ContactParameters& p, double mass, double reduced, double speed) const override;
    /// k_c (k_2 - k_1)/(k_2 + k_c) min(delta_max, delta*).
    double pullOff(const ContactParameters& p, double reduced, double maxOverlap) const override;
    LawLanes lanes(const ContactParameters& p) const override {
        return {{p.k1, p.k2Max, p.kc, p.plasticityDepth}, 0, p.gamma};
    }

    NormalAnswer answer(const ContactParameters& p, double overlap, double reduced, double /*mass*/,
                        double& maxOverlap) const override {
        const double force = normalForce(p, overlap, reduced, maxOverlap);
        return {force, p.gamma, p.kc * overlap, p.kt, p.kr, p.kTo, p.gammaT, p.gammaR, p.gammaTo, false};
    }
    double stored(const ContactParameters& p, double /*overlap*/, double reduced, double force,
                  double maxOverlap) const override {
        return force * force / (2 * unloadingStiffness(p, reduced, maxOverlap));
    }
    /// On the adhesive branch, where the force is the largest pull that the overlap allows.
    bool adheres(const ContactParameters& p, double overlap, double force) const override {
        return force < 0 && force <= -p.kc * overlap;
    }
};

std::vector<LawKey> Luding::keys() const {
    using namespace key;
    static constexpr Key kKeys[] = {
        number("k", {1, "N/m"}, kPositive, told("this or one of the next two"),
               "k̂₂, the largest stiffness of unloading; all other stiffnesses are ratios to it")
            .replacing("contact_duration_s overlap_under_bed derived"),
        number("contact_duration_s", kSecond, kPositive, told("in place of `k`"),
               "k so that a contact on k₁ lasts so long, damping counted: the first column of `vkdose check`")
            .replacing("k overlap_under_bed derived"),
        number(
            "overlap_under_bed", kPlain, kPositive, told("in place of `k`"),
            "k so that the largest overlap under the bed's weight is this fraction of the mean radius. It is that of "
            "mean spheres at the floor in a chain of force, which bears 5 times the mean. Needs `[canister]`")
            .replacing("k contact_duration_s derived"),
        number("k1_over_k", kPlain, kPositive, told("required with `luding`"),
               "k₁/k, stiffness of plastic loading; at most 1")
            .replacing("derived"),
        number("kc_over_k", kPlain, kNonNegative, told("this or `bond_number`"),
               "k_c/k, adhesion, during the doses; without effect where k₁ = k")
            .replacing("bond_number bond_load derived"),
        number("bond_number", kPlain, kNonNegative, told("in place of `kc_over_k`"),
               "k_c so that the strongest pull of a contact is so many weights of a mean sphere")
            .replacing("kc_over_k derived"),
        key::word(
            "bond_load", "limit bed", "limit",
            "the load after which the contact pulls so: `\"limit\"`: one beyond the plastic limit, after which it "
            "pulls "
            "as strongly as it ever can; `\"bed\"`: the mean force at the floor under the bed's weight"),
        number("plasticity_depth", kPlain, kNonNegative, told("required if k₁ < k"),
               "φ_f, the overlap relative to the radius at which k₂ reaches k")
            .replacing("derived"),
        number("damping", {1, "kg/s"}, kNonNegative, told("this or `restitution`"),
               "γ, of the normal direction; a dashpot, not a restitution")
            .replacing("restitution restitution_speed derived"),
        kRestitutionKey,
        number(
            "restitution_speed", {1, "m/s"}, kNonNegative, 0.0,
            "speed of the impact with that `restitution`. 0: the limit of slow impacts, in which damping alone takes "
            "energy. Above: plasticity and adhesion count too"),
        kSlidingStiffnessKey,
        kSlidingDampingKey,
    };
    std::vector<LawKey> keys;
    for (const Key& key : kKeys) keys.push_back({key});
    return keys;
}

void Luding::scaleStress(ContactParameters& p, double s) const {
    for (double ContactParameters::*spring : {&ContactParameters::k1, &ContactParameters::k2Max, &ContactParameters::kc,
                                              &ContactParameters::kt, &ContactParameters::kr, &ContactParameters::kTo})
        p.*spring *= s;
    for (double ContactParameters::*dashpot : {&ContactParameters::gamma, &ContactParameters::gammaT,
                                               &ContactParameters::gammaR, &ContactParameters::gammaTo})
        p.*dashpot *= s * s;
}

double Luding::restitutionAt(const ContactParameters& p, double mass, double reduced, double speed) const {
    if (!(dampingRatio(p, mass) < 1) || !std::isfinite(p.k2Max + p.kc + p.plasticityDepth)) return 0;
    // With one stiffness the loss does not depend on the speed.
    if (!(speed > 0) || !(p.k2Max > p.k1) || !(p.plasticityDepth > 0)) return restitution(p, mass);
    return plasticImpact(p, mass, reduced, speed);
}

double Luding::pullOff(const ContactParameters& p, double reduced, double maxOverlap) const {
    if (p.k2Max <= p.k1) return 0;  // one stiffness: no adhesive branch
    const Pressed c(p, reduced, maxOverlap);
    return p.kc * c.stiffer / (p.k1 + c.stiffer + p.kc) * c.acting;
}

}  // namespace

double normalForce(const ContactParameters& p, double overlap, double reduced, double& maxOverlap) {
    // One stiffness: delta* is infinite and delta_0 zero, so the spring never leaves its loading line. It remembers no
    // more than that it touches, and a law that follows begins with the overlap of now.
    if (p.k2Max <= p.k1) {
        maxOverlap = overlap;
        return p.k1 * overlap;
    }
    maxOverlap = std::max(maxOverlap, overlap);

    const double limit = plasticLimit(p, reduced);
    const double capped = std::min(maxOverlap, limit);  // delta_max, as it acts
    const double k2 = unloadingStiffness(p, reduced, maxOverlap);
    const double plastic = (1 - p.k1 / k2) * capped;  // delta_0

    const double loading = p.k1 * overlap;
    const double unloading = k2 * (overlap - plastic);
    const double adhesive = -p.kc * overlap;

    if (overlap > limit) return unloading;  // beyond the plastic limit: the stiffest line, up and down
    if (unloading >= loading) return loading;
    if (unloading > adhesive) return unloading;
    maxOverlap = overlap * (k2 + p.kc) / (k2 - p.k1);  // where the unloading line meets the adhesive branch
    return adhesive;
}

double unloadingStiffness(const ContactParameters& p, double reduced, double maxOverlap) {
    if (p.k2Max <= p.k1) return p.k1;
    const double limit = plasticLimit(p, reduced);
    return p.k1 + (p.k2Max - p.k1) * (maxOverlap < limit ? maxOverlap / limit : 1);
}

double dampingFor(double e, const ContactParameters& p, double mass) {
    return 2 * dampingRatioFor(e) * std::sqrt(p.k1 * mass);
}

double strongestPull(const ContactParameters& p, double reduced, double load) {
    if (p.k2Max <= p.k1) return 0;
    const Pressed c(p, reduced, load / p.k1);
    return c.stiffer * c.acting;
}

std::optional<double> adhesionFor(double force, const ContactParameters& p, double reduced, double load) {
    if (force == 0) return 0.0;
    if (!(force < strongestPull(p, reduced, load))) return {};
    const Pressed c(p, reduced, load / p.k1);
    return force * (p.k1 + c.stiffer) / (c.stiffer * c.acting - force);
}

const Law& ludingLaw() {
    static const Luding kLaw;
    return kLaw;
}

}  // namespace vkdose
