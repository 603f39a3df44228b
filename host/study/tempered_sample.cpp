#include "host/study/tempered_sample.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <utility>

#include "host/core/error.h"
#include "host/core/random.h"
#include "host/core/vec.h"
#include "host/study/normal_distribution.h"

namespace vkdose {

namespace {

using CubePoint = std::vector<double>;
using LogDensity = std::function<double(const CubePoint&)>;

constexpr double kEffectivePart = 0.5;     // of a population, after a step of the exponent
constexpr int kMoves = 10;                 // of each point after a step
constexpr int kLastMoves = 40;             // after the last one, to part those that were drawn from the same point
constexpr double kWantedAcceptance = 0.3;  // between the best of one dimension, 0.44, and that of many, 0.23

/// One population.
class Population {
  public:
    Population(const LogDensity& logDensity, std::size_t dimensions, std::size_t count, std::uint64_t seed)
        : logDensity_(logDensity), d_(dimensions), seed_(seed), scale_(2.38 / std::sqrt(double(dimensions))) {
        CubePoint shift(d_);
        for (double& x : shift) x = uniform();
        for (std::size_t i = 0; i < count; ++i) {
            CubePoint& p = points_.emplace_back(haltonPoint(int(i) + 1, d_));
            for (std::size_t k = 0; k < d_; ++k) p[k] = std::fmod(p[k] + shift[k], 1.0);
            logs_.push_back(logAt(p));
        }
    }

    void run() {
        while (exponent_ < 1) {
            const double step = nextStep();
            exponent_ = step < 1 - exponent_ ? exponent_ + step : 1;
            ++steps_;
            const std::vector<double> weights = weightsOf(step);
            const Eigen::MatrixXd shape = shapeOf(weights);
            drawAnew(weights);
            for (int i = 0; i < (exponent_ < 1 ? kMoves : kLastMoves); ++i) move(shape);
        }
    }

    const std::vector<CubePoint>& points() const { return points_; }
    int steps() const { return steps_; }
    double acceptance() const { return acceptance_; }

  private:
    /// The exponent would never come to 1 with a density that is no number.
    double logAt(const CubePoint& p) const {
        const double log = logDensity_(p);
        if (!std::isfinite(log)) throw RunError("the density of the parameters that fit is not finite");
        return log;
    }

    double uniform() {
        if (next_ % 2 == 0) pair_ = uniforms(seed_, Stream::Jitter, next_ / 2);
        return pair_[next_++ % 2];
    }

    /// Of the normal distribution (Box and Muller 1958).
    double normal() {
        const double r = std::sqrt(-2 * std::log(uniform()));
        return r * std::cos(2 * kPi * uniform());
    }

    /// Of density^step, with a sum of 1.
    std::vector<double> weightsOf(double step) const {
        const double most = *std::max_element(logs_.begin(), logs_.end());
        std::vector<double> weights;
        double sum = 0;
        for (const double log : logs_) sum += weights.emplace_back(std::exp(step * (log - most)));
        for (double& w : weights) w /= sum;
        return weights;
    }

    /// The longest step that leaves the wanted part of the points effective (Kish 1965), at most to 1.
    double nextStep() const {
        const auto effectivePart = [&](double step) {
            double squares = 0;
            for (const double w : weightsOf(step)) squares += w * w;
            return 1 / (squares * double(points_.size()));
        };
        const double rest = 1 - exponent_;
        if (effectivePart(rest) >= kEffectivePart) return rest;
        // By halving the logarithm, for the density may vary by thousands of orders.
        double low = std::log(1e-300), high = std::log(rest);
        for (int i = 0; i < 60; ++i) {
            const double middle = (low + high) / 2;
            (effectivePart(std::exp(middle)) >= kEffectivePart ? low : high) = middle;
        }
        return std::exp(low);
    }

    /// A root of the covariance of the weighted points. By eigenvalues, because a ridge may have no width in numbers.
    Eigen::MatrixXd shapeOf(const std::vector<double>& weights) const {
        const auto d = Eigen::Index(d_);
        const auto vectorOf = [&](const CubePoint& p) { return Eigen::Map<const Eigen::VectorXd>(p.data(), d); };
        Eigen::VectorXd mean = Eigen::VectorXd::Zero(d);
        for (std::size_t i = 0; i < points_.size(); ++i) mean += weights[i] * vectorOf(points_[i]);
        Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(d, d);
        for (std::size_t i = 0; i < points_.size(); ++i) {
            const Eigen::VectorXd off = vectorOf(points_[i]) - mean;
            covariance += weights[i] * off * off.transpose();
        }
        const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> parts(covariance);
        return parts.eigenvectors() * parts.eigenvalues().cwiseMax(0).cwiseSqrt().asDiagonal();
    }

