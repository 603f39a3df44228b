#pragma once
// How a body moves: a closed form of time, so that a place and a velocity at any time follow from the time alone. A
// restart, or a longer step, finds the body where it would have been. A free body and a hinged one are the exceptions.

#include <limits>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "host/core/vec.h"
// behind vec.h, which says how GLM is used
#include <glm/gtc/quaternion.hpp>

namespace vkdose::geometry {

using Rotation = glm::dquat;

/// Where a body is: a point x of its frame lies at rotation x + origin.
struct Pose {
    Rotation rotation{1, 0, 0, 0};
    Vec3 origin{0};

    Vec3 toWorld(const Vec3& x) const { return rotation * x + origin; }
    Vec3 toBody(const Vec3& x) const { return glm::conjugate(rotation) * (x - origin); }
    Vec3 directionToBody(const Vec3& n) const { return glm::conjugate(rotation) * n; }
    Vec3 directionToWorld(const Vec3& n) const { return rotation * n; }
};

/// How it moves at that time: a point x of the world that is fixed to it has the velocity
/// velocity + spin x (x - centre).
struct Moving {
    Vec3 velocity{0};  ///< [m/s]
    Vec3 spin{0};      ///< [rad/s]
    Vec3 centre{0};    ///< [m]

    Vec3 at(const Vec3& x) const { return velocity + glm::cross(spin, x - centre); }
};

/// Axes are unit vectors, and they and the points stand in the world.
struct Rest {
    bool operator==(const Rest&) const = default;
};
/// Turns about the line through `through` along `axis` at `rate` [rad/s].
struct Turn {
    Vec3 axis{0, 0, 1}, through{0};
    double rate = 0;
    bool operator==(const Turn&) const = default;
};
/// Swings about a line by amplitude sin(2 pi frequency t + phase) [rad].
struct Swing {
    Vec3 axis{0, 0, 1}, through{0};
    double amplitude = 0, frequency = 0, phase = 0;  ///< [rad], [Hz], [rad]
    bool operator==(const Swing&) const = default;
};
/// Shakes along a direction by amplitude sin(2 pi frequency t + phase) [m].
struct Shake {
    Vec3 direction{0, 0, 1};
    double amplitude = 0, frequency = 0, phase = 0;  ///< [m], [Hz], [rad]
    bool operator==(const Shake&) const = default;
};
/// Goes along at `velocity` [m/s].
struct Slide {
    Vec3 velocity{0};
    bool operator==(const Slide&) const = default;
};
/// Follows a table: turned by angles about a line and moved by shifts, straight in between, at its first and last row
/// before and after. Times ascend.
struct Table {
    struct Row {
        double time = 0;   ///< [s]
        double angle = 0;  ///< [rad]
        Vec3 shift{0};     ///< [m]
        bool operator==(const Row&) const = default;
    };
    Vec3 axis{0, 0, 1}, through{0};
    std::vector<Row> rows;
    bool operator==(const Table&) const = default;
};

inline constexpr double kNoStop = std::numeric_limits<double>::infinity();

/// Moves as the forces on it say, and turns as its rows say. Its place is no function of time: who computes the forces
/// knows it.
struct Free {
    /// What is prescribed at a time of its own clock; straight in between, and as the first and the last row say before
    /// and after.
    struct Row {
        double time = 0;   ///< [s]
        double force = 0;  ///< on the body along its line [N]
        double angle = 0;  ///< about its line [rad]
        bool operator==(const Row&) const = default;
    };
    double mass = 0;                ///< [kg]
    Vec3 velocity{0};               ///< at the start [m/s]
    std::optional<Vec3> line = {};  ///< it moves only along this direction; none: anywhere
    // With a line:
    Vec3 through{0};                        ///< a point of it, about which the body turns
    std::vector<Row> rows = {};             ///< empty: no force, no turn
    double low = -kNoStop, high = kNoStop;  ///< the stops of its way along the line, from its start [m]
    // With a line or without:
    double damping = 0;  ///< this by its velocity is a force against it [kg/s]
    bool operator==(const Free&) const = default;

    double force(double time) const;  ///< [N]
};

/// Turns about a line as the torques on it say. Its angle is no function of time, either.
struct Hinge {
    /// The torque that drives it at a time of its own clock; in between as in Free::Row.
    struct Row {
        double time = 0;    ///< [s]
        double torque = 0;  ///< about the axis [N m]
        bool operator==(const Row&) const = default;
    };
    Vec3 axis{0, 0, 1}, through{0};
    double inertia = 0;                     ///< moment of inertia about the axis [kg m2]
    double rate = 0;                        ///< at the start [rad/s]
    double mass = 0;                        ///< on which gravity acts [kg]
    Vec3 centre{0};                         ///< of that mass, at the start, in the world [m]
    std::vector<Row> rows = {};             ///< empty: no torque
    double low = -kNoStop, high = kNoStop;  ///< the stops of its turn, from its start [rad]
    double damping = 0;                     ///< this by its rate is a torque against it [N m s]
    bool operator==(const Hinge&) const = default;

    double torque(double time) const;  ///< [N m]
    /// The torque of its weight about the axis when it has turned by `angle` [rad] is
    /// x cos(angle) + y sin(angle) [N m].
    glm::dvec2 weight(const Vec3& gravity) const;
};

/// The speed with which a body comes no farther than to its stops in a time step: along a line [m/s] or about one
/// [rad/s]. `way`: so far, in the unit of the stops.
double stoppedAt(double low, double high, double way, double speed, double timeStep);
/// A body so near to its stop is at it [m], [rad]: a device knows its place to less than that.
inline constexpr double kAtStop = 1e-7;

using Motion = std::variant<Rest, Turn, Swing, Shake, Slide, Table, Free, Hinge>;

/// The time after which a motion repeats itself [s]. Absent for a table, and for what never comes back.
std::optional<double> periodOf(const Motion& motion);

/// When a motion goes on: in intervals [from, to) of the run's time [s], in order and apart. Outside of them the body
/// stands where it is, and its own clock with it. No interval: always.
struct Schedule {
    struct Interval {
        double from = 0, to = 0;
        bool operator==(const Interval&) const = default;
    };
    std::vector<Interval> intervals;
    bool operator==(const Schedule&) const = default;

    /// The time for which the motion has gone on until `time` [s].
    double elapsed(double time) const;
    bool active(double time) const;
};

/// A body's place in its case and its motion from there.
struct Course {
    Pose start;
    Motion motion;
    Schedule schedule;

    Pose pose(double time) const;
    Moving moving(double time) const;
    /// What drives a body that moves freely: the force along its line [N], or the torque about its hinge [N m]; zero
    /// for others.
    double drive(double time) const;
};

/// A pose turned about the line through `through` along `axis` by `angle` [rad].
Pose turned(const Pose& pose, const Vec3& axis, const Vec3& through, double angle);

/// Upper bound of the way that any point within `radius` [m] of `centre`, a point of the body's frame, goes from
/// `time` to `time` + `duration` [m]. From it a device knows when the contacts with the body have to be sought anew.
double wayBound(const Course& course, const Vec3& centre, double radius, double time, double duration);

/// Why a motion cannot be: an axis that is no unit vector, times that do not ascend, numbers that are not finite. Empty
/// if it can.
std::string motionFault(const Motion& motion);
std::string scheduleFault(const Schedule& schedule);

}  // namespace vkdose::geometry
