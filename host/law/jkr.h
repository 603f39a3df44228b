#pragma once
// Elastic adhesive spheres (Johnson, Kendall and Roberts 1971, Proc. R. Soc. A 324:301), in the closed form of Chokshi,
// Tielens and Hollenbach (1993, Astrophys. J. 407:806). physics.md, "Elastic adhesive spheres".

#include "host/law/hertz.h"

namespace vkdose {

/// Between bodies of two materials. `rest` has the surface energy as well; without it the law is that of Hertz and
/// Mindlin.
inline ContactParameters elasticAdhesive(const Elasticity& a, const Elasticity& b, double restitution,
                                         const ContactParameters& rest) {
    return ofModuli(NormalLaw::Jkr, a, b, restitution, rest);
}

/// A contact of two bodies. It comes about at the overlap 0 and is lost at -reach; between them force and energy are
/// those of the stable path. Overlaps below -reach count as -reach.
struct JkrContact {
    double modulus;     ///< E* [Pa]
    double size;        ///< R* [m]
    double freeRadius;  ///< a0, contact radius of the contact that bears no load; 0 without adhesion [m]
    double pullOff;     ///< Fc, the strongest pull [N]
    double reach;       ///< delta_c [m]

    /// `reduced` a* = 2 R* [m].
    JkrContact(const ContactParameters& p, double reduced);

    double radius(double overlap) const;  ///< a, contact radius [m]
    double force(double overlap) const;   ///< without damping, repulsive positive [N]
    /// Area under the path from -reach to the overlap: what the contact gives back if it parts slowly [J]. Negative
    /// where it pulls.
    double energy(double overlap) const;
    /// Overlap of a contact that bears `load` >= -pullOff [m].
    double overlapUnder(double load) const;
};

}  // namespace vkdose