    /// Systematic resampling: each point as often as its weight says, to less than one time.
    void drawAnew(const std::vector<double>& weights) {
        std::vector<CubePoint> points;
        std::vector<double> logs;
        const double n = double(points_.size()), start = uniform();
        double below = 0;
        for (std::size_t i = 0; i < points_.size(); ++i) {
            below += weights[i];
            const bool last = i + 1 == points_.size();  // rounding leaves it no place otherwise
            while (points.size() < points_.size() && (last || (double(points.size()) + start) / n < below)) {
                points.push_back(points_[i]);
                logs.push_back(logs_[i]);
            }
        }
        points_ = std::move(points);
        logs_ = std::move(logs);
    }

    /// A Metropolis move of each point. The length of the moves follows how many are accepted.
    void move(const Eigen::MatrixXd& shape) {
        std::size_t accepted = 0;
        Eigen::VectorXd z{Eigen::Index(d_)};
        for (std::size_t i = 0; i < points_.size(); ++i) {
            for (double& x : z) x = normal();
            const Eigen::VectorXd by = scale_ * (shape * z);
            const double chance = uniform();
            CubePoint to = points_[i];
            for (std::size_t k = 0; k < d_; ++k) to[k] += by[Eigen::Index(k)];
            if (!std::all_of(to.begin(), to.end(), [](double x) { return x >= 0 && x <= 1; })) continue;
            const double log = logAt(to);
            if (!(std::log(chance) < exponent_ * (log - logs_[i]))) continue;
            points_[i] = std::move(to);
            logs_[i] = log;
            ++accepted;
        }
        acceptance_ = double(accepted) / double(points_.size());
        scale_ = std::clamp(scale_ * std::exp(acceptance_ - kWantedAcceptance), 1e-4, 10.0);
    }

    const LogDensity& logDensity_;
    std::size_t d_;
    std::uint64_t seed_, next_ = 0;
    std::array<double, 2> pair_{};
    double scale_;  ///< of the moves, in deviations of the population
    double exponent_ = 0, acceptance_ = 0;
    int steps_ = 0;
    std::vector<CubePoint> points_;
    std::vector<double> logs_;  ///< of the density at each
};

/// Mean and variance of a coordinate of n points from the `first` on.
std::pair<double, double> momentsOf(const TemperedSample& sample, std::size_t first, std::size_t n, std::size_t k) {
    double mean = 0, squares = 0;
    for (std::size_t i = first; i < first + n; ++i) mean += sample.points[i][k] / double(n);
    for (std::size_t i = first; i < first + n; ++i) squares += std::pow(sample.points[i][k] - mean, 2);
    return {mean, squares / double(n - 1)};
}

/// Compares the populations with each other.
void judge(TemperedSample& sample, std::size_t dimensions, const SampleSize& size) {
    const double n = double(size.each), m = double(size.populations);
    for (std::size_t k = 0; k < dimensions; ++k) {
        double within = 0, mean = 0, between = 0;
        std::vector<double> means;
        for (std::size_t p = 0; p < size.populations; ++p) {
            const auto [own, variance] = momentsOf(sample, p * size.each, size.each, k);
            means.push_back(own);
            mean += own / m;
            within += variance / m;
        }
        for (const double own : means) between += std::pow(own - mean, 2) / (m - 1);
        sample.rHat.push_back(within > 0 ? std::sqrt((n - 1) / n + between / within) : 1);
        sample.effective.push_back(between > 0 ? std::min(m * n, m * within / between) : m * n);
    }
}

}  // namespace

TemperedSample temperedSample(const LogDensity& logDensity, std::size_t dimensions, const SampleSize& size) {
    assert(size.populations > 1 && size.each > 1 && dimensions > 0);
    TemperedSample sample;
    for (std::size_t p = 0; p < size.populations; ++p) {
        Population population(logDensity, dimensions, size.each, p + 1);
        population.run();
        sample.points.insert(sample.points.end(), population.points().begin(), population.points().end());
        sample.steps = std::max(sample.steps, population.steps());
        sample.acceptance += population.acceptance() / double(size.populations);
    }
    judge(sample, dimensions, size);
    return sample;
}

}  // namespace vkdose
