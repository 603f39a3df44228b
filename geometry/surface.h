#pragma once
// The fixed surfaces a particle can touch. Frame: x = width, y = up, z = along the coil axis, outlet at +z;
// the coil axis is the line x = y = 0. Metres, double precision.

#include <limits>
#include <variant>

#include "host/core/vec.h"

namespace vkdose::geometry {

/// Closest point of a surface to a query point.
struct Closest {
    Vec3 point;       ///< on the surface [m]
    Vec3 normal;      ///< unit, from the surface towards the free side
    double distance;  ///< signed: negative when the query point lies behind the surface [m]
};

/// Infinite half space; particles live where dot(q - point, normal) > 0.
struct Plane {
    Vec3 point;
    Vec3 normal;  ///< unit, into the free side
};

/// U-shaped profile along z: below the axis (y < 0) the inside of a cylinder of radius `halfWidth`, above it the
/// planes x = -+halfWidth, joined tangentially. A sphere smaller than the profile has one contact with it, which
/// keeps its history while it slides from the trough up the wall.
struct Trough {
    double halfWidth;
};

/// Cylinder wall of finite or infinite length, touched from inside or outside. Beyond an end the closest point
/// lies on that end's circular edge.
struct Tube {
    Vec3 base{0};  ///< centre of the first end (any point of the axis when infinite)
    Vec3 axis{0, 0, 1};  ///< unit
    double radius = 0;
    double length = std::numeric_limits<double>::infinity();
    bool inside = true;  ///< particles live inside
};

/// Front wall plane z = `z` with a circular hole of radius `holeRadius` around the coil axis, and behind it the
/// throat: the inside of a cylinder of the same radius, z ... z + throatLength. The rim is the edge they share.
struct Front {
    double z;
    double holeRadius;
    double throatLength;
};

using Surface = std::variant<Plane, Trough, Tube, Front>;

/// Closest point of `surface` to `q`. The distance is finite for every finite q.
Closest closestPoint(const Surface& surface, const Vec3& q);

}  // namespace vkdose::geometry
