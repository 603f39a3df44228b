#include "host/analysis/compression.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vkdose {

namespace {

constexpr double kContact = 0.01;  // of the largest stress

/// The gap at which the force is `force`, between two lines.
double gapAt(const PistonSample& a, const PistonSample& b, double force) {
    if (a.force == b.force) return b.gap;
    return a.gap + (b.gap - a.gap) * (force - a.force) / (b.force - a.force);
}

}  // namespace

std::optional<Compression> compressionOf(const std::vector<PistonSample>& samples, double mass, double area) {
    if (samples.size() < 3) return std::nullopt;
    std::vector<PistonSample> middle;  // of each line: the mean force at the middle of the way
    for (std::size_t i = 1; i < samples.size(); ++i)
        middle.push_back({(samples[i - 1].gap + samples[i].gap) / 2, samples[i].force});
    const auto byForce = [](const PistonSample& a, const PistonSample& b) { return a.force < b.force; };
    const auto byGap = [](const PistonSample& a, const PistonSample& b) { return a.gap < b.gap; };
    const double most = std::max_element(middle.begin(), middle.end(), byForce)->force;
    if (!(most > 0)) return std::nullopt;
    const double touching = kContact * most;
    const auto density = [&](double gap) { return mass / (area * gap); };

    Compression c;
    c.maxStress = most / area;
    const auto smallest = std::min_element(samples.begin(), samples.end(), byGap);
    const std::size_t turn = static_cast<std::size_t>(smallest - samples.begin());
    c.loadedDensity = density(smallest->gap);
    const auto touch = std::find_if(middle.begin(), middle.end(), [&](const auto& m) { return m.force > touching; });
    c.looseDensity = density(touch == middle.begin() ? touch->gap : gapAt(*(touch - 1), *touch, touching));
    c.releasedDensity = c.recovery = std::numeric_limits<double>::quiet_NaN();
    for (std::size_t i = std::max<std::size_t>(turn, 1); i < middle.size(); ++i) {
        if (middle[i].force > touching || middle[i - 1].force <= touching) continue;
        const double gap = gapAt(middle[i - 1], middle[i], touching);
        c.releasedDensity = density(gap);
        c.recovery = (gap - smallest->gap) / smallest->gap;
        break;
    }
    for (std::size_t i = 1; i < samples.size(); ++i) {
        const double work = samples[i].force * (samples[i - 1].gap - samples[i].gap);
        (i <= turn ? c.work : c.returned) += i <= turn ? work : -work;
    }
    return c;
}

}  // namespace vkdose
