#pragma once
// What a law of the normal force says before a run: closed forms by which time steps, overlaps and impacts are judged.
// physics.md has the laws themselves, host/backend/reference/normal.h computes them.

#include "host/model/world.h"

namespace vkdose {

/// An elastic material.
struct Elasticity {
    double modulus = 0;  ///< Young's modulus E [Pa]
    double poisson = 0;  ///< Poisson's ratio [-]
};

/// 2 sqrt(5/6): with the damping kHertzDamping * beta * sqrt(m* df/d delta) the restitution of an impact does not
/// depend on its speed (Tsuji 1992). It is that of a linear contact with the share beta of critical damping, exactly
/// (Antypov and Elliott 2011, EPL 94:50004).
inline constexpr double kHertzDamping = 1.8257418583505538;

/// Hertz-Mindlin between bodies of two materials: E*, and what follows from the restitution 0 < e <= 1 and from
/// Poisson's ratios. Friction and the ratios of rolling and torsion are those of `rest`.
ContactParameters hertzMindlin(const Elasticity& a, const Elasticity& b, double restitution,
                               const ContactParameters& rest = {});

/// EEPA (host/model/eepa.h) between bodies of two materials. `rest` has surface energy, plasticity ratio, constant pull
/// and exponent as well. With a plasticity ratio of 0 and no pull the law is that of Hertz and Mindlin.
ContactParameters elastoPlasticAdhesive(const Elasticity& a, const Elasticity& b, double restitution,
                                        const ContactParameters& rest);

/// JKR (host/model/jkr.h) between bodies of two materials. `rest` has the surface energy as well; without it the law is
/// that of Hertz and Mindlin.
ContactParameters elasticAdhesive(const Elasticity& a, const Elasticity& b, double restitution,
                                  const ContactParameters& rest);

/// Stiffness of the normal direction df/d delta of Hertz's law, 2 E* sqrt(R* delta) [N/m]; `reduced` is a* = 2 R* [m].
double hertzStiffness(const ContactParameters& p, double reduced, double overlap);

/// The linear springs and dashpots that a contact of the reduced mass `mass` [kg] acts like at this overlap [m]: k1 on
/// loading, k2Max the steepest on the way back. Luding's law is linear already, and is given back as it is. JKR: the
/// stiffness 2 E* a of the contact radius a, which is more than the law's own where the surfaces pull. Of a user's law
/// the stiffness and the damping are the largest that its trial found.
ContactParameters linearised(const ContactParameters& p, double mass, double reduced, double overlap);

/// How far beyond touch a contact that has come about holds on [m]: it is lost when its overlap falls to minus the
/// reach. 0 under most laws. `reduced` as above; the reach grows with it, or is the same for all.
double reachOf(const ContactParameters& p, double reduced);

/// The longest reach of any contact that can occur, of spheres no larger than `largest` [m], also with walls.
double longestReach(const World& world, const ContactLaw& law, double largest);

/// Overlap of a contact that has been loaded for the first time by `load` >= 0 [N], in metres.
double overlapUnder(const ContactParameters& p, double reduced, double load);

/// Largest overlap of a first impact at `speed` [m/s] without damping and friction, in metres. Luding's law: on k1.
/// EEPA: on Hertz's line, with the work of the constant pull. JKR: on the path from touch. A user's law: on a line of
/// the largest stiffness that its trial found.
double overlapOfImpact(const ContactParameters& p, double mass, double reduced, double speed);

/// What a backend says of a law whose contacts reach farther than those of the law that was loaded.
inline constexpr const char* kReachesFarther = "the new law of the contacts reaches farther than the loaded one";

}  // namespace vkdose
