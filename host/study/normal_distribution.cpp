#include "host/study/normal_distribution.h"

#include <array>
#include <cmath>

#include "host/core/vec.h"
#include "host/study/calibration_aim.h"

namespace vkdose {

namespace {

constexpr int kDraws = 256;

/// The value below which a normal distribution has this part, by halving.
double normalQuantile(double part) {
    double low = -8, high = 8;
    for (int i = 0; i < 60; ++i) (normalBelow((low + high) / 2) < part ? low : high) = (low + high) / 2;
    return (low + high) / 2;
}

}  // namespace

double normalDensity(double x) {
    return std::exp(-x * x / 2) / std::sqrt(2 * kPi);
}

double normalBelow(double x) {
    return std::erfc(-x / std::sqrt(2.0)) / 2;
}

std::vector<double> haltonPoint(int index, std::size_t dimensions) {
    constexpr std::array<int, kMostTargets> kPrimes{2, 3, 5, 7, 11, 13, 17, 19};
    std::vector<double> point;
    for (std::size_t d = 0; d < dimensions; ++d) {
        double value = 0, scale = 1;
        for (int i = index; i > 0; i /= kPrimes.at(d)) {
            scale /= kPrimes.at(d);
            value += scale * (i % kPrimes.at(d));
        }
        point.push_back(value);
    }
    return point;
}

const std::vector<std::vector<double>>& normalDraws() {
    static const std::vector<std::vector<double>> kPoints = [] {
        std::vector<std::vector<double>> points;
        for (int i = 1; i <= kDraws; ++i) {
            points.push_back(haltonPoint(i, kMostTargets));
            for (double& u : points.back()) u = normalQuantile(u);
        }
        return points;
    }();
    return kPoints;
}

}  // namespace vkdose
