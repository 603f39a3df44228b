#include "host/photo/light.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>

namespace vkdose::photo {

namespace {

/// This many pixels are enough to fit the light. A photograph has a hundred times as many.
constexpr int kFitPixels = 40000;
/// Rounds of fitting the light and telling the kinds apart again. Four or five suffice on every picture of the tests.
constexpr int kPasses = 10;
/// Share of the pixels that the stretching makes black, and white.
constexpr double kClipped = 0.005;
/// The largest ratio of the brightest to the middle light that is believed. Beyond it, the polynomial fits something
/// else.
constexpr double kMostLight = 4;

constexpr int kTerms = 5;
using Terms = std::array<double, kTerms>;

/// The polynomial's terms at the place (x, y) in a picture, with coordinates scaled to -1 ... 1. There is no constant
/// term, because it is the brightness of the kinds.
Terms termsAt(int x, int y, const Grey& grey) {
    const double u = 2.0 * x / std::max(grey.width - 1, 1) - 1, v = 2.0 * y / std::max(grey.height - 1, 1) - 1;
    return {u, v, u * u, u * v, v * v};
}

struct Light {
    Terms coefficient{};
    double at(const Terms& t) const {
        double sum = 0;
        for (int k = 0; k < kTerms; ++k) sum += coefficient[std::size_t(k)] * t[std::size_t(k)];
        return std::clamp(std::exp(sum), 1 / kMostLight, kMostLight);
    }
};

double underEvenLight(const Grey& grey, int x, int y, const Light& light) {
    return grey.at(x, y) / light.at(termsAt(x, y, grey));
}

/// The values that become black and white.
struct Range {
    double low, high;
};

Range rangeOf(const Grey& grey, const Light& light) {
    std::vector<double> value;
    for (int y = 0; y < grey.height; ++y)
        for (int x = 0; x < grey.width; ++x) value.push_back(underEvenLight(grey, x, y, light));
    const auto quantile = [&value](double share) {
        const auto place = value.begin() + std::ptrdiff_t(share * double(value.size() - 1));
        std::nth_element(value.begin(), place, value.end());
        return *place;
    };
    const double low = quantile(kClipped);
    return {low, quantile(1 - kClipped)};
}

Grey stretched(const Grey& grey, const Light& light, const Range& range) {
    if (!(range.high > range.low)) return grey;
    Grey out(grey.width, grey.height);
    for (int y = 0; y < grey.height; ++y) {
        for (int x = 0; x < grey.width; ++x) {
            const double share = (underEvenLight(grey, x, y, light) - range.low) / (range.high - range.low);
            out.at(x, y) = std::uint8_t(std::lround(std::clamp(share, 0.0, 1.0) * 255));
        }
    }
    return out;
}

/// Every n-th pixel in both directions.
Grey thinned(const Grey& grey) {
    const int n = std::max(1, int(std::sqrt(double(grey.value.size()) / kFitPixels)));
    Grey out((grey.width + n - 1) / n, (grey.height + n - 1) / n);
    for (int y = 0; y < out.height; ++y)
        for (int x = 0; x < out.width; ++x) out.at(x, y) = grey.at(x * n, y * n);
    return out;
}

/// Least squares of log(value) = log(brightness of the pixel's kind) + polynomial. The weight is the value squared,
/// because the noise of a logarithm falls with the value.
Light fitted(const Grey& grey, const Grey& even) {
    constexpr int kUnknowns = kTerms + 2;
    Eigen::Matrix<double, kUnknowns, kUnknowns> normal = Eigen::Matrix<double, kUnknowns, kUnknowns>::Zero();
    Eigen::Matrix<double, kUnknowns, 1> right = Eigen::Matrix<double, kUnknowns, 1>::Zero();
    const int threshold = otsu(even);
    for (int y = 0; y < grey.height; ++y) {
        for (int x = 0; x < grey.width; ++x) {
            const Terms t = termsAt(x, y, grey);
            const bool dark = even.at(x, y) < threshold;
            Eigen::Matrix<double, kUnknowns, 1> row;
            row << t[0], t[1], t[2], t[3], t[4], dark ? 1.0 : 0.0, dark ? 0.0 : 1.0;
            const double value = grey.at(x, y) + 1.0;
            normal += value * value * row * row.transpose();
            right += value * value * std::log(value) * row;
        }
    }
    // Adds a trace of preference for even light, because a picture of one kind leaves an unknown undetermined.
    normal.diagonal().array() += 1e-9 * normal.trace() + 1e-9;
    const Eigen::Matrix<double, kUnknowns, 1> solution = normal.ldlt().solve(right);
    Light light;
    for (int k = 0; k < kTerms; ++k) light.coefficient[std::size_t(k)] = solution[k];
    return light;
}

}  // namespace

int otsu(const Grey& grey) {
    std::array<double, 256> pixels{};
    for (const std::uint8_t v : grey.value) pixels[v] += 1;
    double all = 0, sum = 0;
    for (std::size_t v = 0; v < pixels.size(); ++v) {
        all += pixels[v];
        sum += pixels[v] * double(v);
    }
    double dark = 0, darkSum = 0, best = 0;
    int first = 0, last = 0;
    for (std::size_t v = 0; v + 1 < pixels.size(); ++v) {
        dark += pixels[v];
        darkSum += pixels[v] * double(v);
        const double light = all - dark;
        if (dark == 0 || light == 0) continue;
        const double apart = darkSum / dark - (sum - darkSum) / light;
        const double between = dark * light * apart * apart;
        if (between > best) {
            best = between;
            first = int(v) + 1;
        }
        if (between >= best && best > 0) last = int(v) + 1;
    }
    return (first + last) / 2;
}

Grey evenLight(const Grey& grey) {
    const Grey few = thinned(grey);
    Light light;
    for (int pass = 0; pass < kPasses; ++pass) light = fitted(few, stretched(few, light, rangeOf(few, light)));
    return stretched(grey, light, rangeOf(few, light));
}

}  // namespace vkdose::photo
