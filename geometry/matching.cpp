#include "geometry/matching.h"

#include <algorithm>
#include <tuple>

namespace vkdose::geometry {

std::vector<std::size_t> continued(const std::vector<Vec3>& before, const std::vector<Vec3>& now) {
    constexpr double kCos45 = 0.70710678118654752440;
    struct Pair {
        double away;  ///< the cosine, negative, so that the nearest comes first
        std::size_t now, before;
    };
    std::vector<Pair> pairs;
    for (std::size_t n = 0; n < now.size(); ++n)
        for (std::size_t b = 0; b < before.size(); ++b)
            if (const double cosine = glm::dot(now[n], before[b]); cosine >= kCos45) pairs.push_back({-cosine, n, b});
    std::sort(pairs.begin(), pairs.end(), [](const Pair& p, const Pair& q) {
        return std::tie(p.away, p.now, p.before) < std::tie(q.away, q.now, q.before);
    });
    std::vector<std::size_t> found(now.size(), kNew);
    std::vector<bool> taken(before.size(), false);
    for (const Pair& p : pairs)
        if (found[p.now] == kNew && !taken[p.before]) {
            found[p.now] = p.before;
            taken[p.before] = true;
        }
    return found;
}

Vec3 turnedAlong(const Vec3& vector, const Vec3& from, const Vec3& to) {
    // Rodrigues' formula with the axis from x to, whose length is the sine.
    const Vec3 axis = glm::cross(from, to);
    const double cosine = glm::dot(from, to);
    return cosine * vector + glm::cross(axis, vector) + axis * (glm::dot(axis, vector) / (1 + cosine));
}

}  // namespace vkdose::geometry
