#include "host/model/size_distribution.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "host/core/random.h"

namespace vkdose {
namespace {

constexpr std::uint32_t kMaxAttempts = 100000;

double normalCdf(double z) {
    return 0.5 * std::erfc(-z / std::sqrt(2.0));
}

/// A stretch of the volume distribution: `slope` = d(volume fraction)/d(ln r) between two radii.
struct Stretch {
    double low;
    double high;
    double slope;

    /// Integral of r^power d(number), with d(number) = slope r^-3 d(ln r); up to a common factor.
    double moment(int power) const {
        if (power == 3) return slope * std::log(high / low);
        const double exponent = power - 3;
        return slope * (std::pow(high, exponent) - std::pow(low, exponent)) / exponent;
    }
    /// Radius below which a fraction t of the stretch's particles lie.
    double quantile(double t) const {
        const double a = std::pow(low, -3.0);
        const double b = std::pow(high, -3.0);
        return std::pow(a - t * (a - b), -1.0 / 3.0);
    }
};

/// The stretches of the volume distribution, cut at the truncation bounds: the two slopes of the quantiles, or one
/// between two sieves. An empty stretch has low == high, or no slope.
std::vector<Stretch> stretches(const SizeDistribution& size) {
    const auto cut = [&](double r) { return std::clamp(r, size.radiusMin, size.radiusMax); };
    if (size.kind == SizeDistribution::Kind::Quantiles)
        return {Stretch{cut(finestRadius(size)), cut(size.r50), 0.4 / std::log(size.r50 / size.r10)},
                Stretch{cut(size.r50), cut(coarsestRadius(size)), 0.4 / std::log(size.r90 / size.r50)}};
    std::vector<Stretch> all;
    for (std::size_t i = 0; i + 1 < size.sieve.size(); ++i) {
        const SievePoint &low = size.sieve[i], &high = size.sieve[i + 1];
        all.push_back(
            {cut(low.radius), cut(high.radius), (high.finer - low.finer) / std::log(high.radius / low.radius)});
    }
    return all;
}

double sumOfMoments(const std::vector<Stretch>& all, int power) {
    double sum = 0;
    for (const Stretch& s : all) sum += s.moment(power);
    return sum;
}

double numberMoment(const SizeDistribution& size, int power) {
    const std::vector<Stretch> all = stretches(size);
    return sumOfMoments(all, power) / sumOfMoments(all, 0);
}

/// Mean of r^power over a Normal or Lognormal that is cut at its bounds, by the trapezoid rule. The integrand is smooth
/// and 2000 steps cover at most 17 deviations, so that the mean is right to 1e-5.
double truncatedMoment(const SizeDistribution& size, int power) {
    constexpr int kSteps = 2000;
    constexpr double kFarthest = 8.5;  // in deviations; the part beyond is less than a double's rounding
    const bool normal = size.kind == SizeDistribution::Kind::Normal;
    const auto deviations = [&](double r) {
        const double z = (normal ? r - size.radius : std::log(r / size.radius)) / size.deviation;
        return std::clamp(z, -kFarthest, kFarthest);
    };
    const double low = deviations(size.radiusMin);
    const double high = deviations(size.radiusMax);
    double sum = 0;
    double weights = 0;
    for (int i = 0; i <= kSteps; ++i) {
        const double z = low + (high - low) * i / kSteps;
        const double weight = std::exp(-0.5 * z * z) * (i == 0 || i == kSteps ? 0.5 : 1.0);
        const double r = normal ? size.radius + size.deviation * z : size.radius * std::exp(size.deviation * z);
        sum += weight * std::pow(std::clamp(r, size.radiusMin, size.radiusMax), power);
        weights += weight;
    }
    return sum / weights;
}

/// A draw from the number distribution that the stretches of the volume make, `u` from 0 to 1.
double drawByVolume(const SizeDistribution& size, double u) {
    const std::vector<Stretch> all = stretches(size);
    const double number = sumOfMoments(all, 0);
    double below = 0;
    for (std::size_t i = 0; i < all.size(); ++i) {
        const double share = all[i].moment(0) / number, end = i + 1 == all.size() ? 1 : below + share;
        if (share > 0 && (u < end || i + 1 == all.size()))  // pow may be off by the last bit
            return std::clamp(all[i].quantile((u - below) / (end - below)), size.radiusMin, size.radiusMax);
        below = end;
    }
    return largestRadius(size);
}

}  // namespace

bool byVolume(const SizeDistribution& size) {
    return size.kind == SizeDistribution::Kind::Quantiles || size.kind == SizeDistribution::Kind::Sieve;
}

double drawRadius(const SizeDistribution& size, std::uint64_t seed, std::uint64_t index, std::uint64_t& redrawn) {
    if (size.kind == SizeDistribution::Kind::Fixed) return size.radius;
    for (std::uint32_t attempt = 0; attempt < kMaxAttempts; ++attempt) {
        const auto [u, v] = uniforms(seed, Stream::Radius, index, attempt);
        if (size.kind == SizeDistribution::Kind::Uniform) return size.radiusMin + u * (size.radiusMax - size.radiusMin);
        if (byVolume(size)) return drawByVolume(size, u);
        const double gauss = std::sqrt(-2 * std::log(u)) * std::cos(2 * kPi * v);  // Box and Muller
        const double r = size.kind == SizeDistribution::Kind::Normal ? size.radius + size.deviation * gauss
                                                                     : size.radius * std::exp(size.deviation * gauss);
        if (r >= size.radiusMin && r <= size.radiusMax) return r;
        ++redrawn;
    }
    throw std::logic_error("the truncation bounds of the size distribution leave nothing to draw");
}

double smallestRadius(const SizeDistribution& size) {
    if (size.kind == SizeDistribution::Kind::Fixed) return size.radius;
    if (byVolume(size)) return std::max(size.radiusMin, finestRadius(size));
    return size.radiusMin;
}

double largestRadius(const SizeDistribution& size) {
    if (size.kind == SizeDistribution::Kind::Fixed) return size.radius;
    if (byVolume(size)) return std::min(size.radiusMax, coarsestRadius(size));
    return size.radiusMax;
}

double meanRadius(const SizeDistribution& size) {
    switch (size.kind) {
        case SizeDistribution::Kind::Uniform:
            return 0.5 * (size.radiusMin + size.radiusMax);
        case SizeDistribution::Kind::Normal:
        case SizeDistribution::Kind::Lognormal:
            return truncatedMoment(size, 1);
        case SizeDistribution::Kind::Quantiles:
        case SizeDistribution::Kind::Sieve:
            return numberMoment(size, 1);
        default:
            return size.radius;
    }
}

double meanCubedRadius(const SizeDistribution& size) {
    const double a = size.radiusMin;
    const double b = size.radiusMax;
    const double r = size.radius;
    switch (size.kind) {
        case SizeDistribution::Kind::Uniform:
            return (a + b) * (a * a + b * b) / 4;
        case SizeDistribution::Kind::Normal:
        case SizeDistribution::Kind::Lognormal:
            return truncatedMoment(size, 3);
        case SizeDistribution::Kind::Quantiles:
        case SizeDistribution::Kind::Sieve:
            return numberMoment(size, 3);
        default:
            return r * r * r;
    }
}

SizeDistribution enlarged(SizeDistribution size, double factor) {
    for (double* r : {&size.radius, &size.radiusMin, &size.radiusMax, &size.r10, &size.r50, &size.r90}) *r *= factor;
    if (size.kind != SizeDistribution::Kind::Lognormal) size.deviation *= factor;
    for (SievePoint& s : size.sieve) s.radius *= factor;
    size.scaleUp *= factor;
    return size;
}

double acceptance(const SizeDistribution& size) {
    const auto inside = [&](double low, double high) { return normalCdf(high) - normalCdf(low); };
    const double s = size.deviation;
    if (size.kind == SizeDistribution::Kind::Normal)
        return inside((size.radiusMin - size.radius) / s, (size.radiusMax - size.radius) / s);
    if (size.kind == SizeDistribution::Kind::Lognormal)
        return inside(std::log(size.radiusMin / size.radius) / s, std::log(size.radiusMax / size.radius) / s);
    return 1;
}

double finerVolume(const SizeDistribution& size, double radius) {
    if (size.kind == SizeDistribution::Kind::Sieve) {
        const auto above = std::find_if(size.sieve.begin(), size.sieve.end(),
                                        [&](const SievePoint& point) { return point.radius >= radius; });
        if (above == size.sieve.end()) return 1;
        if (above == size.sieve.begin()) return 0;
        const SievePoint &low = *(above - 1), &high = *above;
        const double part = std::log(radius / low.radius) / std::log(high.radius / low.radius);
        return low.finer + part * (high.finer - low.finer);
    }
    const double neighbour = radius < size.r50 ? size.r10 : size.r90;
    const double slope = 0.4 / std::abs(std::log(size.r50 / neighbour));
    return std::clamp(0.5 + slope * std::log(radius / size.r50), 0.0, 1.0);
}

// Between the median and the end lies a volume of 0.5, between the median and the quantile 0.4. The end is therefore
// 0.5 / 0.4 = 1.25 times as far from the median in ln r as the quantile.
double finestRadius(const SizeDistribution& size) {
    if (size.kind == SizeDistribution::Kind::Sieve) return size.sieve.empty() ? kNaN : size.sieve.front().radius;
    return size.r50 * std::pow(size.r10 / size.r50, 1.25);
}
double coarsestRadius(const SizeDistribution& size) {
    if (size.kind == SizeDistribution::Kind::Sieve) return size.sieve.empty() ? kNaN : size.sieve.back().radius;
    return size.r50 * std::pow(size.r90 / size.r50, 1.25);
}

std::vector<NumberClass> numberClasses(const SizeDistribution& size) {
    const std::vector<Stretch> all = stretches(size);
    const double number = sumOfMoments(all, 0);
    std::vector<NumberClass> classes;
    for (const Stretch& s : all)
        if (s.moment(0) > 0) classes.push_back({s.low, s.high, s.moment(0) / number});
    return classes;
}

}  // namespace vkdose
