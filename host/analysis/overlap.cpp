#include "host/analysis/overlap.h"

#include <algorithm>
#include <limits>

#include "geometry/surface.h"

namespace vkdose {

namespace {

/// Indices of the active particles in order of their coordinate `axis`.
std::vector<std::size_t> activeAlong(const Particles& p, int axis) {
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < p.size(); ++i)
        if (p.status[i] == Status::Active) order.push_back(i);
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return p.position[a][axis] < p.position[b][axis]; });
    return order;
}

/// The axis along which the active particles spread most: few of them are side by side there.
int longestAxis(const Particles& p) {
    Vec3 low(std::numeric_limits<double>::infinity()), high = -low;
    for (std::size_t i = 0; i < p.size(); ++i) {
        if (p.status[i] != Status::Active) continue;
        low = glm::min(low, p.position[i]);
        high = glm::max(high, p.position[i]);
    }
    const Vec3 size = high - low;
    return size.x > size.y && size.x > size.z ? 0 : size.y > size.z ? 1 : 2;
}

void addPairs(const Particles& p, std::vector<double>& ratio) {
    const int axis = longestAxis(p);
    const std::vector<std::size_t> order = activeAlong(p, axis);
    double largest = 0;
    for (const std::size_t i : order) largest = std::max(largest, p.radius[i]);
    for (auto a = order.begin(); a != order.end(); ++a) {
        const std::size_t i = *a;
        const double reach = p.position[i][axis] + p.radius[i] + largest;
        for (auto b = a + 1; b != order.end() && p.position[*b][axis] < reach; ++b) {
            const std::size_t j = *b;
            const Vec3 apart = p.position[j] - p.position[i];
            const double touch = p.radius[i] + p.radius[j];
            if (glm::dot(apart, apart) >= touch * touch) continue;
            const double deep = (touch - glm::length(apart)) / std::min(p.radius[i], p.radius[j]);
            ratio[i] = std::max(ratio[i], deep);
            ratio[j] = std::max(ratio[j], deep);
        }
    }
}

}  // namespace

std::vector<double> overlapRatios(const Particles& particles, const World& world, double coilAngle) {
    std::vector<double> ratio(particles.size(), 0.0);
    addPairs(particles, ratio);
    for (std::size_t i = 0; i < particles.size(); ++i) {
        if (particles.status[i] != Status::Active) continue;
        const Vec3& x = particles.position[i];
        const double a = particles.radius[i];
        for (const geometry::Surface& surface : world.surfaces)
            ratio[i] = std::max(ratio[i], 1 - geometry::closestPoint(surface, x).distance / a);
        if (!world.coil) continue;
        for (const geometry::CoilTouch& touch : geometry::touches(*world.coil, coilAngle, x, a))
            ratio[i] = std::max(ratio[i], 1 - touch.distance / a);
    }
    return ratio;
}

}  // namespace vkdose
