#include "host/law/jkr.h"

#include <algorithm>
#include <cmath>

#include "host/core/vec.h"
#include "host/law/impact.h"
#include "host/law/law_keys.h"

namespace vkdose {
namespace {

/// sqrt(a/a0) where the contact is lost: s^3 = 1/6.
const double kLast = std::cbrt(1.0 / 6);

/// s = sqrt(a/a0) on the stable branch of 2 s^4 - 4/3 s = y, from the resolvent cubic of the quartic.
double rootOfPatch(double y) {
    y = std::max(y, -kLast);
    const double u = std::cbrt(2.0 / 9 + std::sqrt(std::max(0.0, 4.0 / 81 + 8.0 / 27 * y * y * y)));
    const double w = 2.0 / 3 * y / u;
    const double alpha = std::sqrt(4.0 / 9 / (u * u + u * w + w * w));
    return (alpha + std::sqrt(std::max(0.0, 4 / (3 * alpha) - alpha * alpha))) / 2;
}

/// Area under the path from the separated spheres, in units of 4 Fc and the length 6^(1/3) delta_c.
double areaAt(double s) {
    const double cube = s * s * s;
    return s * cube * (0.8 * cube * cube - 4.0 / 3 * cube + 1.0 / 3);
}

}  // namespace

JkrContact::JkrContact(const ContactParameters& p, double reduced)
    : modulus(p.modulus),
      size(reduced / 2),
      freeRadius(std::cbrt(9 * kPi * p.surfaceEnergy * size * size / (2 * modulus))),
      pullOff(1.5 * kPi * p.surfaceEnergy * size),
      reach(freeRadius * freeRadius / (2 * std::cbrt(6.0) * size)) {}

double JkrContact::radius(double overlap) const {
    if (freeRadius == 0) return std::sqrt(size * std::max(0.0, overlap));
    const double s = rootOfPatch(2 * size * overlap / (freeRadius * freeRadius));
    return freeRadius * s * s;
}

double JkrContact::force(double overlap) const {
    const double a = radius(overlap);
    if (freeRadius == 0) return 4.0 / 3.0 * modulus * a * a * a / size;
    const double root = std::pow(a / freeRadius, 1.5);
    return 4 * pullOff * root * (root - 1);
}

double JkrContact::energy(double overlap) const {
    const double a = radius(overlap);
    if (freeRadius == 0) return 8.0 / 15.0 * modulus * a * a * a * overlap / size;
    return 4 * pullOff * std::cbrt(6.0) * reach * (areaAt(std::sqrt(a / freeRadius)) - areaAt(kLast));
}

double JkrContact::overlapUnder(double load) const {
    if (freeRadius == 0) return std::pow(load / (4.0 / 3.0 * modulus * std::sqrt(size)), 2.0 / 3.0);
    const double s = std::cbrt((1 + std::sqrt(std::max(0.0, 1 + load / pullOff))) / 2);
    return freeRadius * freeRadius / (2 * size) * (2 * s * s * s * s - 4.0 / 3 * s);
}

namespace {

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

class Jkr : public Hertz {
  public:
    NormalLaw kind() const override { return NormalLaw::Jkr; }
    std::string_view word() const override { return "jkr"; }
    std::string_view meaning() const override {
        return "the same spheres, elastic and adhesive, which hold on to each other a little beyond touch";
    }
    std::vector<LawKey> keys() const override {
        std::vector<LawKey> keys = Hertz::keys();
        keys.push_back({kSurfaceEnergyKey, &ContactParameters::surfaceEnergy});
        return keys;
    }
    void scaleStress(ContactParameters& p, double s) const override { p.surfaceEnergy *= s; }

    double reach(const ContactParameters& p, double reduced) const override { return JkrContact(p, reduced).reach; }
    double overlapUnder(const ContactParameters& p, double reduced, double load) const override {
        return JkrContact(p, reduced).overlapUnder(load);
    }
    /// On the path from touch.
    double overlapOfImpact(const ContactParameters& p, double mass, double reduced, double speed) const override {
        return overlapOfAdhesiveImpact(JkrContact(p, reduced), mass * speed * speed / 2);
    }
    double restitutionAt(const ContactParameters& p, double mass, double reduced, double speed) const override;
    /// 3/2 pi delta gamma R*, after any overlap.
    double pullOff(const ContactParameters& p, double reduced, double /*maxOverlap*/) const override {
        return JkrContact(p, reduced).pullOff;
    }
    LawLanes lanes(const ContactParameters& p) const override {
        LawLanes lanes = Hertz::lanes(p);
        lanes.normal[2] = std::cbrt(std::sqrt(2 * kPi * p.surfaceEnergy / p.modulus) / 4);
        return lanes;
    }

    /// The memory is how much the overlap is above the one at which the contact is lost.
    NormalAnswer answer(const ContactParameters& p, double overlap, double reduced, double mass,
                        double& memory) const override;
    double largestOverlap(const ContactParameters& p, double reduced, double memory) const override {
        return memory - reach(p, reduced);
    }
    double stored(const ContactParameters& p, double overlap, double reduced, double /*force*/,
                  double /*memory*/) const override {
        return JkrContact(p, reduced).energy(overlap);
    }
    double arriving(const ContactParameters& p, double overlap, double reduced, double /*force*/) const override {
        const JkrContact contact(p, reduced);
        return contact.energy(overlap) - contact.energy(0);
    }
    /// The spheres lose as they snap into contact, and nowhere else.
    double lost(const NormalStep& step) const override { return step.touched ? 0 : step.arriving - step.gained; }
    bool adheres(const ContactParameters& /*p*/, double /*overlap*/, double /*force*/) const override { return true; }

  protected:
    /// More than the slope of the law's own force where the surfaces pull.
    double stiffness(const ContactParameters& p, double reduced, double overlap) const override {
        return 2 * p.modulus * JkrContact(p, reduced).radius(overlap);
    }
};

double Jkr::restitutionAt(const ContactParameters& p, double mass, double reduced, double speed) const {
    if (p.surfaceEnergy == 0) return restitution(p, mass);
    if (!(speed > 0)) return 0;
    const JkrContact contact(p, reduced);
    return followedImpact(p, mass, reduced, speed,
                          [&](double overlap, const ImpactMotion& /*before*/) { return contact.force(overlap); });
}

/// The other directions and all damping are those of Hertz's line at the overlap that gives this contact radius.
/// Friction is counted from twice the pull-off force (Marshall 2009, as in LAMMPS).
NormalAnswer Jkr::answer(const ContactParameters& p, double overlap, double reduced, double mass,
                         double& memory) const {
    const JkrContact contact(p, reduced);
    memory = overlap + contact.reach;
    return answerOf(p, overlap, reduced, mass, contact.force(overlap), 2 * contact.pullOff);
}

}  // namespace

const Law& jkrLaw() {
    static const Jkr kLaw;
    return kLaw;
}

}  // namespace vkdose
