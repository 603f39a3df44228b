#include "host/analysis/overlap.h"

#include <algorithm>

#include "geometry/surface.h"
#include "host/model/overlaps.h"

namespace vkdose {

std::vector<double> overlapRatios(const Particles& particles, const World& world, double coilAngle, double time,
                                  const std::vector<Moved>& moved) {
    std::vector<double> ratio(particles.size(), 0.0);
    forEachOverlap(world, particles, [&](std::size_t i, std::size_t j, double deep) {
        ratio[i] = std::max(ratio[i], deep);
        ratio[j] = std::max(ratio[j], deep);
    });
    std::vector<geometry::Pose> poses;
    for (std::size_t b = 0; b < world.bodies.size(); ++b)
        poses.push_back(world.bodies[b].pose(time, coilAngle, b < moved.size() ? moved[b] : Moved{}));
    for (std::size_t i = 0; i < particles.size(); ++i) {
        if (particles.status[i] != Status::Active) continue;
        const Vec3& x = particles.position[i];
        const double a = particles.radius[i];
        for (const Wall& wall : world.walls)
            ratio[i] = std::max(ratio[i], 1 - geometry::closestPoint(wall.shape, x).distance / a);
        for (std::size_t b = 0; b < world.bodies.size(); ++b)
            for (const geometry::Shape& shape : world.bodies[b].shapes)
                for (const geometry::Feature& place : geometry::places(shape, poses[b].toBody(x), a))
                    ratio[i] = std::max(ratio[i], 1 - place.distance / a);
        if (!world.coil) continue;
        for (const geometry::CoilTouch& touch : geometry::touches(*world.coil, coilAngle, x, a))
            ratio[i] = std::max(ratio[i], 1 - touch.distance / a);
    }
    return ratio;
}

}  // namespace vkdose
