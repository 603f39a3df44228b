#include "host/study/sampled_points.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/analysis/beta.h"
#include "host/core/error.h"
#include "host/core/number.h"
#include "host/study/normal_distribution.h"

namespace vkdose {

namespace {

constexpr int kCandidates = 4096;  // points of the range that are looked at for the next run

double distance(const UnitPoint& a, const UnitPoint& b) {
    double most = 0;
    for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, std::abs(a[i] - b[i]));
    return most;
}

}  // namespace

std::vector<UnitPoint> SampledPoints::first(const CalibrationAim& aim) {
    const std::size_t d = aim.parameters.size();
    std::vector<UnitPoint> first;
    const int count = aim.firstPoints > 0 ? aim.firstPoints : 2 * int(d) + 1;
    for (int i = 1; i <= std::min(aim.maxRuns, count); ++i) first.push_back(haltonPoint(i, d));
    return first;
}

Parameters SampledPoints::inUnits(const CalibrationAim& aim, const UnitPoint& u) {
    Parameters p;
    for (std::size_t i = 0; i < u.size(); ++i) {
        const FreeParameter& free = aim.parameters[i];
        p.push_back(nearestDecimal(free.low + u[i] * (free.high - free.low), 6));
    }
    return p;
}

bool SampledPoints::tryOut(const std::vector<UnitPoint>& points, const TryPoints& tryPoints) {
    std::vector<Parameters> batch;
    for (const UnitPoint& u : points) batch.push_back(inUnits(aim_, u));
    const auto trials = tryPoints(batch);
    if (!trials) return false;
    unit_.insert(unit_.end(), points.begin(), points.end());
    points_.insert(points_.end(), batch.begin(), batch.end());
    trials_.insert(trials_.end(), trials->begin(), trials->end());
    weigh();
    return true;
}

void SampledPoints::add(std::size_t point, const Trials& more) {
    for (std::size_t g = 0; g < values_.size(); ++g) {
        std::vector<double>& values = trials_[point][g].values;
        values.insert(values.end(), more.at(g).values.begin(), more.at(g).values.end());
    }
    weigh();
}

void SampledPoints::weigh() {
    for (std::size_t g = 0; g < values_.size(); ++g) {
        std::vector<std::vector<double>> seeds;
        for (const Trials& trials : trials_) seeds.push_back(trials.at(g).values);
        scatter_[g] = scatterOfSeeds(seeds);
        values_[g].clear();
        for (const Trials& trials : trials_) {
            const Estimate mean = estimateOf(trials[g].values);
            const double pooled = scatter_[g].errorOfMean(mean.count);
            values_[g].push_back({mean.mean, std::isfinite(pooled) ? pooled : trials[g].error});
        }
    }
}

bool SampledPoints::whole(std::size_t point) const {
    return std::all_of(values_.begin(), values_.end(),
                       [&](const std::vector<Measured>& v) { return std::isfinite(v[point].value); });
}

Processes SampledPoints::fitted() const {
    std::vector<UnitPoint> points;
    std::vector<std::size_t> known;
    for (std::size_t i = 0; i < unit_.size(); ++i) {
        if (!whole(i)) continue;
        points.push_back(unit_[i]);
        known.push_back(i);
    }
    if (points.size() < 2)
        throw RunError(fmt::format("{} of the first {} points have {}: nothing to search from; choose other bounds",
                                   points.size(), unit_.size(),
                                   values_.size() == 1 ? "the figure of the target" : "the figures of all targets"));
    Processes processes;
    for (const std::vector<Measured>& of : values_) {
        std::vector<Measured> values;
        for (const std::size_t i : known) {
            // The process takes a value of unknown error as it is.
            values.push_back({of[i].value, std::isfinite(of[i].error) ? of[i].error : 0});
        }
        processes.emplace_back(points, values);
    }
    return processes;
}

std::optional<UnitPoint> SampledPoints::mostPromising(const std::function<double(const UnitPoint&)>& gain, double least,
                                                      double near) const {
    const auto gainAt = [&](const UnitPoint& u) {
        for (const UnitPoint& former : unit_)
            if (distance(u, former) < near) return 0.0;
        return gain(u);
    };
    UnitPoint best;
    double most = 0;
    for (int i = 1; i <= kCandidates; ++i) {
        const UnitPoint u = haltonPoint(i, aim_.parameters.size());
        const double here = gainAt(u);
        if (here <= most) continue;
        most = here;
        best = u;
    }
    // The candidates are a few thousandths apart. Halved steps find the best point between them.
    for (double step = 0.02; !best.empty() && step > 1e-4; step /= 2) {
        for (std::size_t i = 0; i < best.size(); ++i) {
            for (const double sign : {-1.0, 1.0}) {
                UnitPoint trial = best;
                trial[i] = std::clamp(trial[i] + sign * step, 0.0, 1.0);
                const double there = gainAt(trial);
                if (there <= most) continue;
                most = there;
                best = trial;
            }
        }
    }
    if (most < least) return std::nullopt;
    return best;
}

}  // namespace vkdose
