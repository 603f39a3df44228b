#pragma once
// The promises of a backend. A backend holds a world and its particles, advances them n steps, and returns reduced
// sensors and state. The interface is coarse on purpose, so that no function of it is called inside the step loop.
//
// One step (leapfrog = velocity Verlet with half-step velocities in the contact law):
//   forces from x(n), v(n-1/2); springs advance by v dt; v(n+1/2) = v(n-1/2) + dt a; x(n+1) = x(n) + dt v(n+1/2).
// The very first step of a load kicks by dt/2 and leaves the springs at rest, because the loaded velocity is v(0).

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "host/core/record.h"
#include "host/model/field.h"
#include "host/model/particles.h"
#include "host/model/world.h"

namespace vkdose {

enum class Region { Canister = 0, Throat = 1, Dosed = 2, Lost = 3 };
inline constexpr int kRegions = 4;

/// The energies of the system and their changes [J]. The book is kept if World::energyBook asks for it. Energies belong
/// to the full step n at which forces last acted: they use the positions x(n), the springs at that time, and the
/// product of the half-step velocities around it, m/2 v(n-1/2).v(n+1/2). With these, the leapfrog obeys an exact
/// balance (exact apart from rounding):
///
///   change of (motion + potential + elastic) = loaded + coilWork + bodyWork - all losses - left,
///
/// in which bodies have no energy. That of a body that moves freely, likewise at the full step, falls by its bodyWork.
///
/// The reason is that summation by parts turns the work of a contact force into (F(n-1) + F(n))/2 . v(n-1/2) dt. Each
/// contact books this work for every part of its force, with its own relative motion as the velocity.
struct EnergyBook {
    // At the instant.
    double kinetic = 0, rotational = 0;
    double potential = 0;  ///< in gravity, zero at the origin
    double elasticNormal = 0, elasticSliding = 0, elasticRolling = 0, elasticTorsion = 0;
    Vec3 momentum{0};         ///< of active particles, half-step velocities [kg m/s]
    Vec3 angularMomentum{0};  ///< about the origin, spins included [kg m2/s]

    // During the call. A loss is the energy that a part of the force took from the motion and did not store in its
    // spring.
    double plastic = 0;  ///< by the normal force off the adhesive branch
    double adhesive =
        0;  ///< by the normal force on the adhesive branch, where k_c falls, and where JKR's contacts come about
    double viscous = 0;  ///< by normal damping, and by the dashpots of sliders that stick
    double sliding = 0, rolling = 0,
           torsion = 0;    ///< by slipping sliders, and by springs that snap when a contact opens
    double numerical = 0;  ///< by the time step: between the true start or end of a contact and the nearest step
    double coilWork = 0;   ///< done by the coil on the particles
    double bodyWork = 0;   ///< done by moving bodies on the particles
    double left = 0;       ///< taken along by particles that were dosed or lost, energy of their contacts included
    double loaded = 0;     ///< of the loaded state, contacts included; booked in the call that makes the first step
};

/// What the particles do to one of the bodies during a call.
struct BodyLoad {
    Vec3 force{0};      ///< on the body, mean over the call [N]
    double torque = 0;  ///< on the body about its axis (RigidBody::axis), mean over the call [N m]
    double work = 0;    ///< that the body did on the particles in the call: force by velocity, step by step [J]
};

/// Reduced on the device at the end of an `advance`.
struct Sensors {
    std::array<std::uint64_t, kRegions> count{};  ///< particles per region
    std::array<double, kRegions> mass{};          ///< [kg]
    double kineticEnergy = 0;                     ///< translational, active particles, half-step velocities [J]
    double rotationalEnergy = 0;                  ///< [J]
    double coilTorque = 0;         ///< torque about +z that the particles exert on the coil, mean over the call [N m]
    std::vector<BodyLoad> bodies;  ///< of each of allBodies
    double throatMomentumZ = 0;    ///< sum of m v_z in the throat; divided by the mass there: outlet velocity [kg m/s]
    /// Mass that has gone through the end of the domain along x, y and z since the load, upwards less downwards; 0 in
    /// directions that do not repeat [kg].
    std::array<double, 3> through{};
    double maxOverlapRatio = 0;        ///< largest overlap over smaller radius seen during the call [-]
    std::uint64_t rebuilds = 0;        ///< neighbour-list builds since load
    std::optional<EnergyBook> energy;  ///< if the world asks for it and a step has been made since load
};

/// One touching contact and its history. For a wall `other` is the index of the surface, for a body the number of
/// surfaces plus the body's index in allBodies.
struct Contact {
    ContactClass kind = ContactClass::ParticleParticle;
    std::uint32_t particle = 0;  ///< the smaller index of a pair
    std::uint32_t other = 0;
    double maxOverlap = 0;  ///< delta_max; under JKR how far the contact is from being lost [m]
    Vec3 sliding{0};        ///< spring xi [m], acting on `particle`
    Vec3 rolling{0};        ///< spring rho [m]
    double torsion = 0;     ///< [m]
    Vec3 force{0};          ///< on `particle`, in the last step made since `load` or `restore` [N]; zero before any
};

/// The array of a snapshot with the number of steps since load, by which bodies in motion know the time. It may be
/// changed, for a run that goes on with another time step.
inline constexpr const char* kSnapshotSteps = "steps";

/// Velocity, half a step earlier, of a particle that is at rest after `steps` steps under this gravity [m/s]. Before
/// the first step it is zero, because a loaded velocity belongs to t = 0.
inline Vec3 velocityOfRest(double timeStep, const Vec3& gravity, std::uint64_t steps) {
    return steps > 0 ? -0.5 * timeStep * gravity : Vec3(0);
}

class Backend {
  public:
    virtual ~Backend() = default;

