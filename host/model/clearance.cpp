#include "host/model/clearance.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace vkdose {
namespace {

/// Distance of the coil's wire, or `reach` if it is farther than that.
double coilDistance(const geometry::Coil& coil, double angle, const Vec3& x, double reach) {
    const double room = reach + coil.wireRadius;
    const double fromAxis = std::hypot(x.x, x.y);
    const bool far =
        std::abs(fromAxis - coil.radius) > room || x.z < coil.zStart - room || x.z > coil.zStart + coil.length + room;
    return far ? reach : geometry::closestPoint(coil, angle, x).distance;
}

}  // namespace

Clearance::Clearance(const World& world, double time, double coilAngle, std::span<const BodyClock> clocks,
                     std::span<const FreeBody> free)
    : world_(world), coilAngle_(coilAngle) {
    for (std::size_t b = 0; b < world.bodies.size(); ++b) {
        const double own = static_cast<double>(clockOf(clocks, b).steps) * world.timeStep;
        poses_.push_back(world.bodies[b].pose(time, coilAngle, Moved(own, b < free.size() ? free[b] : FreeBody{})));
    }
}

Obstacle Clearance::nearest(const Vec3& x, double reach) const {
    Obstacle found{reach, {}};
    const auto consider = [&](double distance, const std::string& what) {
        if (distance < found.distance) found = {distance, what};
    };
    for (const Wall& wall : world_.walls) consider(geometry::closestPoint(wall.shape, x).distance, "a wall");
    if (world_.coil) consider(coilDistance(*world_.coil, coilAngle_, x, reach), "the coil");
    for (std::size_t b = 0; b < world_.bodies.size(); ++b) {
        const Vec3 inBody = poses_[b].toBody(x);
        for (const geometry::Shape& shape : world_.bodies[b].shapes)
            for (const geometry::Feature& place : geometry::places(shape, inBody, reach))
                consider(place.distance, fmt::format("body \"{}\"", world_.bodies[b].name));
    }
    return found;
}

}  // namespace vkdose
