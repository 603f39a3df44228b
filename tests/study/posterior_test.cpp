// The parameters that fit, on models whose posterior is known.
#include "host/study/posterior.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <vector>

#include "host/core/random.h"
#include "host/core/vec.h"
#include "host/study/normal_distribution.h"
#include "tests/support/catch.h"

using namespace vkdose;

namespace {

using Model = std::function<double(const UnitPoint&)>;

CalibrationAim aimOf(std::vector<FreeParameter> parameters) {
    CalibrationAim aim;
    aim.method = CalibrationAim::Method::Surrogate;
    aim.parameters = std::move(parameters);
    return aim;
}

const CalibrationAim kUnitSquare = aimOf({{"contact.friction", 0, 1}, {"contact.rolling_friction", 0, 1}});

/// A process through what the model gives at points spread over the cube.
GaussianProcess through(const Model& model, std::size_t dimensions, int points, double error = 0) {
    std::vector<UnitPoint> at;
    std::vector<Measured> values;
    for (int i = 1; i <= points; ++i) {
        at.push_back(haltonPoint(i, dimensions));
        values.push_back({model(at.back()), error});
    }
    return {at, values};
}

/// Of the standard normal distribution.
double standardNormal(std::uint64_t index) {
    const auto [u, v] = uniforms(21, Stream::Jitter, index);
    return std::sqrt(-2 * std::log(u)) * std::cos(2 * kPi * v);
}

}  // namespace

TEST_CASE("the posterior of a linear model is the normal distribution of its closed form") {
    // The sum of two parameters is known to 0.05, their difference to 0.2. The truth is in the middle, five deviations
    // from all bounds. The posterior's covariance is A^-1 diag(u^2) A^-T.
    const CalibrationAim aim = aimOf({{"contact.friction", 0, 1}, {"contact.rolling_friction", 2, 4}});
    const Processes processes{through([](const UnitPoint& u) { return u[0] + u[1]; }, 2, 25),
                              through([](const UnitPoint& u) { return u[0] - u[1]; }, 2, 25)};
    const Posterior p = posteriorOf(aim, {{1.04, 0.05}, {-0.02, 0.2}}, processes, 2048);
    CAPTURE(p.effective, p.rHat, p.acceptance, p.steps);
    CHECK(p.sampled == 2048);
    CHECK(p.effective > 500);
    CHECK(p.rHat < 1.02);
    const double variance = (0.05 * 0.05 + 0.2 * 0.2) / 4, both = (0.05 * 0.05 - 0.2 * 0.2) / 4;
    const double deviation = std::sqrt(variance);
    // Of 500 independent draws the mean is known to 0.045 deviations, an end of the interval to 0.12.
    CHECK(std::abs(p.parameters[0].median - 0.51) < 0.15 * deviation);
    CHECK(std::abs(p.parameters[0].low - (0.51 - 1.96 * deviation)) < 0.3 * deviation);
    CHECK(std::abs(p.parameters[0].high - (0.51 + 1.96 * deviation)) < 0.3 * deviation);
    // The range of the other one is twice as wide, and begins at 2.
    CHECK(std::abs(p.parameters[1].median - (2 + 2 * 0.53)) < 0.15 * 2 * deviation);
    CHECK(std::abs(p.parameters[1].high - (2 + 2 * (0.53 + 1.96 * deviation))) < 0.3 * 2 * deviation);
    // A correlation of -0.88 is known to (1 - 0.88^2) / sqrt(500), 0.01.
    CHECK(std::abs(p.correlation[0][1] - both / variance) < 0.03);
    CHECK(p.correlation[1][0] == p.correlation[0][1]);
    CHECK(p.correlation[0][0] == 1);
    // Each figure is known as its target is: the model can meet both.
    CHECK(std::abs(p.figures[0].mean - 1.04) < 0.01);
    CHECK(p.figures[0].deviation == Approx(0.05).epsilon(0.1));
    CHECK(p.figures[1].deviation == Approx(0.2).epsilon(0.1));
    double squares = 0;
    REQUIRE(p.draws.size() == 2048);
    for (const Parameters& draw : p.draws) squares += std::pow(draw[0] - 0.51, 2) / 2048;
    CHECK(squares == Approx(variance).epsilon(0.15));
}

TEST_CASE("one target leaves two parameters a ridge: only their combination is known") {
    const Processes sum{through([](const UnitPoint& u) { return u[0] + u[1]; }, 2, 25)};
    const Posterior p = posteriorOf(kUnitSquare, {{1, 0.03}}, sum);
    CAPTURE(p.correlation[0][1], p.effective, p.rHat);
    CHECK(p.correlation[0][1] < -0.98);
    for (const Interval& of : p.parameters) {
        CHECK(of.low < 0.08);
        CHECK(of.high > 0.92);
        CHECK(std::abs(of.median - 0.5) < 0.06);
    }
    CHECK(p.figures[0].deviation < 0.04);
}

