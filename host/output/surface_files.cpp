#include "host/output/surface_files.h"

#include <algorithm>
#include <map>
#include <tuple>

#include "geometry/surface_mesh.h"
#include "host/model/body_mesh.h"
#include "host/output/frame_files.h"
#include "host/output/vtkhdf.h"

namespace vkdose {

namespace {

/// Corners that triangles share are written once.
vtkhdf::Grid triangles(const std::vector<geometry::Triangle>& mesh) {
    vtkhdf::Grid grid;
    grid.cell = vtkhdf::Cell::Triangle;
    std::vector<float> points;
    std::map<std::tuple<float, float, float>, std::int64_t> known;
    for (const geometry::Triangle& t : mesh)
        for (const Vec3& corner : t) {
            const std::tuple at(static_cast<float>(corner.x), static_cast<float>(corner.y),
                                static_cast<float>(corner.z));
            const auto [found, fresh] = known.emplace(at, static_cast<std::int64_t>(known.size()));
            if (fresh) points.insert(points.end(), {std::get<0>(at), std::get<1>(at), std::get<2>(at)});
            grid.connectivity.push_back(found->second);
        }
    grid.points.values = std::move(points);
    return grid;
}

bool moves(const RigidBody& body) {
    return !std::holds_alternative<geometry::Rest>(body.course.motion);
}

/// Collects triangles, and whose they are.
struct Collection {
    std::vector<geometry::Triangle> mesh;
    std::vector<std::uint32_t> owner;

    void add(const std::vector<geometry::Triangle>& more, std::size_t whose) {
        mesh.insert(mesh.end(), more.begin(), more.end());
        owner.resize(mesh.size(), static_cast<std::uint32_t>(whose));
    }
    void add(const World& world, bool moving, const Frame& frame) {
        for (std::size_t b = 0; b < world.bodies.size(); ++b) {
            const RigidBody& body = world.bodies[b];
            if (moves(body) != moving) continue;
            const geometry::Pose pose = body.pose(frame.time, frame.coilAngle, frame.movedOf(b));
            add(placed(bodyMesh(body, world.domain), pose), b + 1);
        }
    }
    vtkhdf::Grid grid(const World& world) {
        vtkhdf::Grid grid = triangles(mesh);
        if (!world.bodies.empty()) grid.cellData = {{"body", "", 1, std::move(owner)}};
        return grid;
    }
};

}  // namespace

std::string wallsFile(const Case& c) {
    const World& w = c.world;
    Vec3 low = w.domain.low, high = w.domain.high;
    if (c.canister) {
        const double half = c.canister->width / 2;
        low = Vec3(-half, -half, 0);
        high = Vec3(half, c.canister->height - half, c.canister->length);
        for (const Wall& wall : w.walls)  // a lid may lie higher
            if (const auto* plane = std::get_if<geometry::Plane>(&wall.shape))
                high.y = std::max(high.y, plane->point.y);
    }
    Collection walls;
    walls.add(geometry::surfaceMesh(shapesOf(w.walls), low, high), 0);
    walls.add(w, false, Frame{});
    return walls.mesh.empty() ? "" : vtkhdf::file(walls.grid(w));
}

bool bodiesMove(const World& world) {
    return std::any_of(world.bodies.begin(), world.bodies.end(), moves);
}

std::string bodiesFile(const Frame& frame, const World& world) {
    Collection bodies;
    bodies.add(world, true, frame);
    vtkhdf::Grid grid = bodies.grid(world);
    grid.fieldData = fieldsOf(frame);
    return vtkhdf::file(grid);
}

std::string coilFile(const Frame& frame, const geometry::Coil& coil) {
    constexpr int kAround = 10, kPerTurn = 36;
    geometry::Coil turned = coil;
    turned.startAngle += frame.coilAngle;
    vtkhdf::Grid grid = triangles(geometry::coilMesh(turned, kAround, kPerTurn));
    grid.fieldData = fieldsOf(frame);
    return vtkhdf::file(grid);
}

}  // namespace vkdose
