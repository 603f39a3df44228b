#pragma once
// The points that a search has tried, what their runs gave, and what is believed between them.

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "host/study/calibration_aim.h"
#include "host/study/gaussian_process.h"
#include "host/study/seed_scatter.h"

namespace vkdose {

using Parameters = std::vector<double>;  ///< a value for each free parameter, in the units of their keys
using UnitPoint = std::vector<double>;   ///< the same in the unit cube: 0 is the lower bound, 1 the upper one

/// What the runs at one point gave of one figure, in its own unit.
struct Trial {
    std::vector<double> values;  ///< one for each seed; seeds without one are left out
    double error = 0;            ///< standard error of a single seed's value; NaN if it is not known
};

/// What the runs at one point gave: a trial for each figure.
using Trials = std::vector<Trial>;

/// Tries a few points. Returns nothing if the search was interrupted.
using TryPoints = std::function<std::optional<std::vector<Trials>>(const std::vector<Parameters>&)>;

/// Runs a point that was tried again, with `aim.confirmingSeeds` new seeds. Returns nothing if it was interrupted.
using ConfirmPoint = std::function<std::optional<Trials>(const Parameters&)>;

using Processes = std::vector<GaussianProcess>;  ///< one for each figure

class SampledPoints {
  public:
    SampledPoints(const CalibrationAim& aim, std::size_t figures) : aim_(aim), values_(figures), scatter_(figures) {}

    /// The points with which a search begins, whatever they give.
    static std::vector<UnitPoint> first(const CalibrationAim& aim);
    /// In the unit of the keys, as it will be written: six digits.
    static Parameters inUnits(const CalibrationAim& aim, const UnitPoint& u);

    /// Returns false if the search was interrupted.
    bool tryOut(const std::vector<UnitPoint>& points, const TryPoints& tryPoints);
    /// Takes what further seeds gave into the trials of a point.
    void add(std::size_t point, const Trials& more);

    std::size_t size() const { return unit_.size(); }
    const std::vector<UnitPoint>& unit() const { return unit_; }
    const std::vector<Parameters>& points() const { return points_; }
    /// Of each point the mean of a figure over the seeds; NaN where there is none. The errors are the scatter from seed
    /// to seed, pooled over all points, or with a single seed the trial's own; NaN if neither is known.
    const std::vector<Measured>& values(std::size_t figure) const { return values_[figure]; }
    const SeedScatter& scatter(std::size_t figure) const { return scatter_[figure]; }
    /// Whether the point has all figures.
    bool whole(std::size_t point) const;

    /// Processes through all points that have all figures. Throws RunError if there are fewer than two.
    Processes fitted() const;
    /// The point of the cube where the gain is largest, none within `near` of one that was tried; nothing if it is
    /// nowhere at least `least`.
    std::optional<UnitPoint> mostPromising(const std::function<double(const UnitPoint&)>& gain, double least,
                                           double near) const;

  private:
    /// Means and errors of all trials. They are made anew after each trial, because it tells more about the scatter of
    /// all.
    void weigh();

    const CalibrationAim& aim_;
    std::vector<UnitPoint> unit_;
    std::vector<Parameters> points_;
    std::vector<Trials> trials_;
    std::vector<std::vector<Measured>> values_;  ///< of each figure
    std::vector<SeedScatter> scatter_;           ///< of each figure
};

}  // namespace vkdose
