#pragma once
// A wall: a surface at rest. A sphere touches it in one place at most, so that a contact with it has the wall's name
// for its place.

#include <concepts>
#include <string>
#include <utility>
#include <vector>

#include "geometry/surface.h"
#include "host/model/material.h"

namespace vkdose {

/// The axis about which the torque on a wall is told, through the origin: that of the canister's coil.
inline const Vec3 kWallAxis{0, 0, 1};

struct Wall {
    geometry::Surface shape;
    std::string name;              ///< "rear", "plane-0", ...; walls made by hand have none
    int material = kWallMaterial;  ///< World::materials

    Wall(const geometry::Surface& surface, std::string called = {},
         int of = kWallMaterial)  // NOLINT(google-explicit-constructor)
        : shape(surface), name(std::move(called)), material(of) {}
    /// A shape alone: most walls that are made by hand have neither name nor material of their own.
    template <class Shape>
    requires std::constructible_from<geometry::Surface, Shape> &&
        (!std::same_as<Shape, geometry::Surface>)Wall(const Shape& surface)  // NOLINT(google-explicit-constructor)
        : shape(surface) {}
};

/// The shapes of walls, in their order.
inline std::vector<geometry::Surface> shapesOf(const std::vector<Wall>& walls) {
    std::vector<geometry::Surface> shapes;
    for (const Wall& wall : walls) shapes.push_back(wall.shape);
    return shapes;
}

}  // namespace vkdose
