#include "host/model/pull_off.h"

#include <algorithm>

namespace vkdose {

double pullOff(const ContactParameters& p, double reduced, double maxOverlap) {
    if (p.k2Max <= p.k1) return 0;  // one stiffness: no adhesive branch
    const double limit = p.k2Max / (p.k2Max - p.k1) * p.plasticityDepth * reduced;
    const double acting = std::min(maxOverlap, limit);
    const double stiffer = (p.k2Max - p.k1) * (limit > 0 ? acting / limit : 1);  // k_2 - k_1
    return p.kc * stiffer / (p.k1 + stiffer + p.kc) * acting;
}

}  // namespace vkdose
