#include "host/report/player_bodies.h"

#include <bit>
#include <cmath>
#include <map>
#include <tuple>

#include "host/analysis/drawn_bodies.h"
#include "host/report/deflate.h"

namespace vkdose::report {

namespace {

static_assert(std::endian::native == std::endian::little, "the page takes the lowest byte first");

template <typename Value>
std::string packed(const std::vector<Value>& values) {
    return base64({reinterpret_cast<const char*>(values.data()), values.size() * sizeof(Value)});
}

void put(std::vector<float>& into, const Vec3& x) {
    for (int k = 0; k < 3; ++k) into.push_back(static_cast<float>(x[k]));
}

/// Corners are one where place and normal are the same, so that the player finds the same smooth and sharp edges.
Json skinJson(const Skin& skin) {
    std::vector<float> points, edges;
    std::vector<std::uint32_t> triangles;
    std::map<std::tuple<double, double, double, long, long, long>, std::uint32_t> known;
    const bool few = skin.facets.size() <= kMostTriangles;
    for (std::size_t i = 0; few && i < skin.facets.size(); ++i)
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3 &x = skin.facets[i].corners[k], n = 1e3 * skin.facets[i].normals[k];
            const std::tuple at(x.x, x.y, x.z, std::lround(n.x), std::lround(n.y), std::lround(n.z));
            const auto [found, fresh] = known.emplace(at, static_cast<std::uint32_t>(known.size()));
            if (fresh) put(points, x);
            triangles.push_back(found->second);
        }
    for (const Edge& e : skin.edges)
        if (e.sharp()) {
            put(edges, e.from);
            put(edges, e.to);
        }
    return {{"points", packed(points)}, {"triangles", packed(triangles)}, {"edges", packed(edges)}};
}

Json posesJson(const DrawnBody& body, const Case& c, const std::vector<Frame>& frames) {
    std::vector<float> poses;
    for (const Frame& frame : frames) {
        const geometry::Pose pose = poseOf(body, c, frame);
        for (const double q : {pose.rotation.w, pose.rotation.x, pose.rotation.y, pose.rotation.z})
            poses.push_back(static_cast<float>(q));
        put(poses, pose.origin);
    }
    return packed(poses);
}

/// Around the powder, the canister and the bodies that have an end [m].
Box contentOf(const Case& c, const std::vector<DrawnBody>& bodies, const Frame& frame) {
    Box box{Vec3(geometry::kEndless), Vec3(-geometry::kEndless)};
    const auto include = [&box](const Vec3& low, const Vec3& high) {
        box.low = glm::min(box.low, low);
        box.high = glm::max(box.high, high);
    };
    const Particles& p = frame.particles;
    for (std::size_t i = 0; i < p.size(); ++i)
        if (p.status[i] == Status::Active) include(p.position[i] - p.radius[i], p.position[i] + p.radius[i]);
    if (c.canister) {
        const double half = c.canister->width / 2;
        include({-half, -half, 0}, {half, c.canister->height - half, c.canister->length + c.canister->throatLength});
    }
    for (const DrawnBody& body : bodies)
        for (const Facet& facet : placed(body.skin, poseOf(body, c, frame)).facets)
            for (const Vec3& corner : facet.corners) include(corner, corner);
    if (!(box.low.x <= box.high.x)) return c.world.domain;
    const Vec3 margin(0.02 * glm::length(box.high - box.low));
    return {box.low - margin, box.high + margin};
}

}  // namespace

Json bodiesJson(const Case& c, const std::vector<Frame>& frames, const Frame& settled) {
    std::vector<DrawnBody> bodies = bodiesOf(c);
    const Box content = contentOf(c, bodies, settled);
    const Vec3 first(-0.87, 0.28, 0.41);  // from where the player looks at first
    lookThrough(bodies, c, settled, glm::normalize(first), content);
    Json list = Json::array();
    for (const DrawnBody& drawn : bodies) {
        const RigidBody& body = c.world.bodies[drawn.index];
        Skin skin = drawn.skin;
        const bool ends = !skin.facets.empty();
        skin.add(endlessSkin(body, poseOf(drawn, c, settled), content));
        Json j = skinJson(skin);
        j["name"] = body.name;
        j["pane"] = drawn.seeThrough;
        j["ends"] = ends;
        j["poses"] = posesJson(drawn, c, frames);
        list.push_back(std::move(j));
    }
    return list;
}

Json motionJson(const Case& c, const std::vector<Frame>& frames) {
    Json poses = Json::array(), times = Json::array(), phases = Json::array(), doses = Json::array();
    std::vector<double> angles;
    bool moves = false;
    for (const DrawnBody& drawn : bodiesOf(c)) {
        poses.push_back(posesJson(drawn, c, frames));
        const geometry::Pose first = poseOf(drawn, c, frames.front());
        for (const Frame& frame : frames) {
            const geometry::Pose now = poseOf(drawn, c, frame);
            moves = moves || now.origin != first.origin || now.rotation != first.rotation;
        }
    }
    for (const Frame& frame : frames) {
        times.push_back(frame.time);
        phases.push_back(static_cast<int>(frame.phase));
        doses.push_back(frame.dose);
        angles.push_back(frame.coilAngle);
        moves = moves || (c.world.coil && frame.coilAngle != 0);
    }
    if (!moves) return nullptr;
    return {{"time_s", times}, {"phase", phases}, {"dose", doses}, {"coil_angle_rad", angles}, {"poses", poses}};
}

}  // namespace vkdose::report
