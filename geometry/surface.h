#pragma once
// The fixed surfaces a particle can touch. Frame: x = width, y = up, z = along the coil axis, outlet at +z;
// the coil axis is the line x = y = 0. Metres, double precision.

#include <limits>
#include <variant>

#include "geometry/shape_form.h"
#include "host/core/vec.h"

namespace vkdose::geometry {

/// Closest point of a surface to a query point.
struct Closest {
    Vec3 point{0};        ///< on the surface [m]
    Vec3 normal{0};       ///< unit, from the surface towards the free side
    double distance = 0;  ///< signed: negative when the query point lies behind the surface [m]
};

class Tessellator;  // tessellator.h

/// Some unit vector normal to the unit vector `axis`.
Vec3 anyNormal(const Vec3& axis);

constexpr double kEndless = std::numeric_limits<double>::infinity();

/// Half space; particles live where dot(q - point, normal) > 0. A plane that is parallel to z may end at z = `end`.
struct Plane {
    Vec3 point{0};
    Vec3 normal{0};  ///< unit, into the free side
    double end = kEndless;

    Closest closest(const Vec3& q) const;
    ShapeForm form() const;
    void cut(Tessellator& into) const;
    ShapeRecord record() const;
};

/// U-shaped profile along z: below the axis (y < 0) the inside of a cylinder of radius `halfWidth`, above it the
/// planes x = -+halfWidth, joined tangentially. A sphere smaller than the profile has one contact with it, which
/// keeps its history while it slides from the trough up the wall. The profile may end at z = `end`.
struct Trough {
    double halfWidth = 0;
    double end = kEndless;

    Closest closest(const Vec3& q) const;
    ShapeForm form() const;
    void cut(Tessellator& into) const;
    ShapeRecord record() const;
};

/// Cylinder wall of finite or infinite length, touched from inside or outside. Beyond an end the closest point
/// lies on that end's circular edge.
struct Tube {
    Vec3 base{0};        ///< centre of the first end (any point of the axis when infinite)
    Vec3 axis{0, 0, 1};  ///< unit
    double radius = 0;
    double length = kEndless;
    bool inside = true;  ///< particles live inside

    Closest closest(const Vec3& q) const;
    ShapeForm form() const;
    void cut(Tessellator& into) const;
    ShapeRecord record() const;
};

/// Front wall plane z = `z` with a circular hole of radius `holeRadius` around the coil axis, and behind it the
/// throat: the inside of a cylinder of the same radius, z ... z + throatLength. The rim is the edge they share.
struct Front {
    double z;
    double holeRadius;
    double throatLength;

    Closest closest(const Vec3& q) const;
    ShapeForm form() const;
    void cut(Tessellator& into) const;
    ShapeRecord record() const;
};

using Surface = std::variant<Plane, Trough, Tube, Front>;

/// Closest point of `surface` to `q`. The distance is finite for every finite q.
Closest closestPoint(const Surface& surface, const Vec3& q);

/// Whether `surface` is a plane or trough that ends at a front wall, where it meets the rim of the hole.
bool endsAtFront(const Surface& surface);

/// Cosine of 20 degrees: places in directions that differ by less are one contact.
inline constexpr double kSameDirection = 0.9397;

/// Whether two places that touch a sphere of `radius` [m] act on it as one: their directions are within 20 degrees, or
/// the shallower one lies no higher above the tangent plane of the deeper one than the overlap, so that the flat of the
/// contact covers it.
bool oneContact(const Closest& deeper, const Closest& shallower, double radius);

/// The relation of a wall that ends at the front wall and the front wall itself, for a sphere that overlaps both.
enum class Joint {
    Apart,  ///< two contacts, as in the corner between a side and the front wall
    Wall,   ///< one contact: that with the wall, which overlaps at least as deeply
    Front   ///< one contact: that with the front wall, its rim or its throat
};

/// Only the deeper contact counts where a wall and the front wall act on a sphere as one (oneContact): they continue
/// each other, or form a ledge that the flat of the contact covers. `radius` is that of the sphere [m]; both surfaces
/// must touch it.
Joint jointContact(const Closest& wall, const Closest& front, double radius);

}  // namespace vkdose::geometry
