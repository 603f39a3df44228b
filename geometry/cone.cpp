#include "geometry/cone.h"

#include <algorithm>
#include <cmath>

#include "geometry/tessellator.h"

namespace vkdose::geometry {

Closest Cone::closest(const Vec3& q) const {
    const double height = glm::dot(q - base, axis);
    const Vec3 offset = (q - base) - height * axis;
    const double rho = glm::length(offset);
    const Vec3 outward = rho > 0 ? offset / rho : anyNormal(axis);
    // In the half plane of q the wall is a segment.
    const double dr = endRadius - baseRadius, dz = length;
    const double share = glm::clamp(((rho - baseRadius) * dr + height * dz) / (dr * dr + dz * dz), 0.0, 1.0);
    Closest closest{};
    closest.point = base + (baseRadius + share * dr) * outward + share * dz * axis;
    closest.distance = glm::length(q - closest.point);
    const Vec3 square = glm::normalize(dz * outward - dr * axis);
    closest.normal = closest.distance > 0 ? (q - closest.point) / closest.distance : square;
    return closest;
}

ShapeForm Cone::form() const {
    const double radius = std::max(baseRadius, endRadius);
    return {.curve = radius, .facet = roundFacet(radius, length), .approach = unmovedIf(onZ(base) && onZ(axis))};
}

void Cone::cut(Tessellator& into) const {
    const Vec3 side = anyNormal(axis), other = glm::cross(axis, side);
    const int around = into.pieces(2 * kPi * std::max(baseRadius, endRadius), 3);
    // A cone is straight along its wall, but triangles as long as wide stay near it at its thin end.
    const int along = into.straightPieces(std::hypot(endRadius - baseRadius, length));
    std::vector<Tessellator::Corners> rings;
    for (int k = 0; k <= along; ++k) {
        const double share = double(k) / along;
        const double radius = baseRadius + share * (endRadius - baseRadius);
        Tessellator::Corners& ring = rings.emplace_back();
        for (int i = 0; i < around; ++i) {
            const double angle = 2 * kPi * i / around;
            ring.push_back(base + share * length * axis + radius * (std::cos(angle) * side + std::sin(angle) * other));
        }
    }
    into.strips(rings, true);
}

ShapeRecord Cone::record() const {
    const double dr = endRadius - baseRadius, wall = std::hypot(dr, length);
    return {.kind = ShapeKind::Cone,
            .first = {base, wall},
            .second = {axis},
            .sizes = {baseRadius, endRadius},
            .more = {dr / wall, length / wall},
            .around = Around{base + 0.5 * length * axis, std::hypot(std::max(baseRadius, endRadius), length / 2)}};
}

}  // namespace vkdose::geometry
