#include "geometry/features.h"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

namespace vkdose::geometry {

std::vector<Feature> distinct(std::vector<Feature> places, const Vec3& centre, double radius) {
    // The places behind a convex surface lie in its tangent plane at best. Rounding must not lift them above it.
    constexpr double kRounding = 1e-9;
    std::sort(places.begin(), places.end(), [](const Feature& a, const Feature& b) {
        return std::tie(a.distance, a.shape, a.key) < std::tie(b.distance, b.shape, b.key);
    });
    std::vector<Feature> kept, met;  // `met` also holds the places that belong to a kept one
    for (const Feature& place : places) {
        const bool known = std::any_of(met.begin(), met.end(), [&](const Feature& other) {
            return glm::dot(other.normal, place.normal) >= kSameDirection;
        });
        const bool covered = !known && std::any_of(kept.begin(), kept.end(), [&](const Feature& deeper) {
            return oneContact(deeper, place, radius * (1 + kRounding));
        });
        if (covered) continue;
        met.push_back(place);
        if (known) continue;
        kept.push_back(place);
        if (kept.size() > kMaxFeatures)
            throw TooManyFeatures(
                fmt::format("a sphere of radius {:.3g} m at ({:.6g}, {:.6g}, {:.6g}) touches one body "
                            "in more than {} places",
                            radius, centre.x, centre.y, centre.z, kMaxFeatures));
    }
    return kept;
}

}  // namespace vkdose::geometry
