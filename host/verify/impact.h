#pragma once
// An impact of two elastic spheres, integrated for itself in double precision: what tests 5 to 8 of Chung and Ooi are
// held against where no closed form is known. It knows the materials alone and shares nothing with the laws, time steps
// and contacts of the backends.

namespace vkdose::verify {

/// One of two spheres that meet, the upper or the lower. A plane has an infinite radius, what is held fast an infinite
/// mass.
struct Striker {
    double modulus = 0, poisson = 0;  ///< Young's modulus [Pa], Poisson's ratio
    double radius = 0, mass = 0;      ///< [m], [kg]
    double along = 0;                 ///< speed along the tangent [m/s]
    double spin = 0;                  ///< [rad/s], so that the surface of the upper one moves with +spin * radius
};

struct AfterImpact {
    double apart = 0;  ///< speed at which the centres part [m/s]
    double alongUpper = 0, spinUpper = 0;
    double alongLower = 0, spinLower = 0;
};

/// The impact at the speed `towards` [m/s] along the normal. Hertz's force and Mindlin's stiffness 8 G* sqrt(R* delta)
/// without slip act with the damping of Tsuji, Tanaka and Ishida (1992) for the restitution 0 < e <= 1. The spring
/// exerts what it did while its stiffness grows, and keeps its length while it falls. A slider limits the tangential
/// force to mu times Hertz's force. Lever arms are the radii less half the overlap. The normal does not turn. Runge and
/// Kutta's scheme, 20,000 steps to the undamped duration.
AfterImpact impactOf(const Striker& upper, const Striker& lower, double restitution, double friction, double towards);

}  // namespace vkdose::verify
