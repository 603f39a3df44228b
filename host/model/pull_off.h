#pragma once

#include "host/model/material.h"

namespace vkdose {

/// The strongest pull that a contact can exert when it parts [N], after a largest overlap of `maxOverlap`; `reduced` is
/// its reduced size a* (both in metres): k_c (k_2 - k_1)/(k_2 + k_c) min(delta_max, delta*), physics.md, "Contact law".
double pullOff(const ContactParameters& p, double reduced, double maxOverlap);

}  // namespace vkdose
