#include "host/render/overlap.h"

#include <algorithm>
#include <cmath>

#include "geometry/coil.h"
#include "geometry/surface.h"

namespace vkdose::render {

namespace {

/// Overlaps of pairs, by a sweep along z: whoever touches is not further apart there than the largest diameter.
void addPairs(const Particles& p, std::vector<double>& overlaps) {
    std::vector<std::size_t> order;
    double largest = 0;
    for (std::size_t i = 0; i < p.size(); ++i)
        if (p.status[i] == Status::Active) {
            order.push_back(i);
            largest = std::max(largest, p.radius[i]);
        }
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return p.position[a].z < p.position[b].z; });
    for (std::size_t m = 0; m < order.size(); ++m)
        for (std::size_t n = m + 1; n < order.size(); ++n) {
            const std::size_t i = order[m], j = order[n];
            const Vec3 way = p.position[j] - p.position[i];
            if (way.z >= p.radius[i] + largest) break;
            const double reach = p.radius[i] + p.radius[j], square = glm::dot(way, way);
            if (square >= reach * reach) continue;
            const double ratio = (reach - std::sqrt(square)) / std::min(p.radius[i], p.radius[j]);
            overlaps[i] = std::max(overlaps[i], ratio);
            overlaps[j] = std::max(overlaps[j], ratio);
        }
}

}  // namespace

std::vector<double> largestOverlaps(const World& world, const Particles& p, double coilAngle) {
    std::vector<double> overlaps(p.size(), 0.0);
    addPairs(p, overlaps);
    for (std::size_t i = 0; i < p.size(); ++i) {
        if (p.status[i] != Status::Active) continue;
        const auto meet = [&](double distance, double smaller) {
            overlaps[i] = std::max(overlaps[i], (p.radius[i] - distance) / smaller);
        };
        for (const geometry::Surface& s : world.surfaces)
            meet(geometry::closestPoint(s, p.position[i]).distance, p.radius[i]);
        if (world.coil)
            for (const auto& touch : geometry::touches(*world.coil, coilAngle, p.position[i], p.radius[i]))
                meet(touch.distance, p.radius[i]);
    }
    return overlaps;
}

}  // namespace vkdose::render
