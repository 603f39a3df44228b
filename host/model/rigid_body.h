#pragma once
// A body of the user's own: a rigid thing that spheres touch, with a place and a motion.

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "geometry/motion.h"
#include "geometry/shape.h"
#include "host/model/material.h"
#include "host/model/phase.h"

namespace vkdose {

/// What a body's motion follows.
enum class Clock {
    Time,    ///< the time since load [s]
    Drive,   ///< the angle of the drive since load [rad]: the motion goes on while powder is dosed, and with its speed
    Phases,  ///< a clock of its own, which runs in some phases of the schedule and stands in all others [s]
    Forces,  ///< the forces on the body: it moves freely (geometry::Free, geometry::Hinge); what drives it follows
             ///< time, or its own clock
};

/// A body that moves freely. Velocity and rate belong to half a step before; before the first step, to the instant.
struct FreeBody {
    Vec3 shift{0};     ///< from its place at the start, if it has no hinge [m]
    Vec3 velocity{0};  ///< likewise [m/s]
    double angle = 0;  ///< about its hinge from its start, if it has one [rad]
    double rate = 0;   ///< likewise [rad/s]
};

/// How far a body has come by what neither time nor drive tells.
struct Moved {
    double time = 0;   ///< on its own clock, if it has one [s]
    Vec3 shift{0};     ///< from its place at the start, if it moves freely [m]
    double angle = 0;  ///< about its hinge, likewise [rad]

    Moved() = default;
    Moved(double t) : time(t) {}  // NOLINT(google-explicit-constructor): most bodies have a clock or nothing
    explicit Moved(const Vec3& way) : shift(way) {}
    /// On its own clock, and as it has moved freely.
    Moved(double t, const FreeBody& free) : time(t), shift(free.shift), angle(free.angle) {}
    friend bool operator==(const Moved&, const Moved&) = default;
};

/// The clock of a body that moves in phases.
struct BodyClock {
    static constexpr std::uint64_t kNever = std::numeric_limits<std::uint64_t>::max();

    std::uint64_t steps = 0;        ///< time steps that it has counted
    bool runs = false;              ///< it counts on; else it stands
    std::uint64_t anewAt = kNever;  ///< the count at which it starts anew, once

    /// Its count `more` steps later, if it runs on or stands until then.
    std::uint64_t after(std::uint64_t more) const {
        const std::uint64_t count = steps + (runs ? more : 0);
        return count >= anewAt ? count - anewAt : count;
    }
};

struct RigidBody {
    std::string name;
    std::vector<geometry::Shape> shapes;  ///< in the frame of the body [m]
    geometry::Course course;
    Clock clock = Clock::Time;
    int material = kWallMaterial;  ///< World::materials
    /// In which its own clock runs. Of Clock::Phases, and of a body that is free and turns, or is driven, in phases.
    std::vector<Phase> phases{};
    bool anew = false;  ///< a table starts anew when the first of `phases` begins, once it has come to its end
    // What contacts see of it; its books see the true motion.
    bool surfaceMoves = true;  ///< the velocity of its surface; false: they see it at rest
    double curvature = 0;      ///< radius of its surface, which a* counts [m]; 0: it is as flat as a wall
    int pockets = 0;  ///< of a wheel that turns: it repeats itself so often in a turn; 0: the case does not say

    bool movesFreely() const { return clock == Clock::Forces; }
    bool movesInPhases() const { return clock == Clock::Phases || !phases.empty(); }
    bool rests() const { return std::holds_alternative<geometry::Rest>(course.motion); }
    /// Whether the two stay as they are to each other: both rest, or both follow the same motion.
    bool movesAs(const RigidBody& other) const;
    /// Of a body that moves freely: the first step in which it does.
    std::uint64_t firstFreeStep(double timeStep) const;
    /// For how much of a step the forces act on it [s]: for half of the first one, as on particles.
    double kickOf(std::uint64_t step, double timeStep) const;
    /// Where the body is. `driveAngle` [rad].
    geometry::Pose pose(double time, double driveAngle, const Moved& own = {}) const;
    /// How it moves there; of a body that moves freely, how its table turns it. `driveRate` [rad/s]; `own` is the time
    /// on its own clock, if it moves in phases [s], none while that clock stands.
    geometry::Moving moving(double time, double driveAngle, double driveRate, std::optional<double> own = {}) const;
    /// What drives it then, if it moves freely: along its line [N] or about its hinge [N m]; `own` likewise.
    double driveOf(double time, std::optional<double> own = {}) const;
    /// One over the mass that a contact at `x` with this unit normal sees in it, if it moves freely [1/kg].
    double perMass(const Vec3& x, const Vec3& normal) const;
    /// Of a body that moves freely about a hinge its motion; null for others.
    const geometry::Hinge* hinge() const { return std::get_if<geometry::Hinge>(&course.motion); }
    /// The direction of the axis about which the body's torque is told: that of its motion, or +z.
    Vec3 axis() const;
    /// A point on that axis, in the world: on the axis of its motion, or the origin of its frame.
    Vec3 pivot(const geometry::Pose& pose) const;
};

/// The clock of a body; without clocks it stands at 0.
BodyClock clockOf(std::span<const BodyClock> clocks, std::size_t body);
/// Counts the clocks on by so many steps.
void advanceClocks(std::vector<BodyClock>& clocks, std::uint64_t steps);

/// Whether one of the bodies follows the drive.
bool followsDrive(const std::vector<RigidBody>& bodies);
/// Whether one of the bodies moves in phases.
bool movesInPhases(const std::vector<RigidBody>& bodies);
/// Whether one of the bodies moves in the phases in which powder is dosed, with the drive or by itself.
bool movesInDoses(const std::vector<RigidBody>& bodies);
/// Whether one of the bodies moves freely.
bool moveFreely(const std::vector<RigidBody>& bodies);
/// All bodies at their start. Entries of bodies that do not move freely are unspecified.
std::vector<FreeBody> freeAtStart(const std::vector<RigidBody>& bodies);

/// Most bodies of a world.
inline constexpr std::size_t kMaxBodies = 16;

}  // namespace vkdose
