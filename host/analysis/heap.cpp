#include "host/analysis/heap.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "geometry/surface.h"
#include "host/analysis/averaged_view.h"
#include "host/analysis/beta.h"
#include "host/analysis/surface_map.h"
#include "host/core/line_fit.h"
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
    std::vector<double> angles;
    for (const LineFit& q : quarters) angles.push_back(std::atan(-q.slope()));
    const Estimate ofQuarters = estimateOf(angles);  // leaves out a quarter without a line
    slope.error = ofQuarters.count == 4 ? ofQuarters.standardError : std::nan("");
    return slope;
}

namespace {

constexpr int kViews = 16;  // photographs from all sides; each shows two flanks

/// The powder as a camera sees it that has gone round the heap by this angle [rad].
Particles seenFrom(const Particles& particles, double angle) {
    Particles turned = particles;
    for (Vec3& at : turned.position)
        at = {std::cos(angle) * at.x + std::sin(angle) * at.z, at.y, std::cos(angle) * at.z - std::sin(angle) * at.x};
    return turned;
}

double widthOf(const Particles& particles) {
    double width = 0;
    for (std::size_t i = 0; i < particles.size(); ++i)
        if (particles.status[i] == Status::Active)
            width = std::max(width, std::hypot(particles.position[i].x, particles.position[i].z) + particles.radius[i]);
    return width;
}

/// A flank of a photograph.
struct Flank {
    LineFit line;             ///< height over the distance from the axis, which is negative on the left
    double from = 0, to = 0;  ///< distances of its ends from the axis [m]
};

/// The flank of the photograph to the right of its highest column (`side` 1) or to the left (-1).
Flank flankOf(const AveragedView& view, const std::vector<std::optional<double>>& heights, int top, int side) {
    const auto height = [&](int c) {
        return c < 0 || c >= view.columns() ? 0 : heights[static_cast<std::size_t>(c)].value_or(0);
    };
    int column = top;
    while (height(column) > kFlankHigh * height(top)) column += side;
    Flank flank;
    flank.from = flank.to = side * view.x(column) - view.pixel() / 2;
    for (; height(column) >= kFlankLow * height(top); column += side) {
        flank.line.add(side * view.x(column), height(column));
        flank.to = side * view.x(column) + view.pixel() / 2;
    }
    return flank;
}

}  // namespace

std::optional<HeapSlope> heapSlopeFromSide(const Particles& particles) {
    const double diameter = 2 * meanActiveRadius(particles), width = widthOf(particles);
    if (!(diameter > 0)) return std::nullopt;
    HeapSlope slope;
    std::array<double, 4> quarters{};
    for (int k = 0; k < kViews; ++k) {
        AveragedView view(width, diameter / kPixelsOfDiameter);
        view.add(seenFrom(particles, kPi * k / kViews));
        const std::vector<std::optional<double>> heights = view.surface();
        const auto top = std::max_element(heights.begin(), heights.end());
        if (!(*top > 0.0)) return std::nullopt;
        slope.height += **top / kViews;
        for (const int side : {1, -1}) {
            const Flank flank = flankOf(view, heights, static_cast<int>(top - heights.begin()), side);
            if (!(flank.to - flank.from >= 3 * diameter)) return std::nullopt;
            const double angle = std::atan(-flank.line.slope());
            slope.angle += angle / (2 * kViews);
            slope.from += flank.from / (2 * kViews);
            slope.to += flank.to / (2 * kViews);
            quarters.at(static_cast<std::size_t>((side > 0 ? k : kViews + k) / 8)) += angle / 8;
        }
    }
    slope.error = estimateOf(quarters).standardError;
    return slope;
}

}  // namespace vkdose
