#include "host/render/outline.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <variant>

namespace vkdose::render {

namespace {

constexpr int kCorners = 96;  // of a full circle

struct Ring {
    Vec3 centre, right, up;  ///< unit vectors in its plane
    double radius;
    Vec3 at(double angle) const { return centre + radius * (std::cos(angle) * right + std::sin(angle) * up); }
};

Line arc(const Ring& ring, double from, double to) {
    const int pieces = std::max(1, int(std::ceil(std::abs(to - from) / (2 * kPi) * kCorners)));
    Line line;
    for (int i = 0; i <= pieces; ++i) line.push_back(ring.at(from + (to - from) * i / pieces));
    return line;
}

/// Angles at which the side of a cylinder with these rings turns away from the viewer. Seen along its axis the cylinder
/// has no such angles, and any will do.
std::array<double, 2> limbs(const Ring& ring, const Vec3& towards) {
    const double angle = std::atan2(glm::dot(towards, ring.right), -glm::dot(towards, ring.up));
    return {angle, angle + kPi};
}

void addCylinder(Ring ring, const Vec3& along, const Vec3& towards, std::vector<Line>& lines) {
    Ring far = ring;
    far.centre += along;
    lines.push_back(arc(ring, 0, 2 * kPi));
    lines.push_back(arc(far, 0, 2 * kPi));
    for (const double angle : limbs(ring, towards)) lines.push_back({ring.at(angle), far.at(angle)});
}

/// The profile of the canister across its axis, from the top of one wall to that of the other.
Line profile(const Canister& can, double z) {
    const double half = can.width / 2, top = can.height - half;
    Line line{{half, top, z}};
    if (can.flatFloor) {
        line.push_back({half, -half, z});
        line.push_back({-half, -half, z});
    } else {
        const Line floor = arc({{0, 0, z}, {1, 0, 0}, {0, 1, 0}, half}, 0, -kPi);
        line.insert(line.end(), floor.begin(), floor.end());
    }
    line.push_back({-half, top, z});
    return line;
}

void addCanister(const Canister& can, const Vec3& towards, std::vector<Line>& lines) {
    const double half = can.width / 2, top = can.height - half;
    lines.push_back(profile(can, 0));
    lines.push_back(profile(can, can.length));
    const auto joined = [&](double x, double y) { lines.push_back({{x, y, 0}, {x, y, can.length}}); };
    for (const double side : {-half, half}) {
        lines.push_back({{side, top, 0}, {side, top, can.length}});
        if (can.flatFloor) joined(side, -half);
    }
    for (const double z : {0.0, can.length}) lines.push_back({{-half, top, z}, {half, top, z}});
    const Ring trough{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, half};
    if (!can.flatFloor)
        for (const double angle : limbs(trough, towards))
            if (trough.at(angle).y < 0) joined(trough.at(angle).x, trough.at(angle).y);
    addCylinder({{0, 0, can.length}, {1, 0, 0}, {0, 1, 0}, can.outletDiameter / 2}, {0, 0, can.throatLength}, towards,
                lines);
}

/// Two unit vectors across a third.
std::array<Vec3, 2> across(const Vec3& axis) {
    const Vec3 other = std::abs(axis.y) < 0.9 ? Vec3(0, 1, 0) : Vec3(1, 0, 0);
    const Vec3 first = glm::normalize(glm::cross(other, axis));
    return {first, glm::cross(axis, first)};
}

void addTube(const geometry::Tube& tube, const Vec3& towards, const Box& content, std::vector<Line>& lines) {
    Vec3 base = tube.base;
    double length = tube.length;
    if (!std::isfinite(length)) {  // as much of it as is in the picture
        const Vec3 half = 0.5 * (content.high - content.low), middle = 0.5 * (content.high + content.low);
        length = 2 * glm::dot(half, glm::abs(tube.axis));
        base += tube.axis * (glm::dot(middle - base, tube.axis) - length / 2);
    }
    const auto [right, up] = across(tube.axis);
    addCylinder({base, right, up, tube.radius}, tube.axis * length, towards, lines);
}

/// Where the plane cuts the content's box: a polygon around the middle of its corners.
void addPlane(const geometry::Plane& plane, const Box& content, std::vector<Line>& lines) {
    Line corners;
    for (int axis = 0; axis < 3; ++axis)
        for (int side = 0; side < 4; ++side) {
            Vec3 a = content.low, b;
            const int other[2] = {(axis + 1) % 3, (axis + 2) % 3};
            for (int k = 0; k < 2; ++k)
                if ((side >> k & 1) != 0) a[other[k]] = content.high[other[k]];
            b = a;
            b[axis] = content.high[axis];
            const double from = glm::dot(a - plane.point, plane.normal), to = glm::dot(b - plane.point, plane.normal);
            if ((from < 0) != (to < 0)) corners.push_back(a + (b - a) * (from / (from - to)));
        }
    if (corners.size() < 3) return;
    Vec3 middle(0);
    for (const Vec3& x : corners) middle += x / double(corners.size());
    const auto [right, up] = across(plane.normal);
    const auto angle = [&, r = right, u = up](const Vec3& x) {
        return std::atan2(glm::dot(x - middle, u), glm::dot(x - middle, r));
    };
    std::sort(corners.begin(), corners.end(), [&](const Vec3& a, const Vec3& b) { return angle(a) < angle(b); });
    corners.push_back(corners.front());
    lines.push_back(corners);
}

/// The parts of a line that the cut leaves.
void addKept(const Line& line, const CutPlane& cut, std::vector<Line>& kept) {
    Line part;
    const auto beyond = [&](const Vec3& x) { return glm::dot(x, cut.normal) - cut.offset; };
    for (std::size_t i = 0; i < line.size(); ++i) {
        const double here = beyond(line[i]), before = i > 0 ? beyond(line[i - 1]) : here;
        // Points in the plane of the cut stay, whatever rounding says.
        constexpr double kNothing = 1e-9;
        if ((here > kNothing) != (before > kNothing))
            part.push_back(line[i - 1] + (line[i] - line[i - 1]) * (before / (before - here)));
        if (here <= kNothing) {
            part.push_back(line[i]);
        } else {
            if (part.size() > 1) kept.push_back(part);
            part.clear();
        }
    }
    if (part.size() > 1) kept.push_back(part);
}

}  // namespace

std::vector<Line> outlineOf(const Case& c, const Vec3& towards, const Box& content,
                            const std::optional<CutPlane>& cut) {
    std::vector<Line> lines;
    if (c.canister) {
        addCanister(*c.canister, towards, lines);
    } else {
        for (const Wall& wall : c.world.walls) {
            if (const auto* tube = std::get_if<geometry::Tube>(&wall.shape)) addTube(*tube, towards, content, lines);
            if (const auto* plane = std::get_if<geometry::Plane>(&wall.shape)) addPlane(*plane, content, lines);
        }
    }
    return left(std::move(lines), cut);
}

std::vector<Line> left(std::vector<Line> lines, const std::optional<CutPlane>& cut) {
    if (!cut) return lines;
    std::vector<Line> kept;
    for (const Line& line : lines) addKept(line, *cut, kept);
    return kept;
}

}  // namespace vkdose::render
