#pragma once
// Luding's law: linear, hysteretic, adhesive (Luding 2008, Granular Matter 10:235). physics.md, "Contact law".

#include <optional>

#include "host/law/law.h"

namespace vkdose {

/// Force without damping, repulsive positive [N]. `maxOverlap` is the history delta_max [m]: it grows while loading and
/// is pulled back on the adhesive branch. Needs k1 <= k2Max; with k1 == k2Max the contact is a linear spring.
double normalForce(const ContactParameters& p, double overlap, double reduced, double& maxOverlap);

/// Slope k_2 of the line on which a contact with this history unloads [N/m]. The contact gives back the energy
/// f^2 / (2 k_2) when f falls to zero.
double unloadingStiffness(const ContactParameters& p, double reduced, double maxOverlap);

/// The damping gamma [kg/s] that gives this restitution, 0 < e <= 1, to slow impacts of the reduced mass [kg].
double dampingFor(double e, const ContactParameters& p, double mass);

/// The adhesion k_c [N/m] with which the strongest pull after `load` [N] is `force` [N]. Nothing if no adhesion reaches
/// it: as k_c grows the pull tends to `strongestPull`.
std::optional<double> adhesionFor(double force, const ContactParameters& p, double reduced, double load);
double strongestPull(const ContactParameters& p, double reduced, double load);

}  // namespace vkdose
