#include "host/analysis/beta.h"

#include <algorithm>
#include <cmath>

namespace vkdose {

namespace {

/// Part of the fill after which a cumulative curve counts as saturated; a choice, see `beforeSaturation`.
constexpr double kSaturated = 0.8;

}  // namespace

Window beforeSaturation(double filled) {
    Window window;
    window.cumulativeBelow = kSaturated * filled;
    return window;
}

Window windowOf(double filled) {
    Window w;
    w.cumulativeBelow = std::min(w.cumulativeBelow, beforeSaturation(filled).cumulativeBelow);
    return w;
}

Slope betaOf(std::span<const double> cumulativeMass, const Window& window) {
    const int first = std::max(window.from, 1);
    int last = first - 1;
    while (last < window.to && last < static_cast<int>(cumulativeMass.size()) &&
           cumulativeMass[last] < window.cumulativeBelow)
        ++last;
    Slope slope;
    slope.doses = last - first + 1;
    if (slope.doses < 2) return slope;

    const double n = slope.doses;
    const double spread = n * (n * n - 1) / 12;  // sum of (k - mean k)^2 over n consecutive k
    const int steps = slope.doses - 1;           // the doses between the points
    double tail = 0, squares = 0, mean = 0;
    slope.beta = 0;
    for (int k = steps; k >= 1; --k) {  // the point k places after the first
        tail += (k - (n - 1) / 2) / spread;
        const double dose = cumulativeMass[first + k - 1] - cumulativeMass[first + k - 2];
        slope.beta += tail * dose;
        squares += tail * tail;
        mean += dose / steps;
    }
    if (steps < 2) return slope;
    double variance = 0;
    for (int k = 1; k <= steps; ++k) {
        const double dose = cumulativeMass[first + k - 1] - cumulativeMass[first + k - 2];
        variance += (dose - mean) * (dose - mean) / (steps - 1);
    }
    slope.standardError = std::sqrt(variance * squares);
    return slope;
}

std::vector<double> cumulativeMasses(const std::vector<Dose>& doses) {
    std::vector<double> masses;
    for (const Dose& d : doses)
        if (d.complete) masses.push_back(d.cumulative);
    return masses;
}

Estimate estimateOf(std::span<const double> values) {
    Estimate e;
    double sum = 0, squares = 0;
    for (const double x : values) {
        if (!std::isfinite(x)) continue;
        sum += x;
        ++e.count;
    }
    if (e.count == 0) return e;
    e.mean = sum / e.count;
    for (const double x : values)
        if (std::isfinite(x)) squares += (x - e.mean) * (x - e.mean);
    if (e.count > 1) e.standardError = std::sqrt(squares / (e.count - 1) / e.count);
    return e;
}

}  // namespace vkdose
