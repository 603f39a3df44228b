#include "host/study/front_search.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "host/analysis/beta.h"
#include "host/study/normal_distribution.h"

namespace vkdose {

namespace {

using Wish = CalibrationTarget::Wish;

constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr double kLeastGain = 1e-3;   // of the spread of the figures: a gain not worth a run
constexpr double kSpacing = 0.02;     // of the range: a front of points so near to each other is no choice
constexpr double kSumPart = 0.05;     // of the weighted sum beside the largest part, so that no wish is for nothing
constexpr int kTurnsWithoutGain = 8;  // ways of weighing in a row that promise nothing end the search

/// A figure as a number of which less is better.
double cost(const CalibrationTarget& goal, double value) {
    return goal.wish == Wish::Largest ? -value : value;
}

bool keepsBounds(const std::vector<CalibrationTarget>& goals, const std::vector<double>& figures) {
    for (std::size_t g = 0; g < goals.size(); ++g)
        if (!(figures[g] >= goals[g].atLeast && figures[g] <= goals[g].atMost)) return false;
    return true;
}

/// Whether a is at least as good as b in all wishes, and better in one.
bool dominates(const std::vector<CalibrationTarget>& goals, const std::vector<double>& a,
               const std::vector<double>& b) {
    bool better = false;
    for (std::size_t g = 0; g < goals.size(); ++g) {
        if (goals[g].wish == Wish::None) continue;
        if (cost(goals[g], a[g]) > cost(goals[g], b[g])) return false;
        better = better || cost(goals[g], a[g]) < cost(goals[g], b[g]);
    }
    return better;
}

/// Those of the rows that keep the bounds and are dominated by none of the others that do; along the first wish, the
/// best first.
std::vector<std::size_t> frontOf(const std::vector<CalibrationTarget>& goals,
                                 const std::vector<std::vector<double>>& rows) {
    std::vector<std::size_t> front;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const bool dominated = std::any_of(rows.begin(), rows.end(), [&](const std::vector<double>& other) {
            return keepsBounds(goals, other) && dominates(goals, other, rows[i]);
        });
        if (keepsBounds(goals, rows[i]) && !dominated) front.push_back(i);
    }
    const auto first = std::find_if(goals.begin(), goals.end(), [](const auto& g) { return g.wish != Wish::None; });
    const auto g = std::size_t(first - goals.begin());
    std::stable_sort(front.begin(), front.end(), [&](std::size_t a, std::size_t b) {
        return cost(goals[g], rows[a][g]) < cost(goals[g], rows[b][g]);
    });
    return front;
}

/// What the processes believe of each figure at a point.
std::vector<Belief> beliefsAt(const Processes& processes, const UnitPoint& u) {
    std::vector<Belief> all;
    for (const GaussianProcess& process : processes) all.push_back(process.at(u));
    return all;
}

class FrontSearch {
  public:
    FrontSearch(const CalibrationAim& aim, const TryPoints& tryPoints, const ConfirmPoint& confirmPoint)
        : aim_(aim), goals_(aim.targets), tryPoints_(tryPoints), confirmPoint_(confirmPoint) {
        for (std::size_t g = 0; g < goals_.size(); ++g)
            if (goals_[g].wish != Wish::None) wished_.push_back(g);
    }

    std::optional<FrontResult> run() {
        if (!sampled_.tryOut(SampledPoints::first(aim_), tryPoints_)) return std::nullopt;
        while (int(sampled_.size()) < aim_.maxRuns) {
            const auto next = mostPromising();
            if (!next) break;
            if (!sampled_.tryOut({*next}, tryPoints_)) return std::nullopt;
        }
        return confirmed();
    }

  private:
    /// What the point gave of each goal.
    std::vector<double> figuresOf(std::size_t point) const {
        std::vector<double> figures;
        for (std::size_t g = 0; g < goals_.size(); ++g) figures.push_back(sampled_.values(g)[point].value);
        return figures;
    }

    /// The least and the largest cost of each wish so far.
    void findSpread() {
        low_.assign(wished_.size(), kInfinite);
        span_.assign(wished_.size(), 0);
        for (std::size_t w = 0; w < wished_.size(); ++w) {
            double high = -kInfinite;
            for (std::size_t i = 0; i < sampled_.size(); ++i) {
                if (!sampled_.whole(i)) continue;
                const double here = cost(goals_[wished_[w]], sampled_.values(wished_[w])[i].value);
                low_[w] = std::min(low_[w], here);
                high = std::max(high, here);
            }
            span_[w] = high > low_[w] ? high - low_[w] : 1;
        }
    }

    /// The wishes as one number of which less is better. `figures` of each goal.
    double weighed(const std::vector<double>& figures) const {
        double largest = -kInfinite, sum = 0;
        for (std::size_t w = 0; w < wished_.size(); ++w) {
            const double part = weights_[w] * (cost(goals_[wished_[w]], figures[wished_[w]]) - low_[w]) / span_[w];
            largest = std::max(largest, part);
            sum += part;
        }
        return largest + kSumPart * sum;
    }

    /// Positive weights with the sum 1, evenly spread over all such: another one at each turn.
    void turnWeights() {
        weights_ = haltonPoint(++turn_, wished_.size());
        double sum = 0;
        for (double& w : weights_) sum += w = -std::log(w);
        for (double& w : weights_) w /= sum;
    }

