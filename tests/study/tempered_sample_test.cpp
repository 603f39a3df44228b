// The sampler, on densities whose moments are known.
#include "host/study/tempered_sample.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "host/core/error.h"
#include "tests/support/catch.h"

using namespace vkdose;

namespace {

using CubePoint = std::vector<double>;

Eigen::VectorXd meanOf(const TemperedSample& sample) {
    Eigen::VectorXd mean = Eigen::VectorXd::Zero(Eigen::Index(sample.points[0].size()));
    for (const CubePoint& p : sample.points) mean += Eigen::Map<const Eigen::VectorXd>(p.data(), mean.size());
    return mean / double(sample.points.size());
}

Eigen::MatrixXd covarianceOf(const TemperedSample& sample) {
    const Eigen::VectorXd mean = meanOf(sample);
    Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(mean.size(), mean.size());
    for (const CubePoint& p : sample.points) {
        const Eigen::VectorXd off = Eigen::Map<const Eigen::VectorXd>(p.data(), mean.size()) - mean;
        sum += off * off.transpose();
    }
    return sum / double(sample.points.size());
}

/// Part of the points whose coordinate is below.
double partBelow(const TemperedSample& sample, std::size_t k, double x) {
    return double(std::count_if(sample.points.begin(), sample.points.end(),
                                [&](const CubePoint& p) { return p[k] < x; })) /
           double(sample.points.size());
}

}  // namespace

TEST_CASE("a sample of a flat density is even, and takes one step") {
    const TemperedSample sample = temperedSample([](const CubePoint&) { return 3.0; }, 2);
    CHECK(sample.points.size() == 2048);
    CHECK(sample.steps == 1);
    for (const std::size_t k : {0U, 1U})
        // Of 2048 independent points a quarter would be known to 0.0096.
        for (const double x : {0.25, 0.5, 0.75}) CHECK(std::abs(partBelow(sample, k, x) - x) < 0.04);
}

TEST_CASE("a sample of a narrow correlated normal distribution has its mean and covariance") {
    // In four dimensions, of two deviations that differ by a factor of a hundred and lie across all axes.
    Eigen::MatrixXd turn(4, 4);
    turn << 1, 1, 1, 1, 1, -1, 1, -1, 1, 1, -1, -1, 1, -1, -1, 1;
    turn /= 2;
    const Eigen::VectorXd deviations = (Eigen::VectorXd(4) << 0.1, 0.001, 0.05, 0.01).finished();
    const Eigen::MatrixXd covariance = turn * deviations.cwiseAbs2().asDiagonal() * turn.transpose();
    const Eigen::MatrixXd precision = covariance.inverse();
    const Eigen::VectorXd mean = (Eigen::VectorXd(4) << 0.45, 0.5, 0.55, 0.5).finished();
    const TemperedSample sample = temperedSample(
        [&](const CubePoint& p) {
            const Eigen::VectorXd off = Eigen::Map<const Eigen::VectorXd>(p.data(), 4) - mean;
            return -off.dot(precision * off) / 2;
        },
        4);
    CAPTURE(sample.steps, sample.acceptance, sample.effective, sample.rHat);
    const Eigen::VectorXd off = meanOf(sample) - mean;
    for (Eigen::Index i = 0; i < 4; ++i) {
        CHECK(sample.rHat[std::size_t(i)] < 1.05);
        CHECK(sample.effective[std::size_t(i)] > 300);
        // Of 300 independent points the mean is known to 0.06 deviations.
        CHECK(std::abs(off(i)) < 0.15 * std::sqrt(covariance(i, i)));
    }
    // Each of the deviations along its own axis, which no parameter is.
    const Eigen::MatrixXd along = turn.transpose() * covarianceOf(sample) * turn;
    for (Eigen::Index i = 0; i < 4; ++i) CHECK(std::sqrt(along(i, i)) == Approx(deviations(i)).epsilon(0.15));
    CHECK(sample.acceptance > 0.15);
    CHECK(sample.acceptance < 0.5);
}

TEST_CASE("a bent ridge a thousand times as long as wide is sampled from end to end") {
    // Along y = x^2 with x between 0 and 1: the density of x is flat, for the width is the same everywhere along y.
    const TemperedSample sample =
        temperedSample([](const CubePoint& p) { return -std::pow((p[1] - p[0] * p[0]) / 0.001, 2) / 2; }, 2);
    CAPTURE(sample.steps, sample.acceptance, sample.effective, sample.rHat);
    for (const double x : {0.1, 0.25, 0.5, 0.75, 0.9}) CHECK(std::abs(partBelow(sample, 0, x) - x) < 0.07);
    double squares = 0;
    for (const CubePoint& p : sample.points) squares += std::pow(p[1] - p[0] * p[0], 2);
    CHECK(std::sqrt(squares / double(sample.points.size())) == Approx(0.001).epsilon(0.1));
}

TEST_CASE("two separate peaks keep their shares") {
    const auto peak = [](double x, double at, double width) {
        return std::exp(-std::pow((x - at) / width, 2) / 2) / width;
    };
    const TemperedSample sample = temperedSample(
        [&](const CubePoint& p) { return std::log(1 * peak(p[0], 0.2, 0.005) + 3 * peak(p[0], 0.8, 0.02) + 1e-300); },
        1);
    CAPTURE(sample.rHat);
    CHECK(std::abs(partBelow(sample, 0, 0.5) - 0.25) < 0.05);
    CHECK(std::abs(partBelow(sample, 0, 0.2) - 0.125) < 0.04);
    CHECK(std::abs(partBelow(sample, 0, 0.8) - 0.625) < 0.05);
}

TEST_CASE("a density that ends at a bound keeps its half") {
    const TemperedSample sample = temperedSample([](const CubePoint& p) { return -std::pow(p[0] / 0.1, 2) / 2; }, 1);
    // Of a half normal distribution 0.683 is within a deviation.
    CHECK(std::abs(partBelow(sample, 0, 0.1) - 0.683) < 0.04);
    for (const CubePoint& p : sample.points) CHECK(p[0] >= 0);
}

TEST_CASE("populations that do not agree are told so") {
    // Three hundred thousand peaks that no population of four points finds alike.
    const TemperedSample sample =
        temperedSample([](const CubePoint& p) { return -1e5 * std::pow(std::sin(3e5 * p[0]), 2); }, 1, {8, 4});
    CHECK(sample.rHat[0] > 1.1);
    CHECK(sample.effective[0] < 32);
}

TEST_CASE("a sample repeats itself to the bit, and a density that is no number is refused") {
    const auto density = [](const CubePoint& p) { return -40 * std::pow(p[0] + p[1] - 1, 2); };
    CHECK(temperedSample(density, 2, {2, 50}).points == temperedSample(density, 2, {2, 50}).points);
    CHECK_THROWS_AS(temperedSample([](const CubePoint&) { return std::numeric_limits<double>::quiet_NaN(); }, 2),
                    RunError);
}
