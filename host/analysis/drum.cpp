#include "host/analysis/drum.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "host/analysis/beta.h"
#include "host/analysis/surface_map.h"
#include "host/core/line_fit.h"
#include "host/sim/density.h"

namespace vkdose {

Particles inDrum(const Particles& particles, const Vec3& through, const Vec3& axis, const Vec3& up) {
    const Vec3 across = up - glm::dot(up, axis) * axis;
    if (glm::length(across) < 1e-6) throw std::invalid_argument("the axis of the drum is upright");
    const Vec3 y = glm::normalize(across), x = glm::cross(y, axis);  // axis x (-y): where the lowest point goes
    Particles turned = particles;
    for (Vec3& at : turned.position) {
        const Vec3 from = at - through;
        at = {glm::dot(from, x), glm::dot(from, y), glm::dot(from, axis)};
    }
    return turned;
}

std::optional<double> drumAngle(const Particles& particles) {
    const double diameter = 2 * meanActiveRadius(particles);
    if (!(diameter > 0)) return std::nullopt;
    // The spots at the ends of the line come and go as it turns, so that the angle wavers by a fraction of a degree.
    // The mean of the last rounds does not.
    constexpr int kRounds = 10, kCounted = 6;
    constexpr double kSteady = 5 * kPi / 180;  // between the counted rounds
    double angle = 0, sum = 0, least = kPi, most = -kPi;
    for (int round = 0; round < kRounds; ++round) {
        Particles turned = particles;
        for (Vec3& x : turned.position)
            x = {std::cos(angle) * x.x + std::sin(angle) * x.y, std::cos(angle) * x.y - std::sin(angle) * x.x, x.z};
        const SurfaceMap map(turned, diameter / 4);
        double low = std::numeric_limits<double>::infinity(), high = -low;
        for (std::size_t i = 0; i < map.spots(); ++i) {
            if (!std::isfinite(map.top(i))) continue;
            low = std::min(low, map.x(i));
            high = std::max(high, map.x(i));
        }
        if (!(high - low > 10 * diameter)) return std::nullopt;
        const double quarter = (high - low) / 4;
        LineFit line;
        for (std::size_t i = 0; i < map.spots(); ++i)
            if (std::isfinite(map.top(i)) && map.x(i) > low + quarter && map.x(i) < high - quarter)
                line.add(map.x(i), map.top(i));
        const double more = std::atan(line.slope());
        if (!std::isfinite(more)) return std::nullopt;
        angle += more;
        if (round < kRounds - kCounted) continue;
        sum += angle;
        least = std::min(least, angle);
        most = std::max(most, angle);
    }
    if (most - least > kSteady) return std::nullopt;
    return sum / kCounted;
}

namespace {

constexpr int kQuarters = 4;
constexpr double kMostPixels = 1000;  // of the window's half

double pixelOf(double halfWidth, double diameter) {
    return std::max(diameter / kPixelsOfDiameter, halfWidth / kMostPixels);
}

}  // namespace

DrumFront::DrumFront(double halfWidth, double diameter, int photographs)
    : halfWidth_(halfWidth),
      diameter_(diameter),
      photographs_(photographs),
      all_(halfWidth, pixelOf(halfWidth, diameter)),
      quarters_(kQuarters, all_) {}

void DrumFront::add(const Particles& particles) {
    const int quarter = std::min(kQuarters * all_.photographs() / std::max(1, photographs_), kQuarters - 1);
    quarters_[static_cast<std::size_t>(quarter)].add(particles);
    all_.add(particles);
}

std::optional<double> DrumFront::angleOf(const AveragedView& view) const {
    const std::vector<std::optional<double>> heights = view.surface();
    LineFit line;
    for (int c = 0; c < view.columns(); ++c) {
        const auto& height = heights[static_cast<std::size_t>(c)];
        if (!height) return std::nullopt;
        line.add(view.x(c), *height);
    }
    return std::atan(line.slope());
}

int DrumFront::emptyColumns() const {
    const std::vector<std::optional<double>> heights = all_.surface();
    return static_cast<int>(std::count(heights.begin(), heights.end(), std::nullopt));
}

std::optional<SurfaceAngle> DrumFront::angle() const {
    if (!(2 * halfWidth_ > kLeastDiameters * diameter_)) return std::nullopt;
    const auto angle = angleOf(all_);
    if (!angle) return std::nullopt;
    std::vector<double> parts;
    for (const AveragedView& quarter : quarters_)
        if (const auto part = angleOf(quarter); part && quarter.photographs() > 1) parts.push_back(*part);
    return SurfaceAngle{*angle, parts.size() == kQuarters ? estimateOf(parts).standardError : std::nan("")};
}

}  // namespace vkdose
