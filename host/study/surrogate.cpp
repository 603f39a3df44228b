#include "host/study/surrogate.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "host/analysis/beta.h"
#include "host/core/error.h"
#include "host/core/vec.h"
#include "host/study/seed_scatter.h"

namespace vkdose {

namespace {

constexpr int kCandidates = 4096;     // points of the range that are looked at for the next run
constexpr double kTooNear = 1e-3;     // of the range: a run so near to a former one tells nothing new
constexpr double kNothingNew = 1e-3;  // of the tolerance: an improvement not worth a run

double density(double u) {
    return std::exp(-u * u / 2) / std::sqrt(2 * kPi);
}
double cumulative(double u) {
    return std::erfc(-u / std::sqrt(2.0)) / 2;
}

/// The `index`th point of Halton's sequence in the unit cube, from 1: evenly spread however many are taken.
std::vector<double> halton(int index, std::size_t dimensions) {
    constexpr std::array<int, 4> kPrimes{2, 3, 5, 7};
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

double distance(const std::vector<double>& a, const std::vector<double>& b) {
    double most = 0;
    for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, std::abs(a[i] - b[i]));
    return most;
}

class Search {
  public:
    Search(const CalibrationAim& aim, const TryPoints& tryPoints) : aim_(aim), tryPoints_(tryPoints) {}

    std::optional<SearchResult> run() {
        const std::size_t d = aim_.parameters.size();
        std::vector<std::vector<double>> first;
        for (int i = 1; i <= std::min(aim_.maxRuns, 2 * int(d) + 1); ++i) first.push_back(halton(i, d));
        if (!tryOut(first)) return std::nullopt;
        for (;;) {
            const GaussianProcess process = fitted();
            judge(process);
            if (result_.met || int(unit_.size()) >= aim_.maxRuns) return finished(process);
            const auto next = mostPromising(process);
            if (!next) return finished(process);
            if (!tryOut({*next})) return std::nullopt;
        }
    }

  private:
    /// In the unit of the key, as it will be written: six digits.
    Parameters inUnits(const std::vector<double>& u) const {
        Parameters p;
        for (std::size_t i = 0; i < u.size(); ++i) {
            const FreeParameter& free = aim_.parameters[i];
            p.push_back(std::stod(fmt::format("{:.6g}", free.low + u[i] * (free.high - free.low))));
        }
        return p;
    }

    bool tryOut(const std::vector<std::vector<double>>& points) {
        std::vector<Parameters> batch;
        for (const auto& u : points) batch.push_back(inUnits(u));
        const auto trials = tryPoints_(batch);
        if (!trials) return false;
        unit_.insert(unit_.end(), points.begin(), points.end());
        result_.points.insert(result_.points.end(), batch.begin(), batch.end());
        trials_.insert(trials_.end(), trials->begin(), trials->end());
        weigh();
        return true;
    }

    /// Means and errors of all trials. They are made anew after each trial, because it tells more about the scatter of
    /// all.
    void weigh() {
        std::vector<std::vector<double>> seeds;
        for (const Trial& trial : trials_) seeds.push_back(trial.values);
        const double scatter = scatterOfSeeds(seeds);
        result_.values.clear();
        for (const Trial& trial : trials_) {
            const Estimate mean = estimateOf(trial.values);
            const double pooled = scatter / std::sqrt(double(mean.count));
            result_.values.push_back({mean.mean, std::isfinite(pooled) ? pooled : trial.error});
        }
    }

    GaussianProcess fitted() const {
        std::vector<std::vector<double>> points;
        std::vector<Measured> values;
        for (std::size_t i = 0; i < unit_.size(); ++i) {
            if (!std::isfinite(result_.values[i].value)) continue;
            points.push_back(unit_[i]);
            // The process takes a value of unknown error as it is.
            const double error = result_.values[i].error;
            values.push_back({result_.values[i].value, std::isfinite(error) ? error : 0});
        }
        if (points.size() < 2)
            throw RunError(
                fmt::format("{} of the first {} points have a mass per dose: nothing to search from; choose "
                            "other bounds",
                            points.size(), unit_.size()));
        return {points, values};
    }

