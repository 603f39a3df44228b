#include "host/render/ray_grid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace vkdose::render {

namespace {

using glm::uvec3;
using glm::vec3;
using glm::vec4;

/// Limits that hold however far apart things lie: cells of the grid (more only for very many spheres), and cells that a
/// ray passes in one direction.
constexpr double kMostCells = 1 << 20;
constexpr float kMostInRow = 1000;

struct Bounds {
    vec3 low{std::numeric_limits<float>::infinity()}, high{-std::numeric_limits<float>::infinity()};
    void include(const vec3& centre, float radius) {
        low = glm::min(low, centre - radius);
        high = glm::max(high, centre + radius);
    }
};

float distance(const vec3& point, const vec3& low, const vec3& high) {
    return glm::length(point - glm::clamp(point, low, high));
}

/// Calls `visit(cell)` for every cell whose box is nearer than `reach` to the piece a ... b.
template <typename Visit>
void forCells(const Grid& grid, const vec3& a, const vec3& b, float reach, const Visit& visit) {
    const vec3 top = vec3(grid.cells) - 1.0f;
    const uvec3 first(glm::clamp(glm::floor((glm::min(a, b) - reach - grid.low) / grid.edge), vec3(0), top));
    const uvec3 last(glm::clamp(glm::floor((glm::max(a, b) + reach - grid.low) / grid.edge), vec3(0), top));
    for (unsigned z = first.z; z <= last.z; ++z)
        for (unsigned y = first.y; y <= last.y; ++y)
            for (unsigned x = first.x; x <= last.x; ++x) {
                const vec3 low = grid.low + grid.edge * vec3(x, y, z), high = low + grid.edge;
                // A piece is short: within its box is near enough. Of a sphere this is exact.
                if (a == b && distance(a, low, high) >= reach) continue;
                visit((std::size_t(z) * grid.cells.y + y) * grid.cells.x + x);
            }
}

/// Calls `visit(cell)` for every cell whose box is within `margin` of the plane of a triangle, and of the box around
/// it.
template <typename Visit>
void forCells(const Grid& grid, const Corners& t, float margin, const Visit& visit) {
    const vec3 normal = glm::cross(t[1] - t[0], t[2] - t[0]), low = glm::min(t[0], glm::min(t[1], t[2])),
               high = glm::max(t[0], glm::max(t[1], t[2]));
    const float length = glm::length(normal), half = grid.edge / 2 + margin;
    const float reach = half * (std::abs(normal.x) + std::abs(normal.y) + std::abs(normal.z));
    const vec3 top = vec3(grid.cells) - 1.0f;
    const uvec3 first(glm::clamp(glm::floor((low - margin - grid.low) / grid.edge), vec3(0), top));
    const uvec3 last(glm::clamp(glm::floor((high + margin - grid.low) / grid.edge), vec3(0), top));
    for (unsigned z = first.z; z <= last.z; ++z)
        for (unsigned y = first.y; y <= last.y; ++y)
            for (unsigned x = first.x; x <= last.x; ++x) {
                const vec3 middle = grid.low + grid.edge * (vec3(x, y, z) + 0.5f);
                if (length > 0 && std::abs(glm::dot(middle - t[0], normal)) > reach) continue;
                visit((std::size_t(z) * grid.cells.y + y) * grid.cells.x + x);
            }
}

/// Of the spheres; without any, of the wire; without that, as long as the triangles are wide.
float meanDiameter(const std::vector<vec4>& spheres, float wireRadius, float triangle) {
    if (spheres.empty()) return wireRadius > 0 ? 2 * wireRadius : triangle;
    double sum = 0;
    for (const vec4& s : spheres) sum += s.w;
    return float(2 * sum / double(spheres.size()));
}

/// The side of a square as large as two mean triangles.
float meanWidth(const std::vector<Corners>& triangles) {
    double area = 0;
    for (const Corners& t : triangles) area += glm::length(glm::cross(t[1] - t[0], t[2] - t[0])) / 2;
    return float(std::sqrt(2 * area / double(std::max<std::size_t>(triangles.size(), 1))));
}

}  // namespace

Grid gridOf(const std::vector<vec4>& spheres, const std::vector<vec4>& joints, float wireRadius,
            const std::vector<Corners>& triangles) {
    Bounds all;
    for (const vec4& s : spheres) all.include(vec3(s), s.w);
    for (const vec4& j : joints) all.include(vec3(j), wireRadius);
    for (const Corners& t : triangles)
        for (const vec3& corner : t) all.include(corner, 0);
    Grid grid;
    grid.parts.resize(1);
    if (spheres.empty() && joints.empty() && triangles.empty()) return grid;

    const vec3 size = all.high - all.low;
    const double volume = double(size.x) * size.y * size.z;
    const double most = std::max(kMostCells, 2.0 * double(spheres.size()));
    const float width = meanWidth(triangles), diameter = meanDiameter(spheres, wireRadius, width);
    const float wanted = triangles.empty() ? diameter : std::clamp(width, diameter / 2, diameter);
    grid.edge = std::max({wanted, float(std::cbrt(volume / most)), std::max({size.x, size.y, size.z}) / kMostInRow});
    // A ray that grazes the outermost sphere must not miss the grid by rounding.
    const float margin = 1e-3f * grid.edge;
    grid.low = all.low - margin;
    grid.cells = uvec3(glm::ceil((size + 2 * margin) / grid.edge));
    grid.cells = glm::max(grid.cells, uvec3(1));

    const auto forAll = [&](const auto& visit) {  // visit(part, entry, cell)
        for (std::size_t i = 0; i < spheres.size(); ++i) {
            const vec3 c(spheres[i]);
            forCells(grid, c, c, spheres[i].w + margin, [&](std::size_t cell) { visit(0, i, cell); });
            forCells(grid, c, c, kShadeReach * spheres[i].w, [&](std::size_t cell) { visit(3, i, cell); });
        }
        for (std::size_t i = 0; i + 1 < joints.size(); ++i)
            forCells(grid, vec3(joints[i]), vec3(joints[i + 1]), wireRadius + margin,
                     [&](std::size_t cell) { visit(1, i, cell); });
        for (std::size_t i = 0; i < triangles.size(); ++i)
            forCells(grid, triangles[i], margin, [&](std::size_t cell) { visit(2, i, cell); });
    };
    constexpr int kParts = 4;
    std::vector<std::array<std::uint32_t, kParts>> counts(std::size_t(grid.cells.x) * grid.cells.y * grid.cells.z,
                                                          {0, 0, 0, 0});
    forAll([&](int part, std::size_t, std::size_t cell) { ++counts[cell][part]; });
    grid.parts.resize(counts.size());
    std::vector<std::array<std::uint32_t, kParts>>& next = counts;
    std::uint32_t total = 0;
    for (std::size_t cell = 0; cell < counts.size(); ++cell) {
        for (int part = 0; part < kParts; ++part) {
            const std::uint32_t begin = total;
            total += counts[cell][part];
            next[cell][part] = begin;
            grid.parts[cell][part] = total;
        }
    }
    grid.entries.resize(total);
    forAll([&](int part, std::size_t entry, std::size_t cell) {
        grid.entries[next[cell][part]++] = std::uint32_t(entry);
    });
    return grid;
}

}  // namespace vkdose::render
