#include "host/analysis/steady.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace vkdose {

namespace {

constexpr std::size_t kMostBlocks = 10;
/// A difference by less than this share is rounding: the time series has nine digits of all that is out.
constexpr double kRounding = 1e-6;

double meanOf(std::span<const double> values) {
    double sum = 0;
    for (const double x : values) sum += x;
    return sum / static_cast<double>(values.size());
}

/// Sum of the squares about their mean.
double squaresOf(std::span<const double> values) {
    const double mean = meanOf(values);
    double sum = 0;
    for (const double x : values) sum += (x - mean) * (x - mean);
    return sum;
}

double errorOf(std::span<const double> values) {
    const std::size_t blocks = std::min(values.size(), kMostBlocks);
    std::vector<double> means;
    for (std::size_t b = 0; b < blocks; ++b) {
        const std::size_t from = b * values.size() / blocks, to = (b + 1) * values.size() / blocks;
        means.push_back(meanOf(values.subspan(from, to - from)));
    }
    const auto n = static_cast<double>(blocks);
    return std::sqrt(squaresOf(means) / (n - 1) / n);
}

}  // namespace

SeriesFigures seriesFigures(std::span<const double> values) {
    SeriesFigures f;
    if (values.empty()) return f;
    f.mean = meanOf(values);
    if (values.size() < kFewestWindows) return f;
    f.error = errorOf(values);
    const double deviation = std::sqrt(squaresOf(values) / static_cast<double>(values.size() - 1));
    if (f.mean > 0) f.relative = deviation / f.mean;
    return f;
}

std::optional<std::size_t> steadyFrom(std::span<const double> values) {
    const std::size_t half = values.size() / 2;
    if (values.size() < kFewestForSteady || !(meanOf(values) > 0)) return std::nullopt;
    const double rounding = kRounding * meanOf(values);
    std::size_t best = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t d = 0; d <= half; ++d) {
        const auto rest = values.subspan(d);
        const auto n = static_cast<double>(rest.size());
        const double squares = squaresOf(rest);
        const double judged = squares <= n * rounding * rounding ? 0 : squares / (n * n);
        if (judged >= least) continue;
        least = judged;
        best = d;
    }
    return best < half ? std::optional(best) : std::nullopt;
}

std::string rsdText(const SeriesFigures& figures) {
    const double percent = figures.relative * 100;
    return percent < 99.5 ? fmt::format("RSD {:.2g} %", percent) : fmt::format("RSD {:.0f} %", percent);
}

SteadySeries steadySeries(std::span<const double> values) {
    SteadySeries s;
    s.all = seriesFigures(values);
    s.steady = steadyFrom(values);
    if (s.steady) s.steadyPart = seriesFigures(values.subspan(*s.steady));
    return s;
}

}  // namespace vkdose