    /// Start over with these particles under this law. Throws RunError if they do not fit the backend's tables.
    virtual void load(const World& world, const ContactLaw& law, const Particles& particles) = 0;
    void load(const RuledWorld& world, const Particles& particles) { load(world, world.law, particles); }

    /// Replace the contact law, keeping state and history (the switch of k_c after settling). The energy book stays
    /// closed if only adhesion changes. The new law must be of the kind of the loaded one. Throws RunError if its
    /// contacts hold on farther beyond touch than those of the loaded one.
    virtual void setLaw(const ContactLaw& law) = 0;

    /// Replace gravity [m/s2] from the next step on, keeping state and history. The energy book stays closed if
    /// energyOfGravityChange is added to what was loaded.
    virtual void setGravity(const Vec3& gravity) = 0;

    /// Makes waiting particles active, from index `first` on. They are at rest at these positions now. The velocity
    /// that is stored for them is that of half a step earlier (velocityOfRest).
    virtual void addParticles(std::size_t first, const std::vector<Vec3>& positions) = 0;

    /// Sets the clocks of the world's bodies, which `advance` counts on. Those of bodies that do not move in phases are
    /// not read. After a load they stand at 0.
    virtual void setClocks(const std::vector<BodyClock>& clocks) = 0;

    /// Advance `steps` steps with the coil turning at `coilRate` [rad/s about +z]. Throws RunError on a lost particle,
    /// NaN, a full table or an overlap above the world's limit, naming the particle and the step.
    virtual Sensors advance(std::uint32_t steps, double coilRate) = 0;

    /// Particle-steps that one call of `advance` should make, in an ensemble for each member: so many that the call's
    /// own cost is nothing beside them, and so few that Ctrl-C and the progress bar answer within some seconds. The
    /// number is fixed, so that the same case makes the same calls; this one suits a CPU.
    virtual double particleStepsPerCall() const { return 4e6; }

    /// Everything that the next `advance` depends on, except the world, the radii and the clocks of bodies. After
    /// `restore` the run goes on with the same bits as if it had not been interrupted. Take it between calls of
    /// `advance`.
    virtual Record snapshot() const = 0;

    /// Puts back what `snapshot` gave, on top of a `load` of the same world and radii (and a `setLaw` or `setGravity`
    /// if there was one); clocks of bodies are to be set behind it. Throws RecordError if the record is not of this
    /// kind of backend or does not fit what was loaded.
    virtual void restore(const Record& record) = 0;

    virtual Particles particles() const = 0;
    /// Where each of the world's bodies is and how it moves. Entries of bodies that do not move freely are unspecified.
    /// Empty if none does.
    virtual std::vector<FreeBody> freeBodies() const { return {}; }
    virtual std::vector<Contact> contacts() const = 0;

    /// Coarse-grained fields of the particles that are active now, at the points of the grid. A device returns only
    /// these. Forces are those of the last step made since load or restore; before any step there are none. Throws
    /// RunError if the request cannot be met (faultOf).
    virtual FieldPoints fields(const FieldRequest& request) = 0;

    /// Rotation of the coil about +z since load [rad].
    virtual double coilAngle() const = 0;

    /// "reference" or "vulkan: llvmpipe (LLVM 15.0.6, 256 bits)".
    virtual std::string description() const = 0;
};

}  // namespace vkdose
