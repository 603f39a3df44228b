#pragma once
// Restitution of the contact law, and the damping that gives a wanted one.

#include "host/model/material.h"

namespace vkdose {

/// Reduced size a* of a contact of the radii a and b [m], b = infinity for a wall: 2 a b/(a + b), physics.md.
double reducedSize(double a, double b);

/// Restitution of the spheres a and b [m] (infinite: a wall) on k1, damping alone: exp(-pi zeta/sqrt(1 - zeta^2)) with
/// zeta = gamma/(2 sqrt(k1 m12)); 0 if overdamped. It is the limit of slow impacts. Hertz-Mindlin: that of any impact;
/// EEPA, JKR: the one that damping is made for, of an impact that leaves Hertz's line neither flattened nor sticking.
double restitution(const ContactParameters& p, double density, double a, double b);
/// The same of a reduced mass [kg].
double restitution(const ContactParameters& p, double mass);

/// The damping gamma [kg/s] that gives this restitution, 0 < e <= 1, to slow impacts of the spheres a and b.
double dampingFor(double e, const ContactParameters& p, double density, double a, double b);
/// The same of a reduced mass [kg].
double dampingFor(double e, const ContactParameters& p, double mass);

/// The share zeta of critical damping at which damping alone gives the restitution e, 0 < e <= 1.
double dampingRatioFor(double e);

/// Restitution of a head-on impact at `speed` [m/s] under the whole law: damping, plasticity and adhesion. `mass` is
/// the reduced mass [kg], `reduced` the reduced size [m]. 0 if the two stick or are overdamped. A speed of 0 stands
/// for the limit of slow impacts. The impact is integrated; the error is below 1e-4.
double restitutionAt(const ContactParameters& p, double mass, double reduced, double speed);

}  // namespace vkdose
