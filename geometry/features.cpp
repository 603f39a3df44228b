// Two places of a sphere on one surface lie in two hollows, if a pass is between them: whoever goes along the surface
// from the one to the other first gets away from the sphere's centre. Seen from the sphere, the surface near a place is
// its tangent plane, so the pass is the edge where the tangent planes of two places meet. Chains of places have a pass
// as well, the lowest of their passes. That is the persistence of the minima of a distance (Edelsbrunner, Letscher and
// Zomorodian 2002): it changes as little as the distances do, whatever places come and go.

#include "geometry/features.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

namespace vkdose::geometry {

namespace {

/// A pass that is seen within 10 degrees of the shallower place does not part them. So facets are one contact if their
/// normals are within 20 degrees.
constexpr double kCosine = 0.98480775301220802, kSine = 0.17364817766693033;

/// A ring of places of one depth is one feature, whatever rounding says [radii].
constexpr double kRounding = 1e-9;

/// Between two places, or at one of them that the way leads over.
struct Pass {
    double depth;  ///< the sphere's radius less the distance of the pass [m]
    bool atPlace;  ///< no lower than the shallower place
    std::size_t deeper, shallower;
};

/// How the tangent planes of two places meet; `i` is the deeper one.
struct Meeting {
    double height;  ///< of the foot of j above the plane of i [m]
    double sine2;   ///< of the angle between the planes, squared
    double away;    ///< of the edge where they meet, from the sphere's centre [m]

    Meeting(const Feature& i, const Feature& j) {
        const Vec3 between = i.normal - j.normal;
        const double versine = glm::dot(between, between) / 2;
        height = (i.distance - j.distance) + j.distance * versine;
        sine2 = versine * (2 - versine);
        away = std::hypot(j.distance, height / std::sqrt(sine2));
    }
    bool parts(const Feature& j) const {
        return height > 0 && kCosine * kCosine * height * height > kSine * kSine * sine2 * j.distance * j.distance;
    }
};

Pass passBetween(const std::vector<Feature>& places, std::size_t i, std::size_t j, double radius) {
    const Meeting edge(places[i], places[j]);
    if (!edge.parts(places[j])) return {radius - places[j].distance, true, i, j};
    return {radius - kCosine * edge.away, false, i, j};
}

/// Change of a place's normal with the centre, times `v`.
Vec3 turned(const Feature& place, const Vec3& v) {
    if (place.bend == Bend::None) return Vec3(0);
    Vec3 square = v - place.normal * glm::dot(place.normal, v);
    if (place.bend == Bend::Line) square -= place.along * glm::dot(place.along, v);
    return square / place.distance;
}

/// How fast the depth of a pass falls with the centre, as a vector.
Vec3 fallOf(const Pass& pass, const std::vector<Feature>& places) {
    const Feature &i = places[pass.deeper], &j = places[pass.shallower];
    if (pass.atPlace) return j.normal;
    // The edge is at -(a n_i + b n_j) from the centre, and its distance changes with both distances and with the angle.
    const Meeting edge(i, j);
    const double a = edge.height / edge.sine2;
    const double b = (j.distance - glm::dot(i.normal, j.normal) * i.distance) / edge.sine2;
    const Vec3 opening = turned(i, j.normal) + turned(j, i.normal);
    return kCosine * (a * i.normal + b * j.normal - a * b * opening) / edge.away;
}

/// For each place, deepest first, the pass to a deeper one, if there is one.
std::vector<Pass> passes(const std::vector<Feature>& places, double radius) {
    std::vector<Pass> all;
    for (std::size_t j = 1; j < places.size(); ++j)
        for (std::size_t i = 0; i < j; ++i) {
            const Pass pass = passBetween(places, i, j, radius);
            if (pass.atPlace || pass.depth > 0) all.push_back(pass);
        }
    std::stable_sort(all.begin(), all.end(), [](const Pass& p, const Pass& q) { return p.depth > q.depth; });
    // Water that rises to the deepest pass joins two hollows; the shallower one ends in the deeper one there.
    std::vector<Pass> found(places.size(), {-kEndless, false, 0, 0});
    std::vector<std::size_t> joined(places.size());
    std::iota(joined.begin(), joined.end(), std::size_t{0});
    const auto hollow = [&](std::size_t place) {
        while (joined[place] != place) place = joined[place];
        return place;
    };
    for (const Pass& pass : all) {
        const auto [deeper, shallower] = std::minmax({hollow(pass.deeper), hollow(pass.shallower)});
        if (deeper == shallower) continue;
        found[shallower] = pass;
        joined[shallower] = deeper;
    }
    return found;
}

}  // namespace

std::vector<Feature> distinct(std::vector<Feature> places, const Vec3& centre, double radius, double reach) {
    std::sort(places.begin(), places.end(), [](const Feature& a, const Feature& b) {
        return std::tie(a.distance, a.shape, a.key) < std::tie(b.distance, b.shape, b.key);
    });
    const std::vector<Pass> pass = passes(places, radius);
    std::vector<Feature> kept;
    for (std::size_t n = 0; n < places.size(); ++n) {
        Feature feature = places[n];
        const double depth = radius - feature.distance;
        if (pass[n].depth >= depth - kRounding * radius) continue;
        if (pass[n].depth > 0) {
            // Overlap delta - p^2/delta: all of it while the pass p is out of touch, none of it when p is as deep.
            const double part = pass[n].depth / depth;
            const Vec3 fall = (1 + part * part) * feature.normal - 2 * part * fallOf(pass[n], places);
            feature.share = glm::length(fall);
            if (feature.share > 0) feature.normal = fall / feature.share;
            feature.distance = radius - depth * (1 - part * part);
            feature.point = centre - feature.distance * feature.normal;
        }
        if (feature.distance < radius + reach) kept.push_back(feature);
    }
    if (kept.size() > kMaxFeatures)
        throw TooManyFeatures(
            fmt::format("a sphere of radius {:.3g} m at ({:.6g}, {:.6g}, {:.6g}) touches one body in "
                        "{} places; at most {} are computed",
                        radius, centre.x, centre.y, centre.z, kept.size(), kMaxFeatures));
    return kept;
}

}  // namespace vkdose::geometry
