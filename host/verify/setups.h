#pragma once
// Worlds and arithmetic that the cases share. The sphere is the mean one of the paper unless a case says otherwise.

#include <cmath>

#include "host/sim/energy_ledger.h"
#include "host/verify/suite.h"

namespace vkdose::verify {

inline constexpr double kRadius = 1.25e-3;   // [m]
inline constexpr double kDensity = 1427;     // [kg/m3]
inline constexpr double kGravity = 9.81;     // [m/s2]
inline constexpr double kK2Max = 24067;      // [N/m], and with it the paper's ratios:
inline constexpr double kK1 = kK2Max / 5;    // [N/m]
inline constexpr double kPlasticity = 0.05;  // phi_f

double massOf(double radius);     ///< [kg]
double inertiaOf(double radius);  ///< of a full sphere [kg m2]

/// A linear spring with damping `gamma` [kg/s], without friction and adhesion.
ContactParameters spring(double k, double gamma = 0);

/// The same parameters for every class of contact.
ContactLaw lawOf(const ContactParameters& p);

/// Empty space without gravity.
RuledWorld space(const ContactParameters& p, double timeStep);

/// The floor y = 0 under gravity that pulls by `gravity` [m/s2], `tilt` [rad] from the vertical towards +x.
RuledWorld floor(const ContactParameters& p, double timeStep, double gravity = kGravity, double tilt = 0);

/// A mesh for spheres up to 1.5 kRadius.
geometry::Shape meshOf(const std::vector<geometry::Triangle>& triangles);

RigidBody bodyOf(std::vector<geometry::Shape> shapes, geometry::Motion motion = geometry::Rest{});

/// Parameters with friction, rolling, torsion, damping, adhesion and plasticity all at once, and a cluster of 31
/// spheres. The spheres are thrown at its middle, so that they collide within a few milliseconds (momentum.cpp).
ContactParameters everyInteraction();
Particles collapsingCluster();

/// Loads a world and counts its steps.
class Trial {
  public:
    Trial(Stage& stage, const RuledWorld& world, const Particles& particles);

    Sensors advance(std::uint64_t steps, double coilRate = 0);
    /// Advances to the step that is nearest to `seconds` from the load.
    Sensors advanceTo(double seconds, double coilRate = 0);

    /// Positions belong to `time()`, velocities and spins to `halfStep()`.
    const Particles& now() const { return now_; }
    /// The ledger of the calls so far, if the world keeps the book.
    const EnergyLedger& energy() const { return energy_; }
    std::vector<Contact> contacts() const { return backend_->contacts(); }
    /// The bodies that move freely; none for others. Their velocities belong to `halfStep()`.
    std::vector<FreeBody> freeBodies() const { return backend_->freeBodies(); }
    double time() const { return static_cast<double>(steps_) * timeStep_; }
    double halfStep() const { return time() - timeStep_ / 2; }

  private:
    Backend* backend_;
    Particles now_;
    EnergyLedger energy_;
    double timeStep_;
    std::uint64_t steps_ = 0;
};

/// A sphere that a plane throws back while it slips throughout: its ledger, and what is expected of it [J].
struct SlippingImpact {
    EnergyLedger ledger;
    double energy = 0;    ///< before the impact
    double normal = 0;    ///< what the law takes from the motion along the normal
    double friction = 0;  ///< what friction takes
};

/// Plays it in `world`, to which the plane is added. `along` and `towards` the plane are the sphere's speeds [m/s], and
/// the law gives back the share `restitution` of the second. Friction takes the impulse mu (1 + e).
SlippingImpact slippingImpact(Stage& stage, RuledWorld world, double radius, double along, double towards,
                              double restitution, std::uint64_t steps);

/// Root of `f` in [low, high], where it changes sign.
template <class F>
double root(F f, double low, double high) {
    const bool rising = f(low) < 0;
    for (int i = 0; i < 200; ++i) {
        const double middle = (low + high) / 2;
        ((f(middle) < 0) == rising ? low : high) = middle;
    }
    return (low + high) / 2;
}

}  // namespace vkdose::verify
