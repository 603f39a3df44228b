#include "host/study/surrogate.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "host/study/normal_distribution.h"

namespace vkdose {

namespace {

constexpr double kNothingNew = 1e-3;  // of the tolerance: an improvement not worth a run
constexpr double kTooNear = 1e-3;     // of the range: a run so near to a former one tells nothing new

class Search {
  public:
    Search(const CalibrationAim& aim, const TryPoints& tryPoints, const ConfirmPoint& confirmPoint)
        : aim_(aim), tryPoints_(tryPoints), confirmPoint_(confirmPoint), goals_(goalsOf(aim)) {}

    std::optional<SearchResult> run() {
        if (!sampled_.tryOut(SampledPoints::first(aim_), tryPoints_)) return std::nullopt;
        for (;;) {
            const Processes processes = sampled_.fitted();
            if (result_.met) return finished(processes);
            choose(processes, true);
            const int made = int(sampled_.size() + result_.confirmations.size());
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
            if (!sampled_.tryOut({*next}, tryPoints_)) return std::nullopt;
        }
    }

  private:
    /// Runs the best point with new seeds, and takes what they gave into its trials. Returns false if interrupted.
    bool confirm() {
        const auto trials = confirmPoint_(sampled_.points()[result_.best]);
        if (!trials) return false;
        sampled_.add(result_.best, *trials);
        Confirmation& c = result_.confirmations.emplace_back(Confirmation{result_.best, {}});
        for (std::size_t g = 0; g < goals_.size(); ++g)
            c.figures.push_back(confirmedBy(trials->at(g).values, std::size_t(aim_.confirmingSeeds),
                                            sampled_.scatter(g), goals_[g].target, goals_[g].tolerance));
        result_.met = c.met();
        return true;
    }

    bool isConfirmed(std::size_t point) const {
        return std::any_of(result_.confirmations.begin(), result_.confirmations.end(),
                           [&](const Confirmation& c) { return c.point == point; });
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
        for (const Belief& b : distances(processes, sampled_.unit()[point])) squares += b.mean * b.mean;
        return std::sqrt(squares);
    }

    /// Chooses the tried point that is believed nearest to the targets. A single observation may be near by chance, but
    /// the processes take its neighbours into account. With `open`, points whose confirmation missed are left out,
    /// unless there is no other.
    void choose(const Processes& processes, bool open) {
        nearest_ = std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < sampled_.size(); ++i) {
            if (!sampled_.whole(i) || (open && isConfirmed(i)) || distanceOf(processes, i) >= nearest_) continue;
            nearest_ = distanceOf(processes, i);
            result_.best = i;
        }
        if (open && !std::isfinite(nearest_)) choose(processes, false);
    }

    /// Whether the best point is one that has not been confirmed yet and that is believed to meet all goals.
    bool believedMet(const Processes& processes) const {
        if (isConfirmed(result_.best)) return false;
        for (std::size_t g = 0; g < goals_.size(); ++g) {
            const Belief belief = processes[g].at(sampled_.unit()[result_.best]);
            if (!(std::abs(belief.mean - goals_[g].target) <= goals_[g].tolerance &&
                  belief.deviation <= goals_[g].tolerance))
                return false;
        }
        return true;
    }

    double gain(const Processes& processes, const UnitPoint& u) const {
        const std::vector<Belief> beliefs = distances(processes, u);
        return beliefs.size() == 1 ? expectedImprovement(beliefs[0].mean, beliefs[0].deviation, nearest_)
                                   : expectedImprovement(beliefs, nearest_);
    }

    std::optional<UnitPoint> mostPromising(const Processes& processes) const {
        return sampled_.mostPromising([&](const UnitPoint& u) { return gain(processes, u); }, kNothingNew, kTooNear);
    }

    SearchResult finished(const Processes& processes) {
        result_.misfit = std::pow(distanceOf(processes, result_.best), 2);
        result_.points = sampled_.points();
        result_.goals.resize(goals_.size());
        for (std::size_t g = 0; g < goals_.size(); ++g) {
            result_.goals[g].values = sampled_.values(g);
            const Belief belief = processes[g].at(sampled_.unit()[result_.best]);
            result_.goals[g].mean = belief.mean;
            result_.goals[g].deviation = belief.deviation;
            result_.goals[g].leaveOneOut = leaveOneOut(processes[g].leftOut());
        }
        findSensitivity(processes);
        result_.processes = processes;
        return result_;
    }

    /// Slopes of the beliefs at the best point.
    void findSensitivity(const Processes& processes) {
        for (std::size_t g = 0; g < goals_.size(); ++g) {
            for (std::size_t i = 0; i < aim_.parameters.size(); ++i)
                result_.goals[g].sensitivity.push_back(processes[g].slope(sampled_.unit()[result_.best], i) /
                                                       goals_[g].tolerance);
        }
    }

    const CalibrationAim& aim_;
    const TryPoints& tryPoints_;
    const ConfirmPoint& confirmPoint_;
    std::vector<Goal> goals_;
    SampledPoints sampled_{aim_, goals_.size()};
    double nearest_ = 0;  ///< root of the least believed misfit
    SearchResult result_;
};

}  // namespace

double expectedImprovement(double mean, double deviation, double best) {
    if (!(deviation > 0)) return std::max(0.0, best - std::abs(mean));
    // The values above and below the target are integrated apart: the integral of (best - y) p(y) from 0 to best, and
    // the same mirrored.
    const auto half = [&](double m) {
        const double zero = -m / deviation, end = (best - m) / deviation;
        return (best - m) * (normalBelow(end) - normalBelow(zero)) +
               deviation * (normalDensity(end) - normalDensity(zero));
    };
    return std::max(0.0, half(mean) + half(-mean));
}

double expectedImprovement(const std::vector<Belief>& beliefs, double best) {
    double sum = 0;
    for (const std::vector<double>& z : normalDraws()) {
        double squares = 0;
        for (std::size_t i = 0; i < beliefs.size(); ++i)
            squares += std::pow(beliefs[i].mean + beliefs[i].deviation * z[i], 2);
        sum += std::max(0.0, best - std::sqrt(squares));
    }
    return sum / double(normalDraws().size());
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
    for (const UnitPoint& u : SampledPoints::first(aim)) points.push_back(SampledPoints::inUnits(aim, u));
    return points;
}

}  // namespace vkdose
