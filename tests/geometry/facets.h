#pragma once
// Surfaces as lists of triangles, and places at random around them.

#include <cmath>
#include <random>
#include <vector>

#include "geometry/mesh_surface.h"
#include "tests/geometry/mesh_samples.h"

namespace vkdose::test {

using Facets = std::vector<geometry::Triangle>;

/// A block between two corners, seen from outside.
inline Facets block(const Vec3& low, const Vec3& high) {
    Facets surface;
    const Sample s = cube();
    for (const auto& t : s.triangles) {
        geometry::Triangle corners;
        for (int i = 0; i < 3; ++i) corners[i] = low + (high - low) * s.points[t[i]];
        surface.push_back(corners);
    }
    return surface;
}

/// A rectangle or a parallelogram.
inline Facets sheet(const Vec3& corner, const Vec3& u, const Vec3& v) {
    return {{corner, corner + u, corner + u + v}, {corner, corner + u + v, corner + v}};
}

/// A prism with `sides` flat sides around the z axis, from z = 0 to `length`, without ends unless `closed`.
inline Facets prism(int sides, double radius, double length, bool closed) {
    Facets surface;
    const auto at = [&](int i, double z) {
        const double angle = 2 * kPi * (i % sides) / sides;
        return Vec3(radius * std::cos(angle), radius * std::sin(angle), z);
    };
    for (int i = 0; i < sides; ++i) {
        surface.push_back({at(i, 0), at(i + 1, 0), at(i + 1, length)});
        surface.push_back({at(i, 0), at(i + 1, length), at(i, length)});
        if (!closed || i == 0 || i == sides - 1) continue;
        surface.push_back({at(0, 0), at(i + 1, 0), at(i, 0)});
        surface.push_back({at(0, length), at(i, length), at(i + 1, length)});
    }
    return surface;
}

/// A point of the box, all as likely.
inline Vec3 within(std::mt19937_64& random, const Vec3& low, const Vec3& high) {
    std::uniform_real_distribution<double> unit(0, 1);
    const double x = unit(random), y = unit(random), z = unit(random);
    return low + (high - low) * Vec3(x, y, z);
}

}  // namespace vkdose::test
