#pragma once
// The laws of the normal force, and how stiff and damped they make a contact in the other directions.

#include "host/model/material.h"

namespace vkdose::reference {

/// What a law says of a contact.
struct NormalAnswer {
    double force;                    ///< along the normal, without damping, repulsive positive [N]
    double gamma;                    ///< damping of the normal direction [kg/s]
    double pull;                     ///< largest adhesive force at this overlap [N]
    double kt, kr, kTo;              ///< stiffness of sliding, rolling, torsion [N/m]
    double gammaT, gammaR, gammaTo;  ///< their damping [kg/s]
    bool springAlone;                ///< while sliding, rolling or torsion slips (FrictionElement)
};

/// The answer of the law that `p` names. `overlap` delta > 0, or above -reachOf (normal_law.h) where the contact goes
/// on, and `reduced` 2 a_i a_j / (a_i + a_j) (wall: 2 a_i) in
/// metres, `mass` the reduced mass [kg]. `memory` is the contact's history of one number [m], above 0 while there is a
/// contact.
NormalAnswer normalAnswer(const ContactParameters& p, double overlap, double reduced, double mass, double& memory);

/// Share of their length that the springs of sliding, rolling and torsion keep when the overlap goes from `before` to
/// `now` [m]. Where the contact gets stiffer they get shorter, so that they exert what they did. Where it gets softer
/// they keep their length, so that they exert less. Neither gives them energy (Thornton, Cummins and Cleary 2013,
/// Powder Technology 233:30). 1 under a law whose stiffness does not change.
double springsKept(const ContactParameters& p, double reduced, double mass, double before, double now);
/// The same of a contact whose stiffness goes from `was`, 0 of a new one, to `is` [N/m].
double springsKept(double was, double is);

/// Energy that the normal direction gives back when the contact parts slowly [J]. `force` [N] is the answer's. Under
/// EEPA and JKR the work of the pull counts too, so that it may be negative.
double storedEnergy(const ContactParameters& p, double overlap, double reduced, double force, double memory);

/// Work that pressing a new contact to `overlap` takes, where it exerts `force` [J].
double workOfFirstTouch(const ContactParameters& p, double overlap, double reduced, double force);

/// Whether the law itself loses energy. What an elastic law loses is an error of the time step.
bool losesEnergy(NormalLaw law);

/// Whether the law loses energy as a contact comes about and nowhere else.
bool losesAtTouchAlone(NormalLaw law);

/// Whether a contact that parts takes the path that its stored energy is the area of, so that it loses nothing more.
bool partsOnStoredPath(NormalLaw law);

/// Luding's law (physics.md, "Contact law"; Luding 2008, Granular Matter 10:235): force without damping, repulsive
/// positive [N]. `overlap` and `reduced` as above. `maxOverlap` is the history delta_max [m]: it grows while loading
/// and is pulled back on the adhesive branch. Needs k1 <= k2Max; with k1 == k2Max the contact is a linear spring.
double normalForce(const ContactParameters& p, double overlap, double reduced, double& maxOverlap);

/// Slope k_2 of the line on which a contact with this history unloads [N/m]. The contact gives back the energy
/// f^2 / (2 k_2) when f falls to zero.
double unloadingStiffness(const ContactParameters& p, double reduced, double maxOverlap);

/// Whether what the law loses is adhesion's: on the adhesive branch of Luding's law, where `force` [N] is the largest
/// pull that the overlap allows, and always under JKR.
bool onAdhesiveBranch(const ContactParameters& p, double overlap, double force);

}  // namespace vkdose::reference
