#pragma once
// Where a sphere touches triangles, found without edges, vertices or neighbours. A point of a surface is a local
// minimum of the distance to a centre if it is the point nearest to it of every triangle that holds the point, because
// a triangle is convex.

#include <vector>

#include "geometry/features.h"
#include "geometry/mesh_file.h"

namespace vkdose::test {

inline Vec3 nearestOnSegment(const Vec3& a, const Vec3& b, const Vec3& q) {
    const Vec3 along = b - a;
    const double size = glm::dot(along, along);
    return size > 0 ? a + glm::clamp(glm::dot(q - a, along) / size, 0.0, 1.0) * along : a;
}

/// The point of a triangle that is nearest to `q`. It may be flat.
inline Vec3 nearestOnTriangle(const geometry::Triangle& t, const Vec3& q) {
    Vec3 best = nearestOnSegment(t[2], t[0], q);
    for (int i = 0; i < 2; ++i) {
        const Vec3 p = nearestOnSegment(t[i], t[i + 1], q);
        if (glm::length(p - q) < glm::length(best - q)) best = p;
    }
    const Vec3 n = glm::cross(t[1] - t[0], t[2] - t[0]);
    if (!(glm::length(n) > 0)) return best;
    const Vec3 foot = q - glm::dot(q - t[0], n) / glm::dot(n, n) * n;
    for (int i = 0; i < 3; ++i)
        if (glm::dot(glm::cross(t[(i + 1) % 3] - t[i], foot - t[i]), n) < 0) return best;
    return foot;
}

/// The local minima of the distance below `radius`. Points closer than `same` [m] are one.
inline std::vector<geometry::Feature> minimaOnTriangles(const std::vector<geometry::Triangle>& triangles,
                                                       const Vec3& centre, double radius, double same) {
    std::vector<geometry::Triangle> near;
    std::vector<Vec3> points;
    for (const geometry::Triangle& t : triangles) {
        const Vec3 p = nearestOnTriangle(t, centre);
        if (glm::length(p - centre) >= radius * (1 + 1e-6)) continue;
        near.push_back(t);
        points.push_back(p);
    }
    std::vector<geometry::Feature> places;
    for (std::size_t i = 0; i < near.size(); ++i) {
        bool least = glm::length(points[i] - centre) < radius;
        for (std::size_t k = 0; k < near.size() && least; ++k)
            least = glm::length(nearestOnTriangle(near[k], points[i]) - points[i]) > same ||
                    glm::length(points[k] - points[i]) <= same;
        if (!least) continue;
        const double distance = glm::length(centre - points[i]);
        places.push_back({{points[i], (centre - points[i]) / distance, distance}, static_cast<std::uint32_t>(i)});
    }
    return places;
}

}  // namespace vkdose::test
