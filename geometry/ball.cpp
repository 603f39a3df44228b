#include "geometry/ball.h"

#include <cmath>

#include "geometry/tessellator.h"

namespace vkdose::geometry {

Closest Ball::closest(const Vec3& q) const {
    const Vec3 away = q - centre;
    const double far = glm::length(away);
    const Vec3 normal = far > 0 ? away / far : Vec3(0, 0, 1);
    return {centre + radius * normal, normal, far - radius};
}

ShapeForm Ball::form() const {
    return {.solid = true, .curve = radius, .facet = roundFacet(radius, 0), .approach = unmovedIf(onZ(centre))};
}

void Ball::cut(Tessellator& into) const {
    const int along = into.pieces(kPi * radius, 2), around = 2 * along;
    std::vector<Tessellator::Corners> rings;
    for (int k = 0; k <= along; ++k) {
        const double polar = kPi * (along - k) / along;
        const double sine = k == 0 || k == along ? 0 : std::sin(polar);
        Tessellator::Corners& ring = rings.emplace_back();
        for (int i = 0; i < around; ++i) {
            const double angle = 2 * kPi * i / around;
            ring.push_back(centre + radius * Vec3(sine * std::cos(angle), sine * std::sin(angle), std::cos(polar)));
        }
    }
    into.strips(rings, true);
}

ShapeRecord Ball::record() const {
    return {.kind = ShapeKind::Ball, .first = {centre}, .sizes = {radius}, .around = Around{centre, radius}};
}

}  // namespace vkdose::geometry
