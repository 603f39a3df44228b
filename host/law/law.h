#pragma once
// A law of the normal force: all that the host knows of one. Each is an object without state, in a file of its name;
// shaders/shared/laws.h lists them. physics.md has the laws themselves.
//
// Everywhere `p` are the parameters of a contact, `reduced` is a* = 2 R* = 2 a b/(a + b), of a wall 2 a [m], `mass` the
// reduced mass [kg] and `overlap` in metres.

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "host/law/contact_parameters.h"

namespace vkdose {

/// What a law says of a contact in a step of the reference.
struct NormalAnswer {
    double force;                    ///< along the normal, without damping, repulsive positive [N]
    double gamma;                    ///< damping of the normal direction [kg/s]
    double pull;                     ///< largest adhesive force at this overlap [N]
    double kt, kr, kTo;              ///< stiffness of sliding, rolling, torsion [N/m]
    double gammaT, gammaR, gammaTo;  ///< their damping [kg/s]
    bool springAlone;                ///< while sliding, rolling or torsion slips (FrictionElement)
};

/// A step of a contact along the normal, as the ledger of energy sees it.
struct NormalStep {
    bool touched, touches;              ///< in the step before, and now
    double forceBefore, overlapBefore;  ///< without damping [N], [m]
    double arriving;                    ///< Law::arriving [J]
    double taken;                       ///< work that the force without damping took from the motion [J]
    double gained;                      ///< what the contact stores more than before [J]
};

struct LawKey;

/// Parameters that do not go together. It is told at the first of the keys that the table gives.
struct ParameterFault {
    struct At {
        std::string_view key;
        std::string problem;
    };
    std::vector<At> at;
    std::string remedy;
};

/// What a device is given of a law's parameters beside friction and the springs of the other directions (layout.h,
/// ContactParams).
struct LawLanes {
    std::array<double, 4> normal{};
    double constant = 0;  ///< `friction.w`
    double damping = 0;   ///< `damping.w`
};

class Law {
  public:
    virtual ~Law() = default;

    // --- in a case ---

    virtual NormalLaw kind() const = 0;
    /// Its word in `contact.law`, and what the manual says of it.
    virtual std::string_view word() const = 0;
    virtual std::string_view meaning() const = 0;
    /// The keys of a pair's table that it has beside those of all laws (law_keys.h).
    virtual std::vector<LawKey> keys() const = 0;
    /// Whether stiffness and damping follow from the moduli of materials and a restitution.
    virtual bool fromModuli() const { return false; }
    virtual std::vector<ParameterFault> faultsOf(const ContactParameters& /*p*/) const { return {}; }
    /// Makes parameters of grains those of spheres `s` times as large that bear the same stress at the same strain. In
    /// such a contact lengths and times grow with s, forces with s^2 and masses with s^3, and speeds stay. Ratios and
    /// moduli need no change. Source: Thakur, Ooi & Ahmadian, Powder Technology 293 (2016) 130.
    virtual void scaleStress(ContactParameters& /*p*/, double /*s*/) const {}

    // --- before a run: closed forms by which time steps, overlaps and impacts are judged ---

    /// The linear springs and dashpots that the contact acts like: k1 on loading, k2Max the steepest on the way back.
    virtual ContactParameters linearised(const ContactParameters& p, double mass, double reduced,
                                         double overlap) const = 0;
    /// How far beyond touch a contact that has come about holds on [m]: it is lost when its overlap falls to minus the
    /// reach. It grows with `reduced`, or is the same for all. A law that has one needs it in laws.h.
    virtual double reach(const ContactParameters& /*p*/, double /*reduced*/) const { return 0; }
    /// Overlap of a contact that has been loaded for the first time by `load` >= 0 [N].
    virtual double overlapUnder(const ContactParameters& p, double reduced, double load) const = 0;
    /// Largest overlap of a first impact at `speed` [m/s] without damping and friction.
    virtual double overlapOfImpact(const ContactParameters& p, double mass, double reduced, double speed) const = 0;
    /// Restitution of the limit of slow impacts, damping alone; 0 if overdamped.
    virtual double restitution(const ContactParameters& p, double mass) const = 0;
    /// Restitution of a head-on impact at `speed` [m/s] under the whole law. 0 if the two stick or are overdamped. A
    /// speed of 0 stands for the limit of slow impacts. An impact that is integrated has an error below 1e-4.
    virtual double restitutionAt(const ContactParameters& p, double mass, double /*reduced*/, double /*speed*/) const {
        return restitution(p, mass);
    }
    /// The strongest pull that a contact can exert when it parts, after a largest overlap [N].
    virtual double pullOff(const ContactParameters& /*p*/, double /*reduced*/, double /*maxOverlap*/) const {
        return 0;
    }
    /// Overlap after which that pull is strongest, if it grows no more from there on.
    virtual double overlapOfStrongestPull(const ContactParameters& /*p*/, double /*reduced*/) const;
    virtual LawLanes lanes(const ContactParameters& p) const = 0;