    /// The probability that all bounds are kept.
    double feasibility(const std::vector<Belief>& beliefs) const {
        double product = 1;
        for (std::size_t g = 0; g < goals_.size(); ++g) {
            const Belief& b = beliefs[g];
            const double low = goals_[g].atLeast - b.mean, high = goals_[g].atMost - b.mean;  // may be infinite
            if (b.deviation > 0)
                product *= normalBelow(high / b.deviation) - normalBelow(low / b.deviation);
            else if (low > 0 || high < 0)
                return 0;
        }
        return product;
    }

    /// The least weighed figure that is believed of a tried point within the bounds; infinite without one.
    double leastBelieved(const Processes& processes) const {
        double least = kInfinite;
        for (std::size_t i = 0; i < sampled_.size(); ++i) {
            if (!sampled_.whole(i) || !keepsBounds(goals_, figuresOf(i))) continue;
            std::vector<double> means;
            for (const Belief& b : beliefsAt(processes, sampled_.unit()[i])) means.push_back(b.mean);
            least = std::min(least, weighed(means));
        }
        return least;
    }

    double gain(const Processes& processes, const UnitPoint& u, double least) const {
        const std::vector<Belief> beliefs = beliefsAt(processes, u);
        const double kept = feasibility(beliefs);
        if (!std::isfinite(least) || kept < kLeastGain) return kept;
        double sum = 0;
        std::vector<double> figures(goals_.size());
        for (const std::vector<double>& z : normalDraws()) {
            for (std::size_t g = 0; g < goals_.size(); ++g) figures[g] = beliefs[g].mean + beliefs[g].deviation * z[g];
            sum += std::max(0.0, least - weighed(figures));
        }
        return kept * sum / double(normalDraws().size());
    }

    std::optional<UnitPoint> mostPromising() {
        const Processes processes = sampled_.fitted();
        findSpread();
        for (int idle = 0; idle < kTurnsWithoutGain; ++idle) {
            turnWeights();
            const double least = leastBelieved(processes);
            if (auto next = sampled_.mostPromising([&](const UnitPoint& u) { return gain(processes, u, least); },
                                                   kLeastGain, kSpacing))
                return next;
        }
        return std::nullopt;
    }

    /// The front by the first runs, thinned to what is confirmed.
    std::vector<std::size_t> candidates() const {
        std::vector<std::vector<double>> rows;
        for (std::size_t i = 0; i < sampled_.size(); ++i) rows.push_back(figuresOf(i));  // NaN keeps no bounds
        std::vector<std::size_t> front = frontOf(goals_, rows);
        if (front.size() <= kMostOnFront) return front;
        std::vector<std::size_t> spread;
        for (std::size_t k = 0; k < kMostOnFront; ++k)
            spread.push_back(front[k * (front.size() - 1) / (kMostOnFront - 1)]);
        return spread;
    }

    std::optional<FrontResult> confirmed() {
        FrontResult result;
        result.points = sampled_.points();
        for (std::size_t g = 0; g < goals_.size(); ++g) result.values.push_back(sampled_.values(g));
        std::vector<Trials> all;
        const std::vector<std::size_t> chosen = candidates();
        for (const std::size_t point : chosen) {
            const auto trials = confirmPoint_(sampled_.points()[point]);
            if (!trials) return std::nullopt;
            sampled_.add(point, *trials);  // the scatter of the figures becomes better known
            all.push_back(*trials);
        }
        std::vector<std::vector<double>> means;
        for (const Trials& trials : all) {
            means.emplace_back();
            for (const Trial& t : trials) {
                const bool complete = t.values.size() == std::size_t(aim_.confirmingSeeds);
                means.back().push_back(complete ? estimateOf(t.values).mean : std::nan(""));
            }
        }
        const std::vector<std::size_t> front = frontOf(goals_, means);
        for (std::size_t k = 0; k < chosen.size(); ++k) {
            FrontPoint& p = result.front.emplace_back();
            p.point = chosen[k];
            for (std::size_t g = 0; g < goals_.size(); ++g) {
                const Estimate mean = estimateOf(all[k][g].values);
                p.figures.push_back({mean.mean, sampled_.scatter(g).errorOfMean(mean.count)});
            }
            const bool complete =
                std::none_of(means[k].begin(), means[k].end(), [](double x) { return std::isnan(x); });
            p.verdict = !complete                                       ? FrontPoint::Verdict::Incomplete
                        : !keepsBounds(goals_, means[k])                ? FrontPoint::Verdict::OutOfBounds
                        : std::count(front.begin(), front.end(), k) > 0 ? FrontPoint::Verdict::OnFront
                                                                        : FrontPoint::Verdict::Dominated;
        }
        return result;
    }

    const CalibrationAim& aim_;
    const std::vector<CalibrationTarget>& goals_;
    const TryPoints& tryPoints_;
    const ConfirmPoint& confirmPoint_;
    std::vector<std::size_t> wished_;  ///< the goals with a wish
    SampledPoints sampled_{aim_, goals_.size()};
    int turn_ = 0;
    std::vector<double> weights_;     ///< of each wish
    std::vector<double> low_, span_;  ///< of the cost of each wish
};

}  // namespace

std::optional<FrontResult> searchFront(const CalibrationAim& aim, const TryPoints& tryPoints,
                                       const ConfirmPoint& confirmPoint) {
    return FrontSearch(aim, tryPoints, confirmPoint).run();
}

std::string verdictText(FrontPoint::Verdict verdict) {
    switch (verdict) {
        case FrontPoint::Verdict::OnFront:
            return "on the front";
        case FrontPoint::Verdict::Dominated:
            return "dominated";
        case FrontPoint::Verdict::OutOfBounds:
            return "out of bounds";
        case FrontPoint::Verdict::Incomplete:
            return "incomplete";
    }
    return {};
}

}  // namespace vkdose
