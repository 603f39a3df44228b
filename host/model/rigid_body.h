#pragma once
// A body of the user's own: a rigid thing that spheres touch, with a place and a motion.

#include <string>
#include <vector>

#include "geometry/motion.h"
#include "geometry/shape.h"
#include "host/model/material.h"

namespace vkdose {

/// What a body's motion follows.
enum class Clock {
    Time,  ///< the time since load [s]
    Drive  ///< the angle of the drive since load [rad]: the motion goes on while powder is dosed, and with its speed
};

struct RigidBody {
    std::string name;
    std::vector<geometry::Shape> shapes;  ///< in the frame of the body [m]
    geometry::Course course;
    Clock clock = Clock::Time;
    ContactClass kind = ContactClass::ParticleWall;

    /// Where the body is. `driveAngle` [rad].
    geometry::Pose pose(double time, double driveAngle) const;
    /// How it moves there. `driveRate` [rad/s].
    geometry::Moving moving(double time, double driveAngle, double driveRate) const;
    /// The direction of the axis about which the body's torque is told: that of its motion, or +z.
    Vec3 axis() const;
    /// A point on that axis, in the world: on the axis of its motion, or the origin of its frame.
    Vec3 pivot(const geometry::Pose& pose) const;
};

/// Whether one of the bodies follows the drive.
bool followsDrive(const std::vector<RigidBody>& bodies);

/// Most bodies of a world.
inline constexpr std::size_t kMaxBodies = 16;

}  // namespace vkdose
