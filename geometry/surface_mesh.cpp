#include "geometry/surface_mesh.h"

#include <algorithm>
#include <cmath>

#include "geometry/cone.h"
#include "geometry/tessellator.h"

namespace vkdose::geometry {

namespace {

using Corners = std::vector<Vec3>;

/// All x with dot(normal, x) <= offset.
struct HalfSpace {
    Vec3 normal;
    double offset;
};

double triangleArea(const Triangle& t) {
    return 0.5 * glm::length(glm::cross(t[1] - t[0], t[2] - t[0]));
}

class Mesher {
  public:
    Mesher(const std::vector<Surface>& surfaces, const Vec3& low, const Vec3& high, int around)
        : low_(low), high_(high), around_(around), scale_(glm::length(high - low)) {
        for (int d = 0; d < 3; ++d) {
            Vec3 along(0);
            along[d] = 1;
            room_.push_back({along, high[d]});
            room_.push_back({-along, -low[d]});
        }
        for (const Surface& s : surfaces)
            if (const auto* trough = std::get_if<Trough>(&s)) confine(*trough);
    }

    void add(const Plane& plane) {
        room_.push_back({{0, 0, 1}, std::min(plane.end, high_.z)});
        fan(polygon(plane));
        room_.pop_back();
    }

    void add(const Trough& trough) {
        const double h = trough.halfWidth;
        Corners profile{{-h, high_.y, 0}};
        for (int i = 0; i <= around_ / 2; ++i) {
            const double angle = kPi + 2 * kPi * i / around_;
            profile.push_back({h * std::cos(angle), h * std::sin(angle), 0});
        }
        profile.push_back({h, high_.y, 0});
        extrude(profile, Vec3(0, 0, low_.z), Vec3(0, 0, std::min(trough.end, high_.z)));
    }

    void add(const Tube& tube) {
        double begin = 0, end = tube.length;
        if (std::isinf(end)) {
            end = -scale_;
            begin = scale_;
            for (int corner = 0; corner < 8; ++corner) {
                const Vec3 at((corner & 1) != 0 ? low_.x : high_.x, (corner & 2) != 0 ? low_.y : high_.y,
                              (corner & 4) != 0 ? low_.z : high_.z);
                const double along = glm::dot(at - tube.base, tube.axis);
                begin = std::min(begin, along);
                end = std::max(end, along);
            }
        }
        const Vec3 side = across(tube.axis), other = glm::cross(tube.axis, side);
        Corners circle;
        for (int i = 0; i <= around_; ++i) {
            const double angle = 2 * kPi * (i % around_) / around_;
            circle.push_back(tube.base + tube.radius * (std::cos(angle) * side + std::sin(angle) * other));
        }
        extrude(circle, begin * tube.axis, end * tube.axis);
    }

    /// Adds the wall around the hole: as seen from the axis, the part between the edge of the hole and the outer edge
    /// of the wall.
    void add(const Front& front) {
        const Vec3 centre(0, 0, front.z);
        const auto edge = [&](double angle) {
            const Vec3 direction(std::cos(angle), std::sin(angle), 0);
            double reach = scale_;
            for (const HalfSpace& h : room_)
                if (const double slope = glm::dot(h.normal, direction); slope > 1e-12)
                    reach = std::min(reach, (h.offset - glm::dot(h.normal, centre)) / slope);
            return direction * std::max(reach, front.holeRadius) + centre;
        };
        std::vector<double> angles;
        for (int i = 0; i < around_; ++i) angles.push_back(2 * kPi * i / around_ - kPi);
        for (const Vec3& corner : polygon({centre, {0, 0, 1}})) angles.push_back(std::atan2(corner.y, corner.x));
        std::sort(angles.begin(), angles.end());
        angles.push_back(angles.front() + 2 * kPi);
        Corners inner, outer;
        for (const double angle : angles) {
            inner.push_back(centre + front.holeRadius * Vec3(std::cos(angle), std::sin(angle), 0));
            outer.push_back(edge(angle));
        }
        strip(inner, outer);
        add(Tube{centre, {0, 0, 1}, front.holeRadius, front.throatLength, true});
    }