    // --- in a step of the reference ---

    /// `overlap` is positive, or above minus the reach where the contact goes on. `memory` is the contact's history of
    /// one number [m], above 0 while there is a contact.
    virtual NormalAnswer answer(const ContactParameters& p, double overlap, double reduced, double mass,
                                double& memory) const = 0;
    /// The largest overlap of which the memory tells [m].
    virtual double largestOverlap(const ContactParameters& /*p*/, double /*reduced*/, double memory) const {
        return memory;
    }
    /// Energy that the normal direction gives back when the contact parts slowly [J]. `force` [N] is the answer's. The
    /// work of a pull may count too, so that it may be negative.
    virtual double stored(const ContactParameters& p, double overlap, double reduced, double force,
                          double memory) const = 0;
    /// Work that pressing a new contact to `overlap` takes, where it exerts `force` [J].
    virtual double arriving(const ContactParameters& /*p*/, double overlap, double /*reduced*/, double force) const {
        return force * overlap / 2;
    }
    /// Energy that the law itself loses in a step [J]: the area between the path of the force and the overlap axis,
    /// less the stored part. The path of a new contact begins at overlap zero, and that of a contact that parts ends
    /// there. Motion of the particles before or after that within the step does not count here. What an elastic law
    /// loses is an error of the time step, and no loss.
    virtual double lost(const NormalStep& step) const;
    /// Whether what the law loses is adhesion's.
    virtual bool adheres(const ContactParameters& /*p*/, double /*overlap*/, double /*force*/) const { return false; }
};

/// The laws that the program brings, in the order of laws.h.
std::span<const Law* const> laws();
/// A user's law has the closed forms only: what it answers, its file says (law_program.h).
const Law& normalLaw(NormalLaw kind);
inline const Law& normalLaw(const ContactParameters& p) {
    return normalLaw(p.law);
}

// What the law of the parameters says.
inline ContactParameters linearised(const ContactParameters& p, double mass, double reduced, double overlap) {
    return normalLaw(p).linearised(p, mass, reduced, overlap);
}
inline double reachOf(const ContactParameters& p, double reduced) {
    return normalLaw(p).reach(p, reduced);
}
inline double overlapUnder(const ContactParameters& p, double reduced, double load) {
    return normalLaw(p).overlapUnder(p, reduced, load);
}
inline double overlapOfImpact(const ContactParameters& p, double mass, double reduced, double speed) {
    return normalLaw(p).overlapOfImpact(p, mass, reduced, speed);
}
inline double restitution(const ContactParameters& p, double mass) {
    return normalLaw(p).restitution(p, mass);
}
inline double restitutionAt(const ContactParameters& p, double mass, double reduced, double speed) {
    return normalLaw(p).restitutionAt(p, mass, reduced, speed);
}
inline double pullOff(const ContactParameters& p, double reduced, double maxOverlap) {
    return normalLaw(p).pullOff(p, reduced, maxOverlap);
}
inline NormalAnswer normalAnswer(const ContactParameters& p, double overlap, double reduced, double mass,
                                 double& memory) {
    return normalLaw(p).answer(p, overlap, reduced, mass, memory);
}
inline double storedEnergy(const ContactParameters& p, double overlap, double reduced, double force, double memory) {
    return normalLaw(p).stored(p, overlap, reduced, force, memory);
}
inline double workOfFirstTouch(const ContactParameters& p, double overlap, double reduced, double force) {
    return normalLaw(p).arriving(p, overlap, reduced, force);
}

/// Reduced size a* of a contact of the radii a and b [m], b = infinity for a wall: 2 a b/(a + b), physics.md.
double reducedSize(double a, double b);

/// From ratios of sliding, rolling and torsion to stiffnesses [N/m] and dampings [kg/s].
void scaleSliders(ContactParameters& p, double k, double gamma);

/// The strongest pull of a contact that was loaded by `load` [N]. An infinite load stands for one after which the pull
/// is as strong as it can be.
double pullOffUnder(const ContactParameters& p, double reduced, double load);

/// Share of their length that the springs of sliding, rolling and torsion keep when the overlap goes from `before` to
/// `now` [m]. Where the contact gets stiffer they get shorter, so that they exert what they did. Where it gets softer
/// they keep their length, so that they exert less. Neither gives them energy (Thornton, Cummins and Cleary 2013,
/// Powder Technology 233:30). 1 under a law whose stiffness does not change.
double springsKept(const ContactParameters& p, double reduced, double mass, double before, double now);
/// The same of a contact whose stiffness goes from `was`, 0 of a new one, to `is` [N/m].
double springsKept(double was, double is);

/// The largest stiffness that a run takes from a user's law [N/m]. The trial asked at some points only. Infinite
/// without a trial.
double mostStiffness(const ContactParameters& p);

}  // namespace vkdose
