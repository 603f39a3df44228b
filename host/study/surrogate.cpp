#include "host/study/surrogate.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "host/analysis/beta.h"
#include "host/core/error.h"
#include "host/core/number.h"
#include "host/core/vec.h"
#include "host/study/seed_scatter.h"

namespace vkdose {

namespace {

constexpr int kCandidates = 4096;     // points of the range that are looked at for the next run
constexpr double kTooNear = 1e-3;     // of the range: a run so near to a former one tells nothing new
constexpr double kNothingNew = 1e-3;  // of the tolerance: an improvement not worth a run
constexpr double kSlopeStep = 0.05;   // of the range, to each side
constexpr double kOpen = 1e-6;        // information in an open direction: an error of a thousand ranges
constexpr int kDraws = 256;           // points of the normal distribution

double density(double u) {
    return std::exp(-u * u / 2) / std::sqrt(2 * kPi);
}
double cumulative(double u) {
    return std::erfc(-u / std::sqrt(2.0)) / 2;
}

/// The `index`th point of Halton's sequence in the unit cube, from 1: evenly spread however many are taken.
std::vector<double> halton(int index, std::size_t dimensions) {
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

double distance(const std::vector<double>& a, const std::vector<double>& b) {
    double most = 0;
    for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, std::abs(a[i] - b[i]));
    return most;
}

/// In the unit of the key, as it will be written: six digits.
Parameters inUnits(const CalibrationAim& aim, const std::vector<double>& u) {
    Parameters p;
    for (std::size_t i = 0; i < u.size(); ++i) {
        const FreeParameter& free = aim.parameters[i];
        p.push_back(nearestDecimal(free.low + u[i] * (free.high - free.low), 6));
    }
    return p;
}

/// The first points in the unit cube.
std::vector<std::vector<double>> firstInUnits(const CalibrationAim& aim) {
    const std::size_t d = aim.parameters.size();
    std::vector<std::vector<double>> first;
    for (int i = 1; i <= std::min(aim.maxRuns, 2 * int(d) + 1); ++i) first.push_back(halton(i, d));
    return first;
}

class Search {
  public:
    Search(const CalibrationAim& aim, const TryPoints& tryPoints, const ConfirmPoint& confirmPoint)
        : aim_(aim), tryPoints_(tryPoints), confirmPoint_(confirmPoint), goals_(goalsOf(aim)) {
        result_.goals.resize(goals_.size());
    }

    std::optional<SearchResult> run() {
        if (!tryOut(firstInUnits(aim_))) return std::nullopt;
        for (;;) {
            const Processes processes = fitted();
            if (result_.met) return finished(processes);
            choose(processes, true);
            const int made = int(unit_.size() + result_.confirmations.size());
            // A point that is believed in at the end is confirmed beyond their number, but one alone.
            if (made <= aim_.maxRuns && believedMet(processes)) {
                if (!confirm()) return std::nullopt;
                continue;
            }
            const auto next = made >= aim_.maxRuns ? std::nullopt : mostPromising(processes);
            if (!next) {
                choose(processes, false);
                return finished(processes);
            }
            if (!tryOut({*next})) return std::nullopt;
        }
    }

  private:
    using Processes = std::vector<GaussianProcess>;  ///< one for each goal

    bool tryOut(const std::vector<std::vector<double>>& points) {
        std::vector<Parameters> batch;
        for (const auto& u : points) batch.push_back(inUnits(aim_, u));
        const auto trials = tryPoints_(batch);
        if (!trials) return false;
        unit_.insert(unit_.end(), points.begin(), points.end());
        result_.points.insert(result_.points.end(), batch.begin(), batch.end());
        trials_.insert(trials_.end(), trials->begin(), trials->end());
        weigh();
        return true;
    }

    /// Runs the best point with new seeds, and takes what they gave into its trials. Returns false if interrupted.
    bool confirm() {
        const auto trials = confirmPoint_(result_.points[result_.best]);
        if (!trials) return false;
        for (std::size_t g = 0; g < goals_.size(); ++g) {
            std::vector<double>& values = trials_[result_.best][g].values;
            values.insert(values.end(), trials->at(g).values.begin(), trials->at(g).values.end());
        }
        weigh();
        Confirmation& c = result_.confirmations.emplace_back(Confirmation{result_.best, {}});
        for (std::size_t g = 0; g < goals_.size(); ++g)
            c.figures.push_back(confirmedBy(trials->at(g).values, std::size_t(aim_.confirmingSeeds), scatter_[g],
                                            goals_[g].target, goals_[g].tolerance));
        result_.met = c.met();
        return true;
    }

    bool isConfirmed(std::size_t point) const {
        return std::any_of(result_.confirmations.begin(), result_.confirmations.end(),
                           [&](const Confirmation& c) { return c.point == point; });
    }

