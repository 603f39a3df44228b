#include "host/analysis/heap.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "geometry/surface.h"
#include "host/analysis/line_fit.h"
#include "host/analysis/surface_map.h"
#include "host/sim/density.h"

namespace vkdose {

Particles upright(const Particles& particles, const Vec3& foot, const Vec3& up) {
    const Vec3 x = geometry::anyNormal(up), z = glm::cross(x, up);
    Particles turned = particles;
    for (Vec3& at : turned.position) {
        const Vec3 from = at - foot;
        at = {glm::dot(from, x), glm::dot(from, up), glm::dot(from, z)};
    }
    return turned;
}

std::vector<geometry::Pose> upright(const std::vector<geometry::Pose>& poses, const Vec3& foot, const Vec3& up) {
    const Vec3 x = geometry::anyNormal(up), z = glm::cross(x, up);
    const geometry::Rotation turn = glm::quat_cast(glm::transpose(glm::dmat3(x, up, z)));
    std::vector<geometry::Pose> turned;
    for (const geometry::Pose& p : poses) turned.push_back({turn * p.rotation, turn * (p.origin - foot)});
    return turned;
}

namespace {

/// The part of the highest ring's height within which a ring belongs to the flank.
constexpr double kFlankLow = 0.2, kFlankHigh = 0.8;

/// Mean heights of the rings around the axis, each `width` [m] wide.
std::vector<double> ringHeights(const SurfaceMap& map, double width) {
    std::vector<double> sum, count;
    for (std::size_t i = 0; i < map.spots(); ++i) {
        const auto ring = static_cast<std::size_t>(std::hypot(map.x(i), map.z(i)) / width);
        if (ring >= sum.size()) {
            sum.resize(ring + 1);
            count.resize(ring + 1);
        }
        sum[ring] += std::max(0.0, map.top(i));
        ++count[ring];
    }
    for (std::size_t r = 0; r < sum.size(); ++r) sum[r] = count[r] > 0 ? sum[r] / count[r] : 0;
    return sum;
}

}  // namespace

std::optional<HeapSlope> heapSlope(const Particles& particles) {
    const double diameter = 2 * meanActiveRadius(particles);
    if (!(diameter > 0)) return std::nullopt;
    const SurfaceMap map(particles, diameter / 4);
    const std::vector<double> heights = ringHeights(map, diameter);
    if (heights.empty()) return std::nullopt;
    const auto top = std::max_element(heights.begin(), heights.end());
    const auto begin = std::find_if(top, heights.end(), [&](double h) { return h <= kFlankHigh * *top; });
    const auto end = std::find_if(begin, heights.end(), [&](double h) { return h < kFlankLow * *top; });
    if (end - begin < 3) return std::nullopt;

    HeapSlope slope;
    slope.height = *top;
    slope.from = diameter * static_cast<double>(begin - heights.begin());
    slope.to = diameter * static_cast<double>(end - heights.begin());
    LineFit whole;
    std::array<LineFit, 4> quarters;
    for (std::size_t i = 0; i < map.spots(); ++i) {
        const double r = std::hypot(map.x(i), map.z(i)), h = std::max(0.0, map.top(i));
        if (r < slope.from || r >= slope.to) continue;
        whole.add(r, h);
        quarters.at((map.x(i) < 0 ? 2U : 0U) + (map.z(i) < 0 ? 1U : 0U)).add(r, h);
    }
    slope.angle = std::atan(-whole.slope());
    double mean = 0, squares = 0;
    for (const LineFit& q : quarters) mean += std::atan(-q.slope()) / 4;
    for (const LineFit& q : quarters) squares += std::pow(std::atan(-q.slope()) - mean, 2);
    slope.error = std::sqrt(squares / 3) / 2;  // the deviation of four, over the root of four
    return slope;
}

}  // namespace vkdose
