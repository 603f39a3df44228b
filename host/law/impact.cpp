#include "host/law/impact.h"

#include "host/core/vec.h"

namespace vkdose {

double restitutionOf(double zeta) {
    return zeta < 1 ? std::exp(-kPi * zeta / std::sqrt(1 - zeta * zeta)) : 0;
}

double dampingRatioFor(double e) {
    const double log = std::log(e);
    return -log / std::hypot(kPi, log);
}

}  // namespace vkdose
