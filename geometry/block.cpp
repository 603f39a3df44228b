#include "geometry/block.h"

#include "geometry/tessellator.h"

namespace vkdose::geometry {

namespace {

/// Of a solid block. Inside it the distance is negative.
Closest closestOf(const Block& block, const Vec3& q) {
    const Vec3 point = glm::clamp(q, block.low, block.high);
    const double distance = glm::length(q - point);
    if (distance > 0) return {point, (q - point) / distance, distance};
    Closest nearest{{}, {}, -kEndless};
    for (int d = 0; d < 3; ++d)
        for (const int side : {-1, 1}) {
            const double depth = side < 0 ? q[d] - block.low[d] : block.high[d] - q[d];
            if (-depth <= nearest.distance) continue;
            Vec3 normal(0);
            normal[d] = side;
            nearest = {q + depth * normal, normal, -depth};
        }
    return nearest;
}

/// Wall `n` of a room: x, y, z, each low and high.
Plane wallOf(const Block& room, int n) {
    Vec3 normal(0);
    normal[n / 2] = n % 2 == 0 ? 1 : -1;
    return {n % 2 == 0 ? room.low : room.high, normal};
}

}  // namespace

std::vector<Feature> Block::places(const Vec3& centre, double radius) const {
    std::vector<Feature> found;
    const auto add = [&](const Closest& closest, std::uint32_t key) {
        if (closest.distance < radius) found.push_back({closest, key, 0});
    };
    if (!inside) add(closestOf(*this, centre), 0);
    for (int n = 0; inside && n < 6; ++n) add(wallOf(*this, n).closest(centre), std::uint32_t(n));
    return found;
}

ShapeForm Block::form() const {
    return {.solid = !inside, .facet = glm::length(high - low)};
}

void Block::cut(Tessellator& into) const {
    const auto corner = [&](int i) {
        return Vec3((i & 1) != 0 ? high.x : low.x, (i & 2) != 0 ? high.y : low.y, (i & 4) != 0 ? high.z : low.z);
    };
    constexpr int kFaces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    for (const auto& f : kFaces) {
        const int second = inside ? f[3] : f[1], fourth = inside ? f[1] : f[3];
        into.put(corner(f[0]), corner(second), corner(f[2]));
        into.put(corner(f[0]), corner(f[2]), corner(fourth));
    }
}

ShapeRecord Block::record() const {
    ShapeRecord record{.kind = ShapeKind::Block, .first = {low}, .second = {high}};
    if (inside) {
        record.kind = ShapeKind::Room;
        record.places = 6;
    } else {
        record.around = Around{0.5 * (low + high), 0.5 * glm::length(high - low)};
    }
    return record;
}

}  // namespace vkdose::geometry
