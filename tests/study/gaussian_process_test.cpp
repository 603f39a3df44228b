#include "host/study/gaussian_process.h"

#include <cmath>
#include <random>
#include <vector>

#include "host/core/vec.h"
#include "tests/support/catch.h"

using namespace vkdose;

TEST_CASE("a process passes through what was observed and doubts what was not") {
    std::vector<std::vector<double>> points;
    std::vector<Measured> values;
    for (const double x : {0.0, 0.2, 0.4, 0.6, 0.8, 1.0}) {
        points.push_back({x});
        values.push_back({std::sin(2 * kPi * x), 0});
    }
    const GaussianProcess process(points, values);
    // In units of the amplitude, 1. At an observation only the little noise is left that is thought possible
    // beforehand: exp(-4), about 2 % of the values' spread.
    for (std::size_t i = 0; i < points.size(); ++i) {
        CHECK(std::abs(process.at(points[i]).mean - values[i].value) < 1e-3);
        CHECK(process.at(points[i]).deviation < 0.02);
    }
    for (const double x : {0.1, 0.3, 0.5, 0.7, 0.9}) {
        const Belief belief = process.at({x});
        CAPTURE(x, belief.mean, belief.deviation);
        CHECK(belief.deviation > process.at({0.4}).deviation);
        CHECK(std::abs(belief.mean - std::sin(2 * kPi * x)) < 3 * belief.deviation);
        CHECK(std::abs(belief.mean - std::sin(2 * kPi * x)) < 0.2);
    }
    CHECK(process.at({3.0}).deviation > 0.5);
}

TEST_CASE("a process finds out how noisy its observations are") {
    std::mt19937 random(5);
    std::normal_distribution<double> noise(0, 0.3);
    std::vector<std::vector<double>> points;
    std::vector<Measured> values;
    for (int i = 0; i < 41; ++i) {
        points.push_back({i / 40.0});
        values.push_back({4 * points.back()[0] + noise(random), 0});
    }
    const GaussianProcess process(points, values);
    double off = 0, believed = 0;
    for (int i = 0; i < 41; ++i) {
        off += std::pow(process.at(points[i]).mean - 4 * points[i][0], 2) / 41;
        believed += std::pow(process.at(points[i]).deviation, 2) / 41;
    }
    // Between a line through 41 points (0.3 sqrt(2/41) = 0.07) and no smoothing at all (0.3).
    CHECK(std::sqrt(off) < 0.15);
    // Its estimate of its own error is right to a factor of two.
    CHECK(std::sqrt(believed) > 0.5 * std::sqrt(off));
    CHECK(std::sqrt(believed) < 3 * std::sqrt(off));
}

TEST_CASE("the mean of noise is known to its standard error, not better") {
    // A constant, observed sixteen times with an error of 1 each.
    std::mt19937 random(9);
    std::normal_distribution<double> noise;
    std::vector<std::vector<double>> points;
    std::vector<Measured> values;
    for (int i = 0; i < 16; ++i) {
        points.push_back({i / 15.0});
        values.push_back({noise(random), 1.0});
    }
    const GaussianProcess process(points, values);
    // 1/sqrt(16), if it takes the observations for a constant; a slope or a bend that it thinks possible adds to that.
    CHECK(process.at({0.5}).deviation > 0.24);
    CHECK(process.at({0.5}).deviation < 0.6);
}

TEST_CASE("what looks like noise is not known better than a mean of noise would be") {
    std::vector<std::vector<double>> points;
    std::vector<Measured> values;
    for (int i = 0; i < 8; ++i) {
        points.push_back({i / 7.0});
        values.push_back({i % 2 == 0 ? 1.0 : -1.0, 0});
    }
    CHECK(GaussianProcess(points, values).at({0.5}).deviation > 1 / std::sqrt(8.0));
}

TEST_CASE("a coordinate that plays no part gets a long length") {
    std::mt19937 random(2);
    std::uniform_real_distribution<double> uniform;
    std::vector<std::vector<double>> points;
    std::vector<Measured> values;
    for (int i = 0; i < 25; ++i) {
        points.push_back({uniform(random), uniform(random)});
        values.push_back({std::sin(6 * points.back()[0]), 0});
    }
    const GaussianProcess process(points, values);
    CHECK(process.lengths()[1] > 5 * process.lengths()[0]);
}
