#include "host/sim/body_room.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <variant>

namespace vkdose {

namespace {

using MeshPointer = std::shared_ptr<const geometry::MeshSurface>;

/// The shape, made anew where it is a mesh that was read for a shorter reach.
geometry::Shape reaching(const geometry::Shape& shape, double reach) {
    const auto* mesh = std::get_if<MeshPointer>(&shape);
    if (mesh == nullptr || (*mesh)->reach() >= reach) return shape;
    return std::make_shared<const geometry::MeshSurface>((*mesh)->mesh(), reach);
}

}  // namespace

BodyPoses bodyPoses(const World& world, double time, double driveAngle, const std::vector<Moved>& moved) {
    BodyPoses poses;
    for (std::size_t b = 0; b < world.bodies.size(); ++b)
        poses.push_back(world.bodies[b].pose(time, driveAngle, b < moved.size() ? moved[b] : Moved{}));
    return poses;
}

BodyRoom::BodyRoom(const World& world, const BodyPoses& poses, const Particles& particles, const Box& box,
                   double radius, double margin) {
    const Vec3 size = box.high - box.low;
    if (world.bodies.empty() || !(radius > 0) || !(size.x > 0 && size.y > 0 && size.z > 0)) return;
    constexpr double kMostCells = 3e7;
    low_ = box.low;
    side_ = std::max(radius / 2, std::cbrt(size.x * size.y * size.z / kMostCells));
    cells_ = glm::ivec3(glm::ceil(size / side_));
    taken_.assign(std::size_t(cells_.x) * std::size_t(cells_.y) * std::size_t(cells_.z), 0);
    // A cube whose centre is nearer than this lies wholly within the margin.
    const double reach = margin - side_ * std::sqrt(3.0) / 2;
    for (std::size_t b = 0; b < world.bodies.size() && reach > 0; ++b)
        takeNear(world.bodies[b], b < poses.size() ? poses[b] : world.bodies[b].pose(0, 0), reach);
    takeClosedOff(particles);
}

void BodyRoom::takeNear(const RigidBody& body, const geometry::Pose& pose, double reach) {
    for (const geometry::Shape& given : body.shapes) {
        const geometry::Shape shape = reaching(given, reach);
        for (int i = 0; i < cells_.x; ++i)
            for (int j = 0; j < cells_.y; ++j)
                for (int k = 0; k < cells_.z; ++k) {
                    std::uint8_t& taken = taken_[index({i, j, k})];
                    const Vec3 centre = low_ + side_ * (Vec3(i, j, k) + 0.5);
                    if (taken == 0 && !geometry::places(shape, pose.toBody(centre), reach).empty()) taken = 1;
                }
    }
}

/// Fills the cubes that are free from those with a sphere on; what is left is closed off.
void BodyRoom::takeClosedOff(const Particles& particles) {
    if (std::find(taken_.begin(), taken_.end(), 1) == taken_.end()) return;
    constexpr std::uint8_t kOpen = 2;
    std::vector<glm::ivec3> edge;
    const auto visit = [&](const glm::ivec3& i) {
        if (i.x < 0 || i.y < 0 || i.z < 0 || i.x >= cells_.x || i.y >= cells_.y || i.z >= cells_.z) return;
        std::uint8_t& cell = taken_[index(i)];
        if (cell != 0) return;
        cell = kOpen;
        edge.push_back(i);
    };
    for (std::size_t i = 0; i < particles.size(); ++i)
        if (particles.status[i] == Status::Active)
            visit(glm::ivec3(glm::floor((particles.position[i] - low_) / side_)));
    while (!edge.empty()) {
        const glm::ivec3 i = edge.back();
        edge.pop_back();
        for (int axis = 0; axis < 3; ++axis)
            for (const int step : {-1, 1}) {
                glm::ivec3 next = i;
                next[axis] += step;
                visit(next);
            }
    }
    for (std::uint8_t& cell : taken_) cell = cell == kOpen ? 0 : 1;
}

bool BodyRoom::takesAnyOver(double xFrom, double xTo, double zFrom, double zTo) const {
    if (taken_.empty()) return false;
    const auto cell = [&](double at, int axis) {
        return std::clamp(int(std::floor((at - low_[axis]) / side_)), 0, cells_[axis] - 1);
    };
    for (int i = cell(xFrom, 0); i <= cell(xTo, 0); ++i)
        for (int k = cell(zFrom, 2); k <= cell(zTo, 2); ++k)
            for (int j = 0; j < cells_.y; ++j)
                if (taken_[index({i, j, k})] != 0) return true;
    return false;
}

}  // namespace vkdose
