#pragma once

#include <optional>

#include "host/model/material.h"

namespace vkdose {

/// The strongest pull that a contact can exert when it parts [N], after a largest overlap of `maxOverlap`; `reduced` is
/// its reduced size a* (both in metres): k_c (k_2 - k_1)/(k_2 + k_c) min(delta_max, delta*), physics.md, "Contact law".
/// EEPA: P - f0. JKR: 3/2 pi delta gamma R*, after any overlap.
double pullOff(const ContactParameters& p, double reduced, double maxOverlap);

/// The same of a contact that was loaded by `load` [N]. An infinite load stands for one beyond the plastic limit;
/// EEPA: for the one that makes the patch as wide as it gets.
double pullOffUnder(const ContactParameters& p, double reduced, double load);

/// The adhesion k_c [N/m] with which the strongest pull after `load` is `force` [N]. Nothing if no adhesion reaches it:
/// as k_c grows the pull tends to `strongestPull`.
std::optional<double> adhesionFor(double force, const ContactParameters& p, double reduced, double load);
double strongestPull(const ContactParameters& p, double reduced, double load);

}  // namespace vkdose