    /// The tried point that is believed nearest to the target. A single observation may be near it by chance, but the
    /// process takes its neighbours into account.
    void judge(const GaussianProcess& process) {
        nearest_ = std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < unit_.size(); ++i) {
            if (!std::isfinite(result_.values[i].value)) continue;
            const Belief belief = process.at(unit_[i]);
            const double off = std::abs(belief.mean - aim_.target);
            if (off >= nearest_) continue;
            nearest_ = off;
            result_.best = i;
            result_.mean = belief.mean;
            result_.deviation = belief.deviation;
        }
        result_.met = nearest_ <= aim_.tolerance && result_.deviation <= aim_.tolerance;
    }

    double gain(const GaussianProcess& process, const std::vector<double>& u) const {
        for (const auto& former : unit_)
            if (distance(u, former) < kTooNear) return 0;
        const Belief belief = process.at(u);
        return expectedImprovement(belief.mean - aim_.target, belief.deviation, nearest_);
    }

    std::optional<std::vector<double>> mostPromising(const GaussianProcess& process) const {
        std::vector<double> best;
        double most = 0;
        for (int i = 1; i <= kCandidates; ++i) {
            const std::vector<double> u = halton(i, aim_.parameters.size());
            const double here = gain(process, u);
            if (here <= most) continue;
            most = here;
            best = u;
        }
        // The candidates are a few thousandths apart. Halved steps find the best point between them.
        for (double step = 0.02; !best.empty() && step > 1e-4; step /= 2) {
            for (std::size_t i = 0; i < best.size(); ++i) {
                for (const double sign : {-1.0, 1.0}) {
                    std::vector<double> trial = best;
                    trial[i] = std::clamp(trial[i] + sign * step, 0.0, 1.0);
                    const double there = gain(process, trial);
                    if (there <= most) continue;
                    most = there;
                    best = trial;
                }
            }
        }
        if (most < kNothingNew * aim_.tolerance) return std::nullopt;
        return best;
    }

    SearchResult finished(const GaussianProcess& process) {
        const std::size_t d = aim_.parameters.size();
        const double inf = std::numeric_limits<double>::infinity();
        result_.compatible.assign(d, {inf, -inf});
        const auto widen = [&](const std::vector<double>& u) {
            const Belief belief = process.at(u);
            if (std::abs(belief.mean - aim_.target) > 2 * belief.deviation + aim_.tolerance) return;
            const Parameters p = inUnits(u);
            for (std::size_t i = 0; i < d; ++i) {
                result_.compatible[i].first = std::min(result_.compatible[i].first, p[i]);
                result_.compatible[i].second = std::max(result_.compatible[i].second, p[i]);
            }
        };
        for (int i = 1; i <= kCandidates; ++i) widen(halton(i, d));
        for (const auto& u : unit_) widen(u);
        return result_;
    }

    const CalibrationAim& aim_;
    const TryPoints& tryPoints_;
    std::vector<Trial> trials_;
    std::vector<std::vector<double>> unit_;  ///< the points tried, in the unit cube
    double nearest_ = 0;                     ///< least believed distance to the target [kg]
    SearchResult result_;
};

}  // namespace

double expectedImprovement(double mean, double deviation, double best) {
    if (!(deviation > 0)) return std::max(0.0, best - std::abs(mean));
    // The values above and below the target are integrated apart: the integral of (best - y) p(y) from 0 to best, and
    // the same mirrored.
    const auto half = [&](double m) {
        const double zero = -m / deviation, end = (best - m) / deviation;
        return (best - m) * (cumulative(end) - cumulative(zero)) + deviation * (density(end) - density(zero));
    };
    return std::max(0.0, half(mean) + half(-mean));
}

std::optional<SearchResult> search(const CalibrationAim& aim, const TryPoints& tryPoints) {
    return Search(aim, tryPoints).run();
}

}  // namespace vkdose
