#include "host/study/posterior.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "host/core/random.h"

namespace vkdose {

namespace {

/// The logarithm of the likelihood at a point, but for a constant.
double logLikelihood(const std::vector<Goal>& goals, const Processes& processes, const UnitPoint& u) {
    double sum = 0;
    for (std::size_t g = 0; g < goals.size(); ++g) {
        const Belief belief = processes[g].at(u);
        const double off = (belief.mean - goals[g].target) / goals[g].tolerance;
        const double variance = 1 + std::pow(belief.deviation / goals[g].tolerance, 2);  // in tolerances
        sum -= (off * off / variance + std::log(variance)) / 2;
    }
    return sum;
}

std::vector<double> coordinate(const std::vector<UnitPoint>& points, std::size_t k) {
    std::vector<double> values;
    for (const UnitPoint& p : points) values.push_back(p[k]);
    return values;
}

double covariance(const std::vector<double>& a, const std::vector<double>& b) {
    const double n = double(a.size());
    const double meanA = std::accumulate(a.begin(), a.end(), 0.0) / n;
    const double meanB = std::accumulate(b.begin(), b.end(), 0.0) / n;
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - meanA) * (b[i] - meanB);
    return sum / n;
}

std::vector<std::vector<double>> correlationOf(const std::vector<UnitPoint>& points) {
    const std::size_t d = points.front().size();
    std::vector<std::vector<double>> all(d, std::vector<double>(d, 1));
    for (std::size_t i = 0; i < d; ++i)
        for (std::size_t j = 0; j < i; ++j) {
            const std::vector<double> a = coordinate(points, i), b = coordinate(points, j);
            const double scale = std::sqrt(covariance(a, a) * covariance(b, b));
            all[i][j] = all[j][i] = scale > 0 ? covariance(a, b) / scale : 0;
        }
    return all;
}

/// So many of the points, each at most once, in an order of chance: any number of the first ones is a sample too.
std::vector<UnitPoint> someOf(const std::vector<UnitPoint>& points, std::size_t count) {
    std::vector<std::pair<double, std::size_t>> order;
    for (std::size_t i = 0; i < points.size(); ++i) order.emplace_back(uniforms(1, Stream::Shuffle, i)[0], i);
    std::sort(order.begin(), order.end());
    std::vector<UnitPoint> some;
    for (std::size_t i = 0; i < std::min(count, order.size()); ++i) some.push_back(points[order[i].second]);
    return some;
}

}  // namespace

Belief figureOver(const std::vector<UnitPoint>& points, const GaussianProcess& process) {
    std::vector<double> means;
    double own = 0;
    for (const UnitPoint& p : points) {
        const Belief belief = process.at(p);
        means.push_back(belief.mean);
        own += belief.deviation * belief.deviation / double(points.size());
    }
    const double mean = std::accumulate(means.begin(), means.end(), 0.0) / double(means.size());
    return {mean, std::sqrt(covariance(means, means) + own)};
}

Interval intervalOf(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    const auto quantile = [&](double part) {
        const double at = part * double(values.size() - 1);
        const std::size_t below = std::size_t(at), above = std::min(below + 1, values.size() - 1);
        return values[below] + (at - double(below)) * (values[above] - values[below]);
    };
    return {quantile(0.5), quantile(0.025), quantile(0.975)};
}

Posterior posteriorOf(const CalibrationAim& aim, const std::vector<Goal>& goals, const Processes& processes,
                      std::size_t draws, const SampleSize& size) {
    const auto density = [&](const UnitPoint& u) { return logLikelihood(goals, processes, u); };
    const TemperedSample sample = temperedSample(density, aim.parameters.size(), size);
    Posterior p;
    p.sampled = sample.points.size();
    p.steps = sample.steps;
    p.acceptance = sample.acceptance;
    p.rHat = *std::max_element(sample.rHat.begin(), sample.rHat.end());
    p.effective = *std::min_element(sample.effective.begin(), sample.effective.end());
    for (std::size_t k = 0; k < aim.parameters.size(); ++k) {
        const FreeParameter& free = aim.parameters[k];
        const auto inUnit = [&](double u) { return free.low + u * (free.high - free.low); };
        const Interval of = intervalOf(coordinate(sample.points, k));
        p.parameters.push_back({inUnit(of.median), inUnit(of.low), inUnit(of.high)});
    }
    p.correlation = correlationOf(sample.points);
    for (const GaussianProcess& process : processes) p.figures.push_back(figureOver(sample.points, process));
    for (const UnitPoint& u : someOf(sample.points, draws)) p.draws.push_back(SampledPoints::inUnits(aim, u));
    return p;
}

}  // namespace vkdose
