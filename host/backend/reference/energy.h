#pragma once
// The energy of a contact in a step. Each part of its force takes some energy from the motion, stores some of it in its
// spring and loses the rest. EnergyBook in backend.h gives the balance that this closes.

#include "host/backend/backend.h"
#include "host/backend/reference/contact.h"

namespace vkdose::reference {

/// Energy in the springs of a contact [J].
struct Elastic {
    double normal = 0, sliding = 0, rolling = 0, torsion = 0;
    double sum() const { return normal + sliding + rolling + torsion; }
};

/// Energy stored by a contact at `overlap` [m] that exerts `parts` with this history.
Elastic elasticEnergy(const ContactParameters& p, const Parts& parts, double overlap, double reduced,
                      const History& history);

/// The force of a contact in a step and its place, kept until the next step. It is zero if the contact did not touch.
/// Without an energy book only the force is kept.
struct Exerted {
    bool touching = false;
    Vec3 normal{0};
    double overlap = 0;         ///< [m]
    Vec3 leverI{0}, leverJ{0};  ///< for a wall leverJ leads to the contact point from the wall's centre of turning [m]
    Parts parts{};
    Elastic elastic;
    Vec3 force{0};  ///< on i [N]
};

/// What a wall did to a particle in the half step after it exerted `e`, while it moved as `j` [J].
double halfStepGiven(const Exerted& e, const Body& j, double dt);

/// Books the step of a contact that exerted `before` at the step's start (does not touch: a new contact) and exerts
/// `now` at its end (does not touch: it has parted). `i` and `j` move as they did during the step of `dt` [s].
void bookContact(const Exerted& before, const Exerted& now, const Body& i, const Body& j, double dt, EnergyBook& book);

/// Books the first step of a contact that touched when it was loaded. The energy in the normal spring came with the
/// load. The energy that a slider's dashpot puts into its spring counts against friction, as in any new contact.
void bookLoaded(const Exerted& now, EnergyBook& book);

/// Books a contact that ends because `i` or `j` has left the motion. Pass the body that has left as at rest, and the
/// body that stays as it moved during the step.
void bookDeparture(const Exerted& before, const Body& i, const Body& j, double dt, EnergyBook& book);

/// Adds the energy in the contact's springs.
void addElastic(const Elastic& elastic, EnergyBook& book);

}  // namespace vkdose::reference
