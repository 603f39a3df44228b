#pragma once
// The only search of the host, outside the backends, for spheres that overlap. It covers all spheres at one instant.

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

#include "host/model/particles.h"
#include "host/model/world.h"

namespace vkdose {

/// Calls `visit(i, j, ratio)` once for every two active particles that overlap: `ratio` is their overlap over the
/// smaller radius of the two [-]. They come in order of their place along the longest side of the bed.
template <class Visit>
void forEachOverlap(const Particles& p, const Visit& visit) {
    Vec3 low(std::numeric_limits<double>::infinity()), high = -low;
    std::vector<std::size_t> order;
    double largest = 0;
    for (std::size_t i = 0; i < p.size(); ++i) {
        if (p.status[i] != Status::Active) continue;
        order.push_back(i);
        low = glm::min(low, p.position[i]);
        high = glm::max(high, p.position[i]);
        largest = std::max(largest, p.radius[i]);
    }
    const Vec3 size = high - low;  // few particles are side by side along the longest side
    const glm::length_t axis = size.x > size.y && size.x > size.z ? 0 : size.y > size.z ? 1 : 2;
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return p.position[a][axis] < p.position[b][axis]; });
    for (auto a = order.begin(); a != order.end(); ++a) {
        const std::size_t i = *a;
        const double reach = p.position[i][axis] + p.radius[i] + largest;
        for (auto b = a + 1; b != order.end() && p.position[*b][axis] < reach; ++b) {
            const std::size_t j = *b;
            const Vec3 apart = p.position[j] - p.position[i];
            const double touch = p.radius[i] + p.radius[j];
            if (glm::dot(apart, apart) >= touch * touch) continue;
            visit(i, j, (touch - glm::length(apart)) / std::min(p.radius[i], p.radius[j]));
        }
    }
}

/// Particles, and behind them their images.
struct Imaged {
    Particles all;
    std::vector<std::size_t> of;  ///< the particle of each image
};
/// The images that may touch a particle at the other end of a domain that repeats: each pair that touches across an end
/// is there once.
Imaged withImages(const World& world, const Particles& particles);

/// The same in a world whose domain may repeat. There they come in any order.
template <class Visit>
void forEachOverlap(const World& world, const Particles& p, const Visit& visit) {
    if (!world.repeats()) return forEachOverlap(p, visit);
    const Imaged imaged = withImages(world, p);
    const auto particle = [&](std::size_t i) { return i < p.size() ? i : imaged.of[i - p.size()]; };
    forEachOverlap(imaged.all, [&](std::size_t i, std::size_t j, double ratio) {
        if (i < p.size() || j < p.size()) visit(particle(i), particle(j), ratio);
    });
}

}  // namespace vkdose