TEST_CASE("what the surrogate does not know widens the posterior, as its formula says") {
    // Noisy points of a line over half of the range: in the other half the surrogate knows ever less.
    const GaussianProcess process({{0.0}, {0.1}, {0.2}, {0.35}, {0.5}},
                                  {{0.1, 0.1}, {0.15, 0.1}, {0.45, 0.1}, {0.7, 0.1}, {1, 0.1}});
    const double target = 0.9, uncertainty = 0.05;
    // By a sum over a fine grid.
    std::vector<double> below{0};
    double means = 0, squares = 0;
    constexpr int kPieces = 4000;
    for (int i = 0; i < kPieces; ++i) {
        const Belief b = process.at({(i + 0.5) / kPieces});
        const double variance = uncertainty * uncertainty + b.deviation * b.deviation;
        const double density = std::exp(-std::pow(b.mean - target, 2) / (2 * variance)) / std::sqrt(variance);
        below.push_back(below.back() + density);
        means += density * b.mean;
        squares += density * (b.mean * b.mean + b.deviation * b.deviation);
    }
    const auto quantile = [&](double part) {
        return double(std::lower_bound(below.begin(), below.end(), part * below.back()) - below.begin()) / kPieces;
    };
    const Posterior p = posteriorOf(aimOf({{"contact.friction", 0, 1}}), {{target, uncertainty}}, {process});
    const double width = quantile(0.975) - quantile(0.025);
    CAPTURE(width, quantile(0.5), p.effective, process.at({0.5}).deviation, process.at({1.0}).deviation);
    CHECK(process.at({1.0}).deviation > 3 * process.at({0.5}).deviation);
    // Of 500 independent draws the median is known to 0.015 of this width.
    CHECK(std::abs(p.parameters[0].median - quantile(0.5)) < 0.04 * width);
    CHECK(std::abs(p.parameters[0].low - quantile(0.025)) < 0.06 * width);
    CHECK(std::abs(p.parameters[0].high - quantile(0.975)) < 0.06 * width);
    means /= below.back();
    CHECK(p.figures[0].deviation == Approx(std::sqrt(squares / below.back() - means * means)).epsilon(0.1));
}

TEST_CASE("a target out of reach gathers the draws at the bound, and the figures say that they are off") {
    const Processes sum{through([](const UnitPoint& u) { return u[0] + u[1]; }, 2, 25)};
    const Posterior p = posteriorOf(kUnitSquare, {{5, 0.05}}, sum);
    for (const Interval& of : p.parameters) CHECK(of.low > 0.9);
    CHECK(std::abs(p.figures[0].mean - 5) > 2.5);
    CHECK(p.figures[0].deviation < 0.1);
}

TEST_CASE("draws are points of the sample within the bounds, and the first ones are as good as all") {
    const CalibrationAim aim = aimOf({{"contact.friction", 0.1, 0.7}});
    const Processes line{through([](const UnitPoint& u) { return u[0]; }, 1, 9)};
    const Posterior p = posteriorOf(aim, {{0.5, 0.4}}, line);
    REQUIRE(p.draws.size() == 200);
    double all = 0, first = 0;
    for (std::size_t i = 0; i < p.draws.size(); ++i) {
        CHECK(p.draws[i][0] >= 0.1);
        CHECK(p.draws[i][0] <= 0.7);
        all += p.draws[i][0] / 200;
        if (i < 50) first += p.draws[i][0] / 50;
    }
    // The deviation is 0.15: of 200 draws the mean is known to 0.011, of 50 to 0.02.
    CHECK(std::abs(all - p.parameters[0].median) < 0.035);
    CHECK(std::abs(first - all) < 0.06);
    CHECK(posteriorOf(aim, {{0.5, 0.4}}, line).draws == p.draws);
}

TEST_CASE("an interval is the median and the ends of 95 %") {
    std::vector<double> values(101);
    std::iota(values.begin(), values.end(), 0.0);
    std::reverse(values.begin(), values.end());
    const Interval of = intervalOf(values);
    CHECK(of.median == 50);
    CHECK(of.low == Approx(2.5));
    CHECK(of.high == Approx(97.5));
    CHECK(intervalOf({7}).low == 7);
}

TEST_CASE("the 95 % intervals hold the truth in 95 of 100 cases") {
    // A heap's angle, which both kinds of friction make, and a mass per dose, bent and with another trade-off.
    const Model angle = [](const UnitPoint& u) { return 15 + 20 * std::sqrt(0.1 + u[0]) + 10 * u[1]; };
    const Model dose = [](const UnitPoint& u) { return 8 - 4 * u[0] / (u[0] + 0.5) - 2 * u[1] * u[1]; };
    const Processes processes{through(angle, 2, 16), through(dose, 2, 16)};
    constexpr int kTruths = 200;
    int held[2] = {0, 0};
    double width = 0;
    for (int i = 0; i < kTruths; ++i) {
        const auto [a, b] = uniforms(3, Stream::Jitter, std::uint64_t(i));
        const std::vector<Goal> goals{{angle({a, b}) + 1.5 * standardNormal(2 * std::uint64_t(i)), 1.5},
                                      {dose({a, b}) + 0.3 * standardNormal(2 * std::uint64_t(i) + 1), 0.3}};
        const Posterior p = posteriorOf(kUnitSquare, goals, processes, 1, {2, 128});
        const double truth[2] = {a, b};
        for (std::size_t k : {0U, 1U}) {
            held[k] += p.parameters[k].low <= truth[k] && truth[k] <= p.parameters[k].high ? 1 : 0;
            width += (p.parameters[k].high - p.parameters[k].low) / (2 * kTruths);
        }
    }
    CAPTURE(held[0], held[1], width);
    // 190 of 200 are expected, with a deviation of 3; the ends of an interval of 256 draws scatter by a tenth of it.
    for (const int k : held) {
        CHECK(k >= 0.90 * kTruths);
        CHECK(k <= 0.99 * kTruths);
    }
    CHECK(width < 0.75);  // they say something: those of a flat distribution are 0.95 wide
}
