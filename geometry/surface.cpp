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

Closest closest(const Plane& plane, const Vec3& q) {
    const double distance = glm::dot(q - plane.point, plane.normal);
    return upTo(plane.end, {q - distance * plane.normal, plane.normal, distance}, q);
}

Closest closest(const Trough& trough, const Vec3& q) {
    // Above the axis the sphere meets the side walls, below it the half cylinder. `outward` is the unit vector that
    // points to either of them.
    const Vec3 outward = q.y >= 0 ? Vec3(q.x >= 0 ? 1 : -1, 0, 0) : glm::normalize(Vec3(q.x, q.y, 0));
    const double distance = trough.halfWidth - glm::dot(q, outward);
    return upTo(trough.end, {q + distance * outward, -outward, distance}, q);
}

Closest closest(const Tube& tube, const Vec3& q) {
    const double along = glm::dot(q - tube.base, tube.axis);
    const Vec3 offset = (q - tube.base) - along * tube.axis;
    const double rho = glm::length(offset);
    const Vec3 outward = direction(offset, anyNormal(tube.axis));

    const bool endless = std::isinf(tube.length);
    const double height = endless ? along : glm::clamp(along, 0.0, tube.length);
    const Vec3 point = tube.base + height * tube.axis + tube.radius * outward;
    if (height != along) return edge(point, q, tube.axis);
    if (tube.inside) return {point, -outward, tube.radius - rho};
    return {point, outward, rho - tube.radius};
}

Closest closest(const Front& front, const Vec3& q) {
    const Vec3 alongZ(0, 0, 1);
    const double rho = std::hypot(q.x, q.y);
    const Vec3 outward = direction(Vec3(q.x, q.y, 0), Vec3(1, 0, 0));
    const double past = q.z - front.z;

    const double height = glm::clamp(past, 0.0, front.throatLength);
    const Vec3 onTube = front.holeRadius * outward + (front.z + height) * alongZ;
    const Closest wall{Vec3(q.x, q.y, front.z), -alongZ, -past};
    const Closest throat{onTube, -outward, front.holeRadius - rho};

    if (past < 0) return rho >= front.holeRadius ? wall : edge(onTube, q, -alongZ);
    if (past > front.throatLength) return edge(onTube, q, alongZ);
    if (rho <= front.holeRadius) return throat;
    return wall.distance > throat.distance ? wall : throat;  // inside the wall: the way out is the nearer face
}

}  // namespace

Vec3 anyNormal(const Vec3& axis) {
    const Vec3 other = std::abs(axis.x) < 0.5 ? Vec3(1, 0, 0) : Vec3(0, 1, 0);
    return glm::normalize(other - axis * glm::dot(axis, other));
}

Closest closestPoint(const Surface& surface, const Vec3& q) {
    return std::visit([&](const auto& s) { return closest(s, q); }, surface);
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
