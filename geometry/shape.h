#pragma once
// The shapes that bodies are made of, in the frame of their body. All answer one question with one type: where does the
// surface come nearer to a centre than a radius? `touched` puts the answers of a body's shapes together. What a shape
// has to tell stands in shape_form.h.

#include <memory>
#include <variant>

#include "geometry/ball.h"
#include "geometry/block.h"
#include "geometry/coil.h"
#include "geometry/cone.h"
#include "geometry/features.h"
#include "geometry/flight.h"
#include "geometry/mesh_surface.h"
#include "geometry/surface.h"
#include "geometry/tessellator.h"

namespace vkdose::geometry {

using Shape =
    std::variant<Plane, Trough, Tube, Front, Cone, Ball, Block, Coil, Flight, std::shared_ptr<const MeshSurface>>;

/// All places where the shape comes nearer to `centre` than `radius` [m], one for each local minimum of the distance.
/// They are not yet told apart by `distinct`.
std::vector<Feature> places(const Shape& shape, const Vec3& centre, double radius);

/// What the shape tells of itself (shape_form.h).
ShapeForm formOf(const Shape& shape);

/// The surface as triangles with sides of about `facet` [m] along curves, seen from outside, edge to edge. Corners lie
/// on the shape, so that the triangles differ from it by facet^2 / (8 radius of curvature). Flat faces are not cut
/// further. A shape without an end is cut off at the box from `low` to `high` [m]. A mesh is given back as it is. Along
/// their straight lines the wall of a cone and the blade of a flight are cut like along curves, or not at all.
std::vector<Triangle> tessellated(const Shape& shape, double facet, const Vec3& low, const Vec3& high,
                                  StraightLines straight = StraightLines::Cut);

/// The distinct features in which a body made of `shapes` touches a sphere, or comes nearer than `reach` [m] to it
/// (features.h). Throws TooManyFeatures.
std::vector<Feature> touched(const std::vector<Shape>& shapes, const Vec3& centre, double radius, double reach = 0);

}  // namespace vkdose::geometry
