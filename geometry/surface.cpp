#include "geometry/surface.h"

#include <cmath>

namespace vkdose::geometry {

namespace {

/// Unit vector along `v`, or `fallback` if `v` is zero, where all directions are equal.
Vec3 direction(const Vec3& v, const Vec3& fallback) {
    const double size = glm::length(v);
    return size > 0 ? v / size : fallback;
}

/// A surface point seen from `q` when nothing lies behind it: an edge.
Closest edge(const Vec3& point, const Vec3& q, const Vec3& fallback) {
    return {point, direction(q - point, fallback), glm::length(q - point)};
}

/// The closest point of a wall along z that ends at `end`, from that of the endless wall.
Closest upTo(double end, const Closest& endless, const Vec3& q) {
    if (q.z <= end) return endless;
    return edge(Vec3(endless.point.x, endless.point.y, end), q, Vec3(0, 0, 1));
}

}  // namespace

Closest Plane::closest(const Vec3& q) const {
    const double distance = glm::dot(q - point, normal);
    return upTo(end, {q - distance * normal, normal, distance}, q);
}

ShapeForm Plane::form() const {
    return {.endless = true, .approach = unmovedIf(onZ(normal))};
}

ShapeRecord Plane::record() const {
    const bool ends = end < kEndless;
    // A plane that ends is parallel to z, so that the point may be moved along z to the end.
    return {.kind = ShapeKind::Plane,
            .first = {ends ? Vec3(point.x, point.y, end) : point},
            .second = {normal},
            .more = {ends ? 1.0 : 0.0}};
}

Closest Trough::closest(const Vec3& q) const {
    // Above the axis the sphere meets the side walls, below it the half cylinder. `outward` is the unit vector that
    // points to either of them.
    const Vec3 outward = q.y >= 0 ? Vec3(q.x >= 0 ? 1 : -1, 0, 0) : glm::normalize(Vec3(q.x, q.y, 0));
    const double distance = halfWidth - glm::dot(q, outward);
    return upTo(end, {q + distance * outward, -outward, distance}, q);
}

ShapeForm Trough::form() const {
    return {.endless = true, .curve = halfWidth};
}

ShapeRecord Trough::record() const {
    const bool ends = end < kEndless;
    return {.kind = ShapeKind::Trough,
            .first = {Vec3(0, 0, ends ? end : 0)},
            .sizes = {halfWidth},
            .more = {ends ? 1.0 : 0.0}};
}

Closest Tube::closest(const Vec3& q) const {
    const double along = glm::dot(q - base, axis);
    const Vec3 offset = (q - base) - along * axis;
    const double rho = glm::length(offset);
    const Vec3 outward = direction(offset, anyNormal(axis));

    const double height = std::isinf(length) ? along : glm::clamp(along, 0.0, length);
    const Vec3 point = base + height * axis + radius * outward;
    if (height != along) return edge(point, q, axis);
    if (inside) return {point, -outward, radius - rho};
    return {point, outward, rho - radius};
}

ShapeForm Tube::form() const {
    return {.endless = std::isinf(length),
            .curve = radius,
            .facet = roundFacet(radius, length),
            .approach = unmovedIf(onZ(base) && onZ(axis))};
}

ShapeRecord Tube::record() const {
    const bool endless = std::isinf(length);  // it goes both ways from its base
    ShapeRecord record{.kind = ShapeKind::Tube,
                       .first = {base, endless ? 0 : length},
                       .second = {axis},
                       .sizes = {radius},
                       .more = {inside ? 1.0 : 0.0, endless ? 1.0 : 0.0}};
    if (!endless && !inside) record.around = Around{base + 0.5 * length * axis, std::hypot(radius, length / 2)};
    return record;
}

Closest Front::closest(const Vec3& q) const {
    const Vec3 alongZ(0, 0, 1);
    const double rho = std::hypot(q.x, q.y);
    const Vec3 outward = direction(Vec3(q.x, q.y, 0), Vec3(1, 0, 0));
    const double past = q.z - z;

    const double height = glm::clamp(past, 0.0, throatLength);
    const Vec3 onTube = holeRadius * outward + (z + height) * alongZ;
    const Closest wall{Vec3(q.x, q.y, z), -alongZ, -past};
    const Closest throat{onTube, -outward, holeRadius - rho};

    if (past < 0) return rho >= holeRadius ? wall : edge(onTube, q, -alongZ);
    if (past > throatLength) return edge(onTube, q, alongZ);
    if (rho <= holeRadius) return throat;
    return wall.distance > throat.distance ? wall : throat;  // inside the wall: the way out is the nearer face
}

ShapeForm Front::form() const {
    return {.endless = true, .curve = holeRadius};
}

ShapeRecord Front::record() const {
    return {.kind = ShapeKind::Front, .first = {Vec3(0, 0, z), throatLength}, .sizes = {holeRadius}};
}

Vec3 anyNormal(const Vec3& axis) {
    const Vec3 other = std::abs(axis.x) < 0.5 ? Vec3(1, 0, 0) : Vec3(0, 1, 0);
    return glm::normalize(other - axis * glm::dot(axis, other));
}

Closest closestPoint(const Surface& surface, const Vec3& q) {
    return std::visit([&](const auto& s) { return s.closest(q); }, surface);
}

bool endsAtFront(const Surface& surface) {
    if (const auto* plane = std::get_if<Plane>(&surface)) return plane->end < kEndless;
    if (const auto* trough = std::get_if<Trough>(&surface)) return trough->end < kEndless;
    return false;
}

bool oneContact(const Closest& deeper, const Closest& shallower, double radius) {
    const double cosine = glm::dot(deeper.normal, shallower.normal);
    // Heights are measured along the normal of the deeper contact. The sphere's centre is at its distance above that
    // contact's plane. The closest point of the other contact is so much below the centre:
    const double below = shallower.distance * cosine;
    return cosine >= kSameDirection || deeper.distance - below < radius - deeper.distance;
}

Joint jointContact(const Closest& wall, const Closest& front, double radius) {
    const bool wallDeeper = wall.distance <= front.distance;
    if (!oneContact(wallDeeper ? wall : front, wallDeeper ? front : wall, radius)) return Joint::Apart;
    return wallDeeper ? Joint::Wall : Joint::Front;
}

}  // namespace vkdose::geometry
