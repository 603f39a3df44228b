#pragma once
// Normal force: linear hysteretic adhesive law (physics.md, "Contact law"; Luding 2008, Granular Matter 10:235).

#include "host/model/material.h"

namespace vkdose::reference {

/// Force without damping, repulsive positive [N]. `overlap` delta > 0 and `reduced` 2 a_i a_j / (a_i + a_j) (wall:
/// 2 a_i) in metres. `maxOverlap` is the history delta_max [m]: it grows while loading and is pulled back on the
/// adhesive branch. Needs k1 <= k2Max; with k1 == k2Max the contact is a linear spring.
double normalForce(const ContactParameters& p, double overlap, double reduced, double& maxOverlap);

/// Slope k_2 of the line on which a contact with this history unloads [N/m]. The contact gives back the energy
/// f^2 / (2 k_2) when f falls to zero.
double unloadingStiffness(const ContactParameters& p, double reduced, double maxOverlap);

/// Whether `force` [N], from `normalForce`, is the largest pull that the overlap allows.
bool onAdhesiveBranch(const ContactParameters& p, double overlap, double force);

}  // namespace vkdose::reference
