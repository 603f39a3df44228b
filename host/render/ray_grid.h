#pragma once
// The uniform grid through which the ray caster follows its rays.

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
    std::vector<glm::uvec4> parts;  ///< of every cell, x fastest: begin of its entries, ends of their three parts
    /// Spheres that a ray through the cell can meet; pieces of wire likewise, by their first joint; spheres whose shade
    /// reaches into the cell.
    std::vector<std::uint32_t> entries;
};

/// The grid over spheres (centre, radius) and the joints of a wire. All of them lie inside. A cell is as large as a
/// mean diameter, unless that gives too many cells.
Grid gridOf(const std::vector<glm::vec4>& spheres, const std::vector<glm::vec4>& joints, float wireRadius);

}  // namespace vkdose::render
