#include "host/model/pull_off.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "host/model/eepa.h"
#include "host/model/jkr.h"
#include "host/model/normal_law.h"

namespace vkdose {
namespace {

/// A contact on its adhesive side: the overlap that acts, and by how much it is stiffer there, k_2 - k_1.
struct Pressed {
    double acting, stiffer;

    Pressed(const ContactParameters& p, double reduced, double maxOverlap) {
        const double limit = p.k2Max / (p.k2Max - p.k1) * p.plasticityDepth * reduced;
        acting = std::min(maxOverlap, limit);
        stiffer = (p.k2Max - p.k1) * (limit > 0 ? acting / limit : 1);
    }
};

}  // namespace

double pullOff(const ContactParameters& p, double reduced, double maxOverlap) {
    if (p.law == NormalLaw::User) return std::numeric_limits<double>::quiet_NaN();
    if (p.law == NormalLaw::Eepa) return eepaPath(p, reduced, maxOverlap).pull + p.constantPull;
    if (p.law == NormalLaw::Jkr) return JkrContact(p, reduced).pullOff;
    if (p.k2Max <= p.k1) return 0;  // one stiffness: no adhesive branch
    const Pressed c(p, reduced, maxOverlap);
    return p.kc * c.stiffer / (p.k1 + c.stiffer + p.kc) * c.acting;
}

double pullOffUnder(const ContactParameters& p, double reduced, double load) {
    if (p.law == NormalLaw::Luding || p.law == NormalLaw::User) return pullOff(p, reduced, load / p.k1);
    // The patch of a contact is largest when it is as wide as R*.
    const double widest = p.plasticityRatio > 0 ? reduced / 2 / std::cbrt(std::pow(p.plasticityRatio, 2)) : 0;
    return pullOff(p, reduced, std::isinf(load) ? widest : overlapUnder(p, reduced, load));
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

}  // namespace vkdose
