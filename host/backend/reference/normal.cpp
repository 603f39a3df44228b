#include "host/backend/reference/normal.h"

#include <algorithm>

#include "host/model/eepa.h"
#include "host/model/jkr.h"
#include "host/model/normal_law.h"

namespace vkdose::reference {

namespace {

/// delta*: the overlap from which a contact has its largest stiffness. Needs k1 < k2Max.
double plasticLimit(const ContactParameters& p, double reduced) {
    return p.k2Max / (p.k2Max - p.k1) * p.plasticityDepth * reduced;
}

}  // namespace

namespace {

NormalAnswer ludingAnswer(const ContactParameters& p, double overlap, double reduced, double& maxOverlap) {
    const double force = normalForce(p, overlap, reduced, maxOverlap);
    return {force, p.gamma, p.kc * overlap, p.kt, p.kr, p.kTo, p.gammaT, p.gammaR, p.gammaTo, false};
}

/// Hertz (1882): f = 4/3 E* sqrt(R*) delta^(3/2). The stiffness at this overlap and its damping set those of the other
/// directions. The history tells only that the contact touches.
NormalAnswer hertzAnswer(const ContactParameters& p, double overlap, double reduced, double mass, double& memory) {
    memory = overlap;
    const ContactParameters now = linearised(p, mass, reduced, overlap);
    return {
        2.0 / 3.0 * now.k1 * overlap, now.gamma, 0, now.kt, now.kr, now.kTo, now.gammaT, now.gammaR, now.gammaTo, true};
}

/// The other directions and all damping are those of Hertz's line at this overlap.
NormalAnswer eepaAnswer(const ContactParameters& p, double overlap, double reduced, double mass, double& maxOverlap) {
    maxOverlap = std::max(maxOverlap, overlap);
    const EepaPath path = eepaPath(p, reduced, maxOverlap);
    const ContactParameters now = linearised(p, mass, reduced, overlap);
    const double pull = path.pullAt(overlap) + p.constantPull;
    return {path.force(overlap), now.gamma, pull, now.kt, now.kr, now.kTo, now.gammaT, now.gammaR, now.gammaTo, true};
}

/// The other directions and all damping are those of Hertz's line at the overlap that gives this contact radius. The
/// history is how much the overlap is above the one at which the contact is lost. Friction is counted from twice the
/// pull-off force (Marshall 2009, as in LAMMPS).
NormalAnswer jkrAnswer(const ContactParameters& p, double overlap, double reduced, double mass, double& memory) {
    const JkrContact contact(p, reduced);
    memory = overlap + contact.reach;
    const ContactParameters now = linearised(p, mass, reduced, overlap);
    return {contact.force(overlap),
            now.gamma,
            2 * contact.pullOff,
            now.kt,
            now.kr,
            now.kTo,
            now.gammaT,
            now.gammaR,
            now.gammaTo,
            true};
}

}  // namespace

NormalAnswer normalAnswer(const ContactParameters& p, double overlap, double reduced, double mass, double& memory) {
    switch (p.law) {
        case NormalLaw::HertzMindlin:
            return hertzAnswer(p, overlap, reduced, mass, memory);
        case NormalLaw::Eepa:
            return eepaAnswer(p, overlap, reduced, mass, memory);
        case NormalLaw::Jkr:
            return jkrAnswer(p, overlap, reduced, mass, memory);
        default:
            return ludingAnswer(p, overlap, reduced, memory);
    }
}

double springsKept(const ContactParameters& p, double reduced, double mass, double before, double now) {
    if (p.law == NormalLaw::Luding) return 1;
    const double was = linearised(p, mass, reduced, before).k1, is = linearised(p, mass, reduced, now).k1;
    return was < is ? was / is : 1;
}

double springsKept(double was, double is) {
    return was > 0 && was < is ? was / is : 1;
}

double storedEnergy(const ContactParameters& p, double overlap, double reduced, double force, double memory) {
    if (p.law == NormalLaw::HertzMindlin) return 0.4 * force * overlap;
    if (p.law == NormalLaw::Eepa) return eepaPath(p, reduced, memory).energy(overlap);
    if (p.law == NormalLaw::Jkr) return JkrContact(p, reduced).energy(overlap);
    return force * force / (2 * unloadingStiffness(p, reduced, memory));
}

double workOfFirstTouch(const ContactParameters& p, double overlap, double reduced, double force) {
    if (p.law == NormalLaw::Jkr) {
        const JkrContact contact(p, reduced);
        return contact.energy(overlap) - contact.energy(0);
    }
    // Under EEPA Hertz's line bears force - f0.
    if (p.law == NormalLaw::Eepa) return 0.4 * (force + p.constantPull) * overlap - p.constantPull * overlap;
    return force * overlap / 2;
}

bool losesEnergy(NormalLaw law) {
    return law != NormalLaw::HertzMindlin;
}

bool losesAtTouchAlone(NormalLaw law) {
    return law == NormalLaw::Jkr;
}

bool partsOnStoredPath(NormalLaw law) {
    return law == NormalLaw::Eepa;
}

double unloadingStiffness(const ContactParameters& p, double reduced, double maxOverlap) {
    if (p.k2Max <= p.k1) return p.k1;
    const double limit = plasticLimit(p, reduced);
    return p.k1 + (p.k2Max - p.k1) * (maxOverlap < limit ? maxOverlap / limit : 1);
}

bool onAdhesiveBranch(const ContactParameters& p, double overlap, double force) {
    if (p.law == NormalLaw::Jkr) return true;
    return p.law == NormalLaw::Luding && force < 0 && force <= -p.kc * overlap;
}

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

}  // namespace vkdose::reference
