#include "geometry/shape.h"

#include <algorithm>
#include <cmath>

namespace vkdose::geometry {

namespace {

using Places = std::vector<Feature>;

void add(Places& found, const Closest& closest, double radius, std::uint32_t key = 0) {
    if (closest.distance < radius) found.push_back({closest, key, 0});
}

/// A shape with a single closest point.
template <class One>
Places placesOf(const One& shape, const Vec3& centre, double radius) {
    Places found;
    add(found, closestPoint(shape, centre), radius);
    return found;
}

/// The walls of a room are six planes; a solid block is convex and touches once.
Places placesOf(const Block& block, const Vec3& centre, double radius) {
    Places found;
    if (!block.inside) {
        add(found, closestPoint(block, centre), radius);
        return found;
    }
    for (int d = 0; d < 3; ++d)
        for (const int side : {0, 1}) {
            Vec3 normal(0), corner = side == 0 ? block.low : block.high;
            normal[d] = side == 0 ? 1 : -1;
            add(found, closestPoint(Surface(Plane{corner, normal}), centre), radius, std::uint32_t(2 * d + side));
        }
    return found;
}

/// A turn is its own feature. The key is its number from the start of the wire.
Places placesOf(const Coil& coil, const Vec3& centre, double radius) {
    Places found;
    for (const CoilTouch& touch : touches(coil, 0, centre, radius))
        add(found, touch, radius, std::uint32_t(std::lround(std::abs(touch.wireAngle) / (2 * kPi))));
    return found;
}

Places placesOf(const Flight& flight, const Vec3& centre, double radius) {
    Places found;
    for (const FlightTouch& touch : touches(flight, centre, radius))
        add(found, touch, radius, std::uint32_t(std::lround(touch.theta / (2 * kPi))));
    return found;
}

Places placesOf(const std::shared_ptr<const MeshSurface>& mesh, const Vec3& centre, double radius) {
    return mesh->places(centre, radius);
}

}  // namespace

Closest closestPoint(const Cone& cone, const Vec3& q) {
    const double height = glm::dot(q - cone.base, cone.axis);
    const Vec3 offset = (q - cone.base) - height * cone.axis;
    const double rho = glm::length(offset);
    const Vec3 outward = rho > 0 ? offset / rho : anyNormal(cone.axis);
    // In the half plane of q the wall is a segment.
    const double dr = cone.endRadius - cone.baseRadius, dz = cone.length;
    const double share = glm::clamp(((rho - cone.baseRadius) * dr + height * dz) / (dr * dr + dz * dz), 0.0, 1.0);
    Closest closest{};
    closest.point = cone.base + (cone.baseRadius + share * dr) * outward + share * dz * cone.axis;
    closest.distance = glm::length(q - closest.point);
    const Vec3 square = glm::normalize(dz * outward - dr * cone.axis);
    closest.normal = closest.distance > 0 ? (q - closest.point) / closest.distance : square;
    return closest;
}

Closest closestPoint(const Ball& ball, const Vec3& q) {
    const Vec3 away = q - ball.centre;
    const double far = glm::length(away);
    const Vec3 normal = far > 0 ? away / far : Vec3(0, 0, 1);
    return {ball.centre + ball.radius * normal, normal, far - ball.radius};
}

Closest closestPoint(const Block& block, const Vec3& q) {
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

std::vector<Feature> places(const Shape& shape, const Vec3& centre, double radius) {
    return std::visit([&](const auto& s) { return placesOf(s, centre, radius); }, shape);
}

namespace {

bool onZ(const Vec3& point) {
    return point.x == 0 && point.y == 0;
}

struct ApproachByTurning {
    using Answer = std::optional<double>;

    static Answer unmovedIf(bool revolves) { return revolves ? Answer(0) : std::nullopt; }

    Answer operator()(const Coil& coil) const { return coil.pitch / (2 * kPi); }
    Answer operator()(const Plane& plane) const { return unmovedIf(onZ(plane.normal)); }
    Answer operator()(const Tube& tube) const { return unmovedIf(onZ(tube.base) && onZ(tube.axis)); }
    Answer operator()(const Cone& cone) const { return unmovedIf(onZ(cone.base) && onZ(cone.axis)); }
    Answer operator()(const Ball& ball) const { return unmovedIf(onZ(ball.centre)); }
    template <class Other>
    Answer operator()(const Other&) const {
        return std::nullopt;
    }
};

}  // namespace

std::optional<double> approachByTurning(const Shape& shape) {
    return std::visit(ApproachByTurning{}, shape);
}

std::vector<Feature> touched(const std::vector<Shape>& shapes, const Vec3& centre, double radius, double reach) {
    Places all;
    for (std::uint32_t s = 0; s < shapes.size(); ++s)
        for (Feature& place : places(shapes[s], centre, radius + reach)) {
            place.shape = s;
            all.push_back(place);
        }
    return distinct(std::move(all), centre, radius, reach);
}

}  // namespace vkdose::geometry
