#include "host/study/gaussian_process.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace vkdose {

namespace {

// The logarithms that are fitted: a length for each coordinate, then the shared noise and the process's variance in
// units of the observations' own. The prior of each is normal about a value, and bounded: a length of half the range, a
// variance like that of the observations, little noise. Without a prior, the process would sometimes take a few
// observations for a constant and claim to know it better than any of them.
struct Prior {
    double mean, deviation, low, high;
};
constexpr Prior kLength{-0.7, 1, -3, 3}, kNoise{-8, 4, -16, 2}, kVariance{0, 1, -6, 6};

const Prior& priorOf(std::size_t i, std::size_t dimensions) {
    return i < dimensions ? kLength : i == dimensions ? kNoise : kVariance;
}

double matern(const std::vector<double>& a, const std::vector<double>& b, const std::vector<double>& lengths) {
    double square = 0;
    for (std::size_t i = 0; i < a.size(); ++i) square += std::pow((a[i] - b[i]) / lengths[i], 2);
    const double r = std::sqrt(5 * square);
    return (1 + r + r * r / 3) * std::exp(-r);
}

}  // namespace

GaussianProcess::GaussianProcess(std::vector<std::vector<double>> points, const std::vector<Measured>& observations)
    : points_(std::move(points)) {
    take(observations);
    kernel_.mean = values_.mean();
    values_.array() -= kernel_.mean;
    const double spread = std::sqrt(values_.squaredNorm() / double(values_.size()));
    if (spread > 0) kernel_.scale = spread;
    take(observations);
    kernel_ = kernelOf(fitted());
    root_.compute(covariance(kernel_));
    weights_ = root_.solve(values_);
}

GaussianProcess::GaussianProcess(std::vector<std::vector<double>> points, const std::vector<Measured>& observations,
                                 ProcessKernel kernel)
    : points_(std::move(points)), kernel_(std::move(kernel)) {
    take(observations);
    root_.compute(covariance(kernel_));
    weights_ = root_.solve(values_);
}

void GaussianProcess::take(const std::vector<Measured>& observations) {
    values_.resize(Eigen::Index(points_.size()));
    errors_.resize(values_.size());
    for (Eigen::Index i = 0; i < values_.size(); ++i) {
        values_(i) = (observations[std::size_t(i)].value - kernel_.mean) / kernel_.scale;
        errors_(i) = observations[std::size_t(i)].error / kernel_.scale;
    }
}

ProcessKernel GaussianProcess::kernelOf(const std::vector<double>& logs) const {
    const std::size_t d = points_.front().size();
    ProcessKernel kernel{{}, std::exp(logs[d]), std::exp(logs[d + 1]), kernel_.mean, kernel_.scale};
    for (std::size_t i = 0; i < d; ++i) kernel.lengths.push_back(std::exp(logs[i]));
    return kernel;
}

Eigen::MatrixXd GaussianProcess::covariance(const ProcessKernel& kernel) const {
    const auto n = Eigen::Index(points_.size());
    Eigen::MatrixXd k(n, n);
    for (Eigen::Index i = 0; i < n; ++i) {
        for (Eigen::Index j = 0; j < i; ++j)
            k(i, j) = k(j, i) =
                kernel.variance * matern(points_[std::size_t(i)], points_[std::size_t(j)], kernel.lengths);
        k(i, i) = kernel.variance + kernel.noise + errors_(i) * errors_(i);
    }
    return k;
}

double GaussianProcess::logPosterior(const std::vector<double>& logs) const {
    const Eigen::LLT<Eigen::MatrixXd> root(covariance(kernelOf(logs)));
    if (root.info() != Eigen::Success) return -std::numeric_limits<double>::infinity();
    const Eigen::MatrixXd lower = root.matrixL();
    double sum = -values_.dot(root.solve(values_)) / 2 - lower.diagonal().array().log().sum();
    for (std::size_t i = 0; i < logs.size(); ++i) {
        const Prior& prior = priorOf(i, points_.front().size());
        sum -= std::pow((logs[i] - prior.mean) / prior.deviation, 2) / 2;
    }
    return sum;
}

/// Climbs to a maximum: steps along each coordinate in turn, and halves the step when none goes up.
std::vector<double> GaussianProcess::climbed(std::vector<double> logs) const {
    double here = logPosterior(logs);
    for (double step = 1.0; step > 0.05;) {
        bool better = false;
        for (std::size_t i = 0; i < logs.size(); ++i) {
            const Prior& bounds = priorOf(i, points_.front().size());
            for (const double sign : {-1.0, 1.0}) {
                std::vector<double> trial = logs;
                trial[i] = std::clamp(trial[i] + sign * step, bounds.low, bounds.high);
                const double there = logPosterior(trial);
                if (there <= here) continue;
                here = there;
                logs = trial;
                better = true;
            }
        }
        if (!better) step /= 2;
    }
    return logs;
}

/// The best of several climbs. Each climb costs a few hundred small matrices.
std::vector<double> GaussianProcess::fitted() const {
    std::vector<double> best;
    double highest = -std::numeric_limits<double>::infinity();
    for (const double length : {-2.0, -1.0, 0.0, 1.0}) {
        for (const double noise : {-14.0, -6.0, -2.0}) {
            std::vector<double> logs(points_.front().size(), length);
            logs.push_back(noise);
            logs.push_back(0);
            logs = climbed(std::move(logs));
            const double here = logPosterior(logs);
            if (here <= highest && !best.empty()) continue;
            highest = here;
            best = logs;
        }
    }
    return best;
}

Belief GaussianProcess::at(const std::vector<double>& point) const {
    Eigen::VectorXd k(Eigen::Index(points_.size()));
    for (Eigen::Index i = 0; i < k.size(); ++i)
        k(i) = kernel_.variance * matern(point, points_[std::size_t(i)], kernel_.lengths);
    const double left = kernel_.variance - k.dot(root_.solve(k));
    return {kernel_.mean + kernel_.scale * k.dot(weights_), kernel_.scale * std::sqrt(std::max(0.0, left))};
}

double GaussianProcess::slope(std::vector<double> point, std::size_t k) const {
    constexpr double kStep = 0.05;  // to each side
    std::vector<double> high = point;
    point[k] = std::max(0.0, point[k] - kStep);
    high[k] = std::min(1.0, high[k] + kStep);
    return (at(high).mean - at(point).mean) / (high[k] - point[k]);
}

std::vector<LeftOut> GaussianProcess::leftOut() const {
    const Eigen::MatrixXd inverse = root_.solve(Eigen::MatrixXd::Identity(values_.size(), values_.size()));
    std::vector<LeftOut> all;
    for (Eigen::Index i = 0; i < values_.size(); ++i) {
        const double mean = values_(i) - weights_(i) / inverse(i, i), deviation = std::sqrt(1 / inverse(i, i));
        all.push_back({kernel_.mean + kernel_.scale * values_(i),
                       {kernel_.mean + kernel_.scale * mean, kernel_.scale * deviation}});
    }
    return all;
}

}  // namespace vkdose