    std::vector<Triangle> mesh() { return std::move(mesh_); }

  private:
    /// A trough is convex, so the room inside it is the room inside its tangent planes. They are taken at the corners
    /// of its mesh and between them.
    void confine(const Trough& trough) {
        for (int i = 0; i <= around_; ++i) {
            const double angle = kPi + kPi * i / around_;
            room_.push_back({{std::cos(angle), std::sin(angle), 0}, trough.halfWidth});
        }
    }

    static Vec3 across(const Vec3& axis) {
        const Vec3 helper = std::abs(axis.x) < 0.5 ? Vec3(1, 0, 0) : Vec3(0, 1, 0);
        return glm::normalize(glm::cross(axis, helper));
    }

    /// The plane as far as it lies in the room (Sutherland and Hodgman's clipping of a square that is large enough).
    Corners polygon(const Plane& plane) const {
        const Vec3 middle = 0.5 * (low_ + high_);
        const Vec3 centre = middle - glm::dot(middle - plane.point, plane.normal) * plane.normal;
        const Vec3 side = 2 * scale_ * across(plane.normal), other = glm::cross(plane.normal, side);
        Corners corners{centre - side - other, centre + side - other, centre + side + other, centre - side + other};
        for (const HalfSpace& h : room_) {
            // The tolerance keeps a plane that is itself a face of the room.
            const auto beyond = [&](const Vec3& x) { return glm::dot(h.normal, x) - h.offset - 1e-9 * scale_; };
            Corners kept;
            for (std::size_t i = 0; i < corners.size(); ++i) {
                const Vec3 &a = corners[i], &b = corners[(i + 1) % corners.size()];
                const double da = beyond(a), db = beyond(b);
                if (da <= 0) kept.push_back(a);
                if ((da <= 0) != (db <= 0)) kept.push_back(a + da / (da - db) * (b - a));
            }
            corners = std::move(kept);
        }
        return corners;
    }

    void put(const Triangle& t) {
        if (triangleArea(t) > 1e-12 * scale_ * scale_) mesh_.push_back(t);
    }

    void fan(const Corners& corners) {
        for (std::size_t i = 1; i + 1 < corners.size(); ++i) put({corners[0], corners[i], corners[i + 1]});
    }

    void strip(const Corners& a, const Corners& b) {
        for (std::size_t i = 0; i + 1 < a.size(); ++i) {
            put({a[i], a[i + 1], b[i + 1]});
            put({a[i], b[i + 1], b[i]});
        }
    }

    void extrude(const Corners& profile, const Vec3& from, const Vec3& to) {
        Corners a, b;
        for (const Vec3& corner : profile) {
            a.push_back(corner + from);
            b.push_back(corner + to);
        }
        strip(a, b);
    }

    Vec3 low_, high_;
    int around_;
    double scale_;
    std::vector<HalfSpace> room_;
    std::vector<Triangle> mesh_;
};

}  // namespace

std::vector<Triangle> surfaceMesh(const std::vector<Surface>& surfaces, const Vec3& low, const Vec3& high, int around) {
    Mesher mesher(surfaces, low, high, around);
    for (const Surface& surface : surfaces) std::visit([&](const auto& s) { mesher.add(s); }, surface);
    return mesher.mesh();
}

namespace {

/// `radius` [m] is that of the wall.
void cutWall(const Surface& wall, double radius, Tessellator& into) {
    into.putAll(surfaceMesh({wall}, into.low(), into.high(), into.pieces(2 * kPi * radius, 4)));
}

}  // namespace

void Plane::cut(Tessellator& into) const {
    cutWall(*this, 0, into);
}

void Trough::cut(Tessellator& into) const {
    cutWall(*this, halfWidth, into);
}

void Front::cut(Tessellator& into) const {
    cutWall(*this, holeRadius, into);
}

void Tube::cut(Tessellator& into) const {
    if (std::isinf(length)) return cutWall(*this, radius, into);
    Cone{base, axis, radius, radius, length}.cut(into);
    if (inside) into.turnOver();
}

}  // namespace vkdose::geometry
