#pragma once
// The uniform grid through which the ray caster follows its rays.

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace vkdose::render {

/// How far a sphere takes light from its surroundings, in radii from its centre; shaders/render/cast.comp has the same.
inline constexpr float kShadeReach = 2.5f;

struct Grid {
    glm::vec3 low{0};  ///< corner [m]
    float edge = 1;    ///< of a cell [m]
    glm::uvec3 cells{1};
    /// Of every cell, x fastest: the ends of the four parts of its entries. They begin where those of the cell before
    /// end.
    std::vector<glm::uvec4> parts;
    /// Spheres that a ray through the cell can meet; pieces of wire likewise, by their first joint; triangles; spheres
    /// whose shade reaches into the cell.
    std::vector<std::uint32_t> entries;
};

using Corners = std::array<glm::vec3, 3>;  ///< of a triangle [m]

/// The grid over spheres (centre, radius), the joints of a wire, and triangles. All of them lie inside. A cell is as
/// large as a mean diameter, or half of it where triangles are small, unless that gives too many cells.
Grid gridOf(const std::vector<glm::vec4>& spheres, const std::vector<glm::vec4>& joints, float wireRadius,
            const std::vector<Corners>& triangles);

}  // namespace vkdose::render