    /// Means and errors of all trials. They are made anew after each trial, because it tells more about the scatter of
    /// all.
    void weigh() {
        for (std::size_t g = 0; g < goals_.size(); ++g) {
            std::vector<std::vector<double>> seeds;
            for (const Trials& trials : trials_) seeds.push_back(trials.at(g).values);
            scatter_[g] = scatterOfSeeds(seeds);
            std::vector<Measured>& values = result_.goals[g].values;
            values.clear();
            for (const Trials& trials : trials_) {
                const Estimate mean = estimateOf(trials[g].values);
                const double pooled = scatter_[g].errorOfMean(mean.count);
                values.push_back({mean.mean, std::isfinite(pooled) ? pooled : trials[g].error});
            }
        }
    }

    /// Whether the point has all figures.
    bool whole(std::size_t point) const {
        return std::all_of(result_.goals.begin(), result_.goals.end(),
                           [&](const GoalResult& g) { return std::isfinite(g.values[point].value); });
    }

    /// A process for each goal.
    Processes fitted() const {
        std::vector<std::vector<double>> points;
        std::vector<std::size_t> known;
        for (std::size_t i = 0; i < unit_.size(); ++i) {
            if (!whole(i)) continue;
            points.push_back(unit_[i]);
            known.push_back(i);
        }
        if (points.size() < 2)
            throw RunError(fmt::format("{} of the first {} points have {}: nothing to search from; choose other bounds",
                                       points.size(), unit_.size(),
                                       goals_.size() == 1 ? "the figure of the target" : "the figures of all targets"));
        Processes processes;
        for (const GoalResult& goal : result_.goals) {
            std::vector<Measured> values;
            for (const std::size_t i : known) {
                // The process takes a value of unknown error as it is.
                const double error = goal.values[i].error;
                values.push_back({goal.values[i].value, std::isfinite(error) ? error : 0});
            }
            processes.emplace_back(points, values);
        }
        return processes;
    }

    /// What is believed of the distances to the targets at a point, each over its tolerance and times the root of its
    /// weight.
    std::vector<Belief> distances(const Processes& processes, const std::vector<double>& u) const {
        std::vector<Belief> all;
        for (std::size_t g = 0; g < goals_.size(); ++g) {
            const Belief belief = processes[g].at(u);
            const double scale = std::sqrt(goals_[g].weight) / goals_[g].tolerance;
            all.push_back({(belief.mean - goals_[g].target) * scale, belief.deviation * scale});
        }
        return all;
    }

    double distanceOf(const Processes& processes, std::size_t point) const {
        double squares = 0;
        for (const Belief& b : distances(processes, unit_[point])) squares += b.mean * b.mean;
        return std::sqrt(squares);
    }

    /// Chooses the tried point that is believed nearest to the targets. A single observation may be near by chance, but
    /// the processes take its neighbours into account. With `open`, points whose confirmation missed are left out,
    /// unless there is no other.
    void choose(const Processes& processes, bool open) {
        nearest_ = std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < unit_.size(); ++i) {
            if (!whole(i) || (open && isConfirmed(i)) || distanceOf(processes, i) >= nearest_) continue;
            nearest_ = distanceOf(processes, i);
            result_.best = i;
        }
        if (open && !std::isfinite(nearest_)) choose(processes, false);
    }

    /// Whether the best point is one that has not been confirmed yet and that is believed to meet all goals.
    bool believedMet(const Processes& processes) const {
        if (isConfirmed(result_.best)) return false;
        for (std::size_t g = 0; g < goals_.size(); ++g) {
            const Belief belief = processes[g].at(unit_[result_.best]);
            if (!(std::abs(belief.mean - goals_[g].target) <= goals_[g].tolerance &&
                  belief.deviation <= goals_[g].tolerance))
                return false;
        }
        return true;
    }

    double gain(const Processes& processes, const std::vector<double>& u) const {
        for (const auto& former : unit_)
            if (distance(u, former) < kTooNear) return 0;
        const std::vector<Belief> beliefs = distances(processes, u);
        return beliefs.size() == 1 ? expectedImprovement(beliefs[0].mean, beliefs[0].deviation, nearest_)
                                   : expectedImprovement(beliefs, nearest_);
    }

