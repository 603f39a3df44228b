#include "host/study/seed_scatter.h"

#include <cmath>
#include <unsupported/Eigen/SpecialFunctions>

#include "host/analysis/beta.h"

namespace vkdose {

namespace {

/// Chance that a value of Student's distribution is off by no more than `t`.
double chanceWithin(double t, int freedom) {
    Eigen::Array<double, 1, 1> a(freedom / 2.0), b(0.5), x(freedom / (freedom + t * t));
    return 1 - Eigen::betainc(a, b, x)[0];
}

/// By which factor two standard errors must grow, to hold the truth as often as those of a known deviation do.
double widening(int freedom) {
    constexpr double kErrors = 2;
    return studentFactor(std::erf(kErrors / std::sqrt(2.0)), freedom) / kErrors;
}

}  // namespace

double studentFactor(double chance, int freedom) {
    double low = 0, high = 1;
    while (chanceWithin(high, freedom) < chance) high *= 2;
    while (high - low > 1e-12 * high) {
        const double middle = (low + high) / 2;
        (chanceWithin(middle, freedom) < chance ? low : high) = middle;
    }
    return high;
}

double SeedScatter::errorOfMean(int count) const {
    return freedom > 0 ? widening(freedom) * deviation / std::sqrt(double(count)) : deviation;
}

SeedScatter scatterOfSeeds(const std::vector<std::vector<double>>& points) {
    double squares = 0;
    int freedom = 0;
    for (const std::vector<double>& values : points) {
        const Estimate mean = estimateOf(values);
        for (const double x : values)
            if (std::isfinite(x)) squares += (x - mean.mean) * (x - mean.mean);
        freedom += mean.count > 1 ? mean.count - 1 : 0;
    }
    if (freedom == 0) return {};
    return {std::sqrt(squares / freedom), freedom};
}

}  // namespace vkdose
