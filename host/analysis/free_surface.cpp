#include "host/analysis/free_surface.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

namespace vkdose {

namespace {

/// Lattice points to a column; across, the lattice is as fine or finer.
constexpr std::size_t kFineness = 8;

/// Points in the middles of `count` equal parts of a stretch.
struct Axis {
    double low, step;
    std::size_t count;

    double at(std::size_t i) const { return low + (static_cast<double>(i) + 0.5) * step; }

    /// The first point at or beyond x; `count` if all lie before it.
    std::size_t from(double x) const {
        const double i = std::ceil((x - low) / step - 0.5);
        return static_cast<std::size_t>(std::clamp(i, 0.0, static_cast<double>(count)));
    }
};

Axis axisOf(double low, double high, std::size_t count) {
    return {low, (high - low) / static_cast<double>(count), count};
}

double floorAt(const Canister& canister, double x) {
    const double half = canister.width / 2;
    return canister.flatFloor ? 0 : half - std::sqrt(std::max(0.0, half * half - x * x));
}

}  // namespace

SurfaceProfile surfaceProfile(const Particles& particles, const Canister& canister, std::size_t columns, Across width,
                              const Strip& strip) {
    const double half = canister.width / 2;
    const double from = std::max(strip.from, -half), to = std::min(strip.to, half);
    if (columns == 0 || !(from < to))
        throw std::invalid_argument("a surface profile takes a column, and a strip within the canister");

    const Axis along = axisOf(0, canister.length, columns * kFineness);
    const Axis across = axisOf(from, to, static_cast<std::size_t>(std::ceil((to - from) / along.step)));
    std::vector<double> top(along.count * across.count, 0.0);
    for (std::size_t i = 0; i < along.count && width == Across::Mean; ++i)
        for (std::size_t j = 0; j < across.count; ++j) top[i * across.count + j] = floorAt(canister, across.at(j));

    for (std::size_t k = 0; k < particles.size(); ++k) {
        if (particles.status[k] != Status::Active) continue;
        const Vec3& x = particles.position[k];
        const double r = particles.radius[k];
        for (std::size_t i = along.from(x.z - r); i < along.count && along.at(i) <= x.z + r; ++i)
            for (std::size_t j = across.from(x.x - r); j < across.count && across.at(j) <= x.x + r; ++j) {
                const double dz = along.at(i) - x.z, dx = across.at(j) - x.x, rest = r * r - dz * dz - dx * dx;
                double& highest = top[i * across.count + j];
                if (rest >= 0) highest = std::max(highest, half + x.y + std::sqrt(rest));
            }
    }

    SurfaceProfile profile;
    profile.height.assign(columns, 0.0);
    for (std::size_t c = 0; c < columns; ++c) profile.z.push_back(axisOf(0, canister.length, columns).at(c));
    for (std::size_t i = 0; i < along.count; ++i) {
        const auto begin = top.begin() + static_cast<std::ptrdiff_t>(i * across.count);
        const auto end = begin + static_cast<std::ptrdiff_t>(across.count);
        const double height = width == Across::Highest
                                  ? *std::max_element(begin, end)
                                  : std::accumulate(begin, end, 0.0) / static_cast<double>(across.count);
        profile.height[i / kFineness] += height / kFineness;
    }
    return profile;
}

}  // namespace vkdose