    std::optional<std::vector<double>> mostPromising(const Processes& processes) const {
        std::vector<double> best;
        double most = 0;
        for (int i = 1; i <= kCandidates; ++i) {
            const std::vector<double> u = halton(i, aim_.parameters.size());
            const double here = gain(processes, u);
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
                    const double there = gain(processes, trial);
                    if (there <= most) continue;
                    most = there;
                    best = trial;
                }
            }
        }
        if (most < kNothingNew) return std::nullopt;
        return best;
    }

    SearchResult finished(const Processes& processes) {
        result_.misfit = std::pow(distanceOf(processes, result_.best), 2);
        for (std::size_t g = 0; g < goals_.size(); ++g) {
            const Belief belief = processes[g].at(unit_[result_.best]);
            result_.goals[g].mean = belief.mean;
            result_.goals[g].deviation = belief.deviation;
        }
        findCompatible(processes);
        findSensitivity(processes);
        return result_;
    }

    void findCompatible(const Processes& processes) {
        const std::size_t d = aim_.parameters.size();
        const double inf = std::numeric_limits<double>::infinity();
        result_.compatible.assign(d, {inf, -inf});
        const auto widen = [&](const std::vector<double>& u) {
            for (std::size_t g = 0; g < goals_.size(); ++g) {
                const Belief belief = processes[g].at(u);
                if (std::abs(belief.mean - goals_[g].target) > 2 * belief.deviation + goals_[g].tolerance) return;
            }
            const Parameters p = inUnits(aim_, u);
            for (std::size_t i = 0; i < d; ++i) {
                result_.compatible[i].first = std::min(result_.compatible[i].first, p[i]);
                result_.compatible[i].second = std::max(result_.compatible[i].second, p[i]);
            }
        };
        for (int i = 1; i <= kCandidates; ++i) widen(halton(i, d));
        for (const auto& u : unit_) widen(u);
    }

    /// Slopes of the beliefs at the best point, and the errors of the parameters that follow: the inverse of
    /// sum_g w_g s_g s_g^T, with s_g the slopes over the tolerance (Gauss-Newton).
    void findSensitivity(const Processes& processes) {
        const std::size_t d = aim_.parameters.size();
        Eigen::MatrixXd information = Eigen::MatrixXd::Zero(Eigen::Index(d), Eigen::Index(d));
        for (std::size_t g = 0; g < goals_.size(); ++g) {
            Eigen::VectorXd slopes{Eigen::Index(d)};
            for (std::size_t i = 0; i < d; ++i) {
                std::vector<double> low = unit_[result_.best], high = low;
                low[i] = std::max(0.0, low[i] - kSlopeStep);
                high[i] = std::min(1.0, high[i] + kSlopeStep);
                slopes[Eigen::Index(i)] = (processes[g].at(high).mean - processes[g].at(low).mean) /
                                          ((high[i] - low[i]) * goals_[g].tolerance);
            }
            result_.goals[g].sensitivity.assign(slopes.begin(), slopes.end());
            information += goals_[g].weight * slopes * slopes.transpose();
        }
        // What the goals leave open has an error without bound; the least addition keeps it a number.
        information.diagonal().array() += kOpen;
        const Eigen::MatrixXd covariance = information.inverse();
        for (std::size_t i = 0; i < d; ++i) {
            const FreeParameter& free = aim_.parameters[i];
            result_.parameterError.push_back(std::sqrt(covariance(Eigen::Index(i), Eigen::Index(i))) *
                                             (free.high - free.low));
        }
    }

    const CalibrationAim& aim_;
    const TryPoints& tryPoints_;
    const ConfirmPoint& confirmPoint_;
    std::vector<Goal> goals_;
    std::vector<SeedScatter> scatter_ = std::vector<SeedScatter>(goals_.size());  ///< of each goal
    std::vector<Trials> trials_;
    std::vector<std::vector<double>> unit_;  ///< the points tried, in the unit cube
    double nearest_ = 0;                     ///< root of the least believed misfit
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

namespace {

/// The value below which a normal distribution has this part, by halving.
double normalQuantile(double part) {
    double low = -8, high = 8;
    for (int i = 0; i < 60; ++i) (cumulative((low + high) / 2) < part ? low : high) = (low + high) / 2;
    return (low + high) / 2;
}

/// The same points of the normal distribution in every call.
const std::vector<std::vector<double>>& normalDraws() {
    static const std::vector<std::vector<double>> kPoints = [] {
        std::vector<std::vector<double>> points;
        for (int i = 1; i <= kDraws; ++i) {
            points.push_back(halton(i, kMostTargets));
            for (double& u : points.back()) u = normalQuantile(u);
        }
        return points;
    }();
    return kPoints;
}

}  // namespace

double expectedImprovement(const std::vector<Belief>& beliefs, double best) {
    double sum = 0;
    for (const std::vector<double>& z : normalDraws()) {
        double squares = 0;
        for (std::size_t i = 0; i < beliefs.size(); ++i)
            squares += std::pow(beliefs[i].mean + beliefs[i].deviation * z[i], 2);
        sum += std::max(0.0, best - std::sqrt(squares));
    }
    return sum / kDraws;
}

std::vector<Goal> goalsOf(const CalibrationAim& aim) {
    if (aim.targets.empty()) return {{aim.target, aim.tolerance, 1}};
    std::vector<Goal> goals;
    for (const CalibrationTarget& t : aim.targets) goals.push_back({t.value, t.uncertainty, t.weight});
    return goals;
}

std::optional<SearchResult> search(const CalibrationAim& aim, const TryPoints& tryPoints,
                                   const ConfirmPoint& confirmPoint) {
    return Search(aim, tryPoints, confirmPoint).run();
}

std::vector<Parameters> firstPoints(const CalibrationAim& aim) {
    std::vector<Parameters> points;
    for (const auto& u : firstInUnits(aim)) points.push_back(inUnits(aim, u));
    return points;
}

}  // namespace vkdose
