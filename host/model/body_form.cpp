#include "host/model/body_form.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/shape.h"

namespace vkdose {

using geometry::Triangle;

std::vector<Triangle> trianglesOf(const RigidBody& body) {
    std::vector<Triangle> all;
    const geometry::Pose pose = body.pose(0, 0);
    for (const geometry::Shape& shape : body.shapes) {
        const double facet = geometry::formOf(shape).facet;
        if (!(facet > 0)) continue;
        for (Triangle t : geometry::tessellated(shape, facet, Vec3(0), Vec3(0))) {
            for (Vec3& corner : t) corner = pose.toWorld(corner);
            all.push_back(t);
        }
    }
    return all;
}

TurningReach reachOf(const std::vector<Triangle>& mesh, const Vec3& axis, const Vec3& through) {
    TurningReach reach{0, kInfinity, -kInfinity};
    for (const Triangle& t : mesh)
        for (const Vec3& corner : t) {
            const Vec3 arm = corner - through;
            const double along = glm::dot(arm, axis);
            reach.radius = std::max(reach.radius, glm::length(arm - along * axis));
            reach.low = std::min(reach.low, along);
            reach.high = std::max(reach.high, along);
        }
    return reach;
}

namespace {

/// Calls visit(pushed, weight, height) for each triangle that pushes powder along the axis: pushed / weight is how far
/// it does so in a radian, height is its place along the axis.
template <class Visit>
void forEachPush(const std::vector<Triangle>& mesh, const Vec3& axis, const Vec3& through, const Visit& visit) {
    /// Faces that turn within themselves (discs, shafts) push nothing.
    constexpr double kOblique = 1e-3;
    for (const Triangle& t : mesh) {
        const Vec3 area = glm::cross(t[1] - t[0], t[2] - t[0]);
        const double size = glm::length(area);
        const Vec3 velocity = glm::cross(axis, (t[0] + t[1] + t[2]) / 3.0 - through);  // at one radian per second
        if (!(size > 0)) continue;
        const Vec3 normal = area / size;
        const double into = glm::dot(velocity, normal), along = glm::dot(normal, axis);
        if (std::abs(into) < kOblique * glm::length(velocity)) continue;
        // Either side of a face gives the same sign.
        visit(size * into * along, size * along * along, glm::dot((t[0] + t[1] + t[2]) / 3.0 - through, axis));
    }
}

/// A mean of pushes.
struct Pushes {
    double pushed = 0, weight = 0;
    void add(double push, double of) {
        pushed += push;
        weight += of;
    }
    double advance() const { return weight > 0 ? 2 * kPi * pushed / weight : 0; }
};

}  // namespace

double hingeLever(const RigidBody& body) {
    const geometry::Hinge* hinge = body.hinge();
    return hinge == nullptr ? 0 : reachOf(trianglesOf(body), hinge->axis, hinge->through).radius;
}

double advancePerTurn(const std::vector<Triangle>& mesh, const Vec3& axis, const Vec3& through) {
    Pushes all;
    forEachPush(mesh, axis, through, [&](double push, double weight, double) { all.add(push, weight); });
    return all.advance();
}

Conveying conveyingOf(const std::vector<Triangle>& mesh, const Vec3& axis, const Vec3& through) {
    Pushes all, forwards, backwards;
    const TurningReach reach = reachOf(mesh, axis, through);
    // A straight line of least squares of the pushes over the height, from 0 to 1.
    double s0 = 0, s1 = 0, s2 = 0, p0 = 0, p1 = 0;
    forEachPush(mesh, axis, through, [&](double push, double weight, double height) {
        all.add(push, weight);
        (push > 0 ? forwards : backwards).add(push, weight);
        const double x = (height - reach.low) / (reach.high - reach.low);
        s0 += weight;
        s1 += weight * x;
        s2 += weight * x * x;
        p0 += 2 * kPi * push;
        p1 += 2 * kPi * push * x;
    });
    Conveying c;
    c.advance = c.low = c.high = all.advance();
    c.forwards = forwards.advance();
    c.backwards = -backwards.advance();
    if (all.weight > 0) c.against = std::min(forwards.weight, backwards.weight) / all.weight;
    const double spread = s0 * s2 - s1 * s1;
    if (spread > 1e-9 * s0 * s0) {
        c.low = (p0 * s2 - p1 * s1) / spread;
        c.high = c.low + (s0 * p1 - s1 * p0) / spread;
    }
    return c;
}

double highestOfTurn(const std::vector<Triangle>& mesh, const Vec3& axis, const Vec3& through) {
    double highest = -std::numeric_limits<double>::infinity();
    const double steep = std::sqrt(std::max(0.0, 1 - axis.y * axis.y));
    for (const Triangle& t : mesh)
        for (const Vec3& corner : t) {
            const Vec3 arm = corner - through;
            const double along = glm::dot(arm, axis);
            highest = std::max(highest, through.y + along * axis.y + glm::length(arm - along * axis) * steep);
        }
    return highest;
}

}  // namespace vkdose
