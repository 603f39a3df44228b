#include "geometry/coincidence.h"

#include <algorithm>
#include <cmath>

namespace vkdose::geometry {

namespace {

constexpr int kSeeds = 7;         // number of starting points along each edge of the box
constexpr int kRounds = 60;       // number of projections onto both surfaces in turn
constexpr double kNear = 0.02;    // largest difference of a distance from the radius, as a fraction of the radius
constexpr double kAlike = 0.999;  // cosine of 2.5 degrees, the largest angle between the normals

bool inBox(const Vec3& q, const Vec3& low, const Vec3& high) {
    return glm::all(glm::greaterThanEqual(q, low)) && glm::all(glm::lessThanEqual(q, high));
}

/// Moves `q` to where a sphere about it just touches the surface.
Vec3 ontoSurface(const Surface& surface, double radius, const Vec3& q) {
    const Closest closest = closestPoint(surface, q);
    return q + (radius - closest.distance) * closest.normal;
}

/// Where a sphere that starts at `q` touches both surfaces in the same place, if it gets there.
std::optional<Vec3> commonPlace(const Surface& a, const Surface& b, double radius, Vec3 q) {
    // Projection onto the two in turn converges to a place where the sphere touches both. It converges slowly where the
    // surfaces are tangent, but comes near enough.
    for (int n = 0; n < kRounds; ++n) q = ontoSurface(b, radius, ontoSurface(a, radius, q));
    const Closest toA = closestPoint(a, q), toB = closestPoint(b, q);
    const bool touchesBoth =
        std::abs(toA.distance - radius) < kNear * radius && std::abs(toB.distance - radius) < kNear * radius;
    if (!touchesBoth || glm::dot(toA.normal, toB.normal) < kAlike) return std::nullopt;
    return q;
}

bool joined(const Surface& a, const Surface& b) {
    return (endsAtFront(a) && std::holds_alternative<Front>(b)) || (endsAtFront(b) && std::holds_alternative<Front>(a));
}

}  // namespace

std::optional<Coincidence> findCoincidence(const std::vector<Surface>& surfaces, double radius, const Vec3& low,
                                           const Vec3& high) {
    const auto free = [&](const Vec3& q) {
        return inBox(q, low, high) && std::all_of(surfaces.begin(), surfaces.end(), [&](const Surface& s) {
                   return closestPoint(s, q).distance > (1 - kNear) * radius;
               });
    };
    for (std::size_t i = 0; i < surfaces.size(); ++i)
        for (std::size_t j = i + 1; j < surfaces.size(); ++j) {
            if (joined(surfaces[i], surfaces[j])) continue;
            for (int seed = 0; seed < kSeeds * kSeeds * kSeeds; ++seed) {
                const Vec3 share(seed % kSeeds + 0.5, seed / kSeeds % kSeeds + 0.5, seed / kSeeds / kSeeds + 0.5);
                const Vec3 start = low + share / double(kSeeds) * (high - low);
                const auto place = commonPlace(surfaces[i], surfaces[j], radius, start);
                if (place && free(*place)) return Coincidence{i, j, *place};
            }
        }
    return std::nullopt;
}

}  // namespace vkdose::geometry
