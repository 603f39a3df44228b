#include "geometry/features.h"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

namespace vkdose::geometry {

namespace {

/// The direction of a place, and the index of the feature it belongs to.
struct Member {
    Vec3 normal;
    std::size_t feature;
};

}  // namespace

std::vector<Feature> distinct(std::vector<Feature> places, const Vec3& centre, double radius) {
    // The places behind a convex surface lie in its tangent plane at best. Rounding must not lift them above it, nor
    // part a ring of places of one depth.
    constexpr double kRounding = 1e-9;
    std::sort(places.begin(), places.end(), [](const Feature& a, const Feature& b) {
        return std::tie(a.distance, a.shape, a.key) < std::tie(b.distance, b.shape, b.key);
    });
    std::vector<Feature> kept;
    std::vector<Member> members;
    for (const Feature& place : places) {
        std::size_t mine = places.size();  // the deepest feature that it belongs to
        for (const Member& m : members)
            if (glm::dot(m.normal, place.normal) >= kSameDirection) mine = std::min(mine, m.feature);
        if (mine == places.size()) {
            const bool covered = std::any_of(kept.begin(), kept.end(), [&](const Feature& deeper) {
                return oneContact(deeper, place, radius * (1 + kRounding));
            });
            if (covered) continue;
            mine = kept.size();
            kept.push_back(place);
        }
        members.push_back({place.normal, mine});
        // It joins features that are no deeper than itself: nothing lies between them.
        for (std::size_t other = kept.size() - 1; other > mine; --other) {
            if (place.distance - kept[other].distance > kRounding * radius) continue;
            const bool joined = std::any_of(members.begin(), members.end(), [&](const Member& m) {
                return m.feature == other && glm::dot(m.normal, place.normal) >= kSameDirection;
            });
            if (!joined) continue;
            kept.erase(kept.begin() + std::ptrdiff_t(other));
            for (Member& m : members)
                if (m.feature >= other) m.feature = m.feature == other ? mine : m.feature - 1;
        }
    }
    if (kept.size() > kMaxFeatures)
        throw TooManyFeatures(
            fmt::format("a sphere of radius {:.3g} m at ({:.6g}, {:.6g}, {:.6g}) touches one body in "
                        "{} places; at most {} are computed",
                        radius, centre.x, centre.y, centre.z, kept.size(), kMaxFeatures));
    return kept;
}

}  // namespace vkdose::geometry
