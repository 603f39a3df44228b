#pragma once
// The shapes that bodies are made of, in the frame of their body. All answer one question with one type: where does the
// surface come nearer to a centre than a radius? `touched` puts the answers of a body's shapes together.

#include <memory>
#include <optional>
#include <variant>

#include "geometry/coil.h"
#include "geometry/features.h"
#include "geometry/flight.h"
#include "geometry/mesh_surface.h"
#include "geometry/surface.h"

namespace vkdose::geometry {

/// Wall between two circles around an axis, without thickness and touched from both sides: a cone, a cylinder if the
/// radii are equal, a flat ring or disc if the length is zero. A radius may be zero.
struct Cone {
    Vec3 base{0};           ///< centre of the first circle
    Vec3 axis{0, 0, 1};     ///< unit
    double baseRadius = 0;  ///< [m]
    double endRadius = 0;   ///< [m]
    double length = 0;      ///< along the axis [m]
};

/// A solid sphere.
struct Ball {
    Vec3 centre{0};
    double radius = 0;  ///< [m]
};

/// A box with its edges along the axes: a solid one, or the walls of a room if spheres live inside.
struct Block {
    Vec3 low{0}, high{0};
    bool inside = false;
};

using Shape =
    std::variant<Plane, Trough, Tube, Front, Cone, Ball, Block, Coil, Flight, std::shared_ptr<const MeshSurface>>;

Closest closestPoint(const Cone& cone, const Vec3& q);
Closest closestPoint(const Ball& ball, const Vec3& q);
/// Of a solid block. Inside it the distance is negative.
Closest closestPoint(const Block& block, const Vec3& q);

/// All places where the shape comes nearer to `centre` than `radius` [m], one for each local minimum of the distance.
/// They are not yet told apart by `distinct`.
std::vector<Feature> places(const Shape& shape, const Vec3& centre, double radius);

/// How much nearer to a point a surface can come when the shape turns about the z axis of its frame [m per radian]. A
/// surface of revolution comes no nearer. A wire comes as near as if it went along the axis; its two ends, which come
/// nearer, do not count. None for all other shapes.
std::optional<double> approachByTurning(const Shape& shape);

/// The distinct features in which a body made of `shapes` touches a sphere, or comes nearer than `reach` [m] to it
/// (features.h). Throws TooManyFeatures.
std::vector<Feature> touched(const std::vector<Shape>& shapes, const Vec3& centre, double radius, double reach = 0);

}  // namespace vkdose::geometry
