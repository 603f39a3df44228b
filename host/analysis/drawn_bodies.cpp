#include "host/analysis/drawn_bodies.h"

#include <algorithm>

#include "host/model/body_mesh.h"

namespace vkdose {

using geometry::Triangle;

namespace {

constexpr std::size_t kMostLooked = 100;  // particles of a frame by which is judged what a body hides

/// Whether the way from `point` along `way` meets the triangle (Moeller and Trumbore 1997).
bool meets(const Vec3& point, const Vec3& way, const Triangle& t) {
    const Vec3 ab = t[1] - t[0], ac = t[2] - t[0], across = glm::cross(way, ac), from = point - t[0];
    const double det = glm::dot(ab, across);
    if (det == 0) return false;
    const double u = glm::dot(from, across) / det;
    if (u < 0 || u > 1) return false;
    const Vec3 q = glm::cross(from, ab);
    const double v = glm::dot(way, q) / det;
    return v >= 0 && u + v <= 1 && glm::dot(ac, q) / det > 0;
}

std::size_t hiddenBy(const Skin& skin, const geometry::Pose& pose, const std::vector<Vec3>& points, const Vec3& towards,
                     std::vector<bool>& hidden) {
    const Vec3 way = pose.directionToBody(towards);
    std::size_t more = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (hidden[i]) continue;
        const Vec3 point = pose.toBody(points[i]);
        hidden[i] = std::any_of(skin.facets.begin(), skin.facets.end(),
                                [&](const Facet& f) { return meets(point, way, f.corners); });
        more += hidden[i];
    }
    return more;
}

}  // namespace

std::vector<DrawnBody> bodiesOf(const Case& c) {
    std::vector<DrawnBody> drawn;
    for (std::size_t i = 0; i < c.world.bodies.size(); ++i) drawn.push_back({i, bodySkin(c.world.bodies[i])});
    return drawn;
}

Skin endlessSkin(const RigidBody& body, const geometry::Pose& pose, const Box& content) {
    Skin skin;
    for (const geometry::Shape& shape : body.shapes)
        if (formOf(shape).endless) skin.add(skinOf(shapeMesh(shape, seenFrom(pose, content)), false));
    return skin;
}

geometry::Pose poseOf(const DrawnBody& body, const Case& c, const Frame& frame) {
    return c.world.bodies[body.index].pose(frame.time, frame.coilAngle, frame.movedOf(body.index));
}

void lookThrough(std::vector<DrawnBody>& bodies, const Case& c, const Frame& frame, const Vec3& towards,
                 const Box& content) {
    std::vector<Vec3> points;
    const Particles& p = frame.particles;
    const std::size_t step = p.size() / kMostLooked + 1;
    for (std::size_t i = 0; i < p.size(); i += step)
        if (p.status[i] == Status::Active) points.push_back(p.position[i]);
    for (DrawnBody& body : bodies) {
        const geometry::Pose pose = poseOf(body, c, frame);
        std::vector<bool> hidden(points.size(), false);
        body.looked += points.size();
        body.hidden += hiddenBy(body.skin, pose, points, towards, hidden);
        body.hidden += hiddenBy(endlessSkin(c.world.bodies[body.index], pose, content), pose, points, towards, hidden);
        body.seeThrough = 2 * body.hidden > body.looked;
    }
}

}  // namespace vkdose
