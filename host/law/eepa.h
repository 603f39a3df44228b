#pragma once
// Edinburgh's elasto-plastic adhesive contact (Morrissey 2013; Thakur et al. 2014). physics.md, "Elasto-plastic
// adhesive spheres".

#include "host/law/hertz.h"

namespace vkdose {

/// Between bodies of two materials. `rest` has surface energy, plasticity ratio, constant pull and exponent as well.
/// With a plasticity ratio of 0 and no pull the law is that of Hertz and Mindlin.
inline ContactParameters elastoPlasticAdhesive(const Elasticity& a, const Elasticity& b, double restitution,
                                               const ContactParameters& rest) {
    return ofModuli(NormalLaw::Eepa, a, b, restitution, rest);
}

/// The path on which a contact unloads and loads again, once it has been pressed to a largest overlap. It has no memory
/// of its own: the contact goes back and forth on it, until it is pressed deeper.
struct EepaPath {
    double constant;   ///< f0, not positive [N]
    double unloading;  ///< k2 [N/m^(3/2)]
    double flattened;  ///< delta_p, where the unloading line crosses f0 [m]
    double pull;       ///< P, the strongest pull beside the constant one [N]
    double pole;       ///< delta_min, where the contact pulls most [m]
    double exponent;   ///< chi [-]

    double force(double overlap) const;   ///< without damping, repulsive positive [N]
    double pullAt(double overlap) const;  ///< of the adhesive branch, continued beyond the pole [N]
    double energy(double overlap) const;  ///< area under the path from 0, what the contact gives back if it parts [J]
};

/// `reduced` a* = 2 R* and `maxOverlap`, both in metres.
EepaPath eepaPath(const ContactParameters& p, double reduced, double maxOverlap);

}  // namespace vkdose
