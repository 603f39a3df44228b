#pragma once
// The mass rate of a feeder over time: its windows, their mean and scatter, and the part of the run that is steady.

#include <limits>
#include <span>
#include <string>
#include <vector>

#include "host/analysis/outlet.h"
#include "host/analysis/steady.h"
#include "host/model/case.h"

namespace vkdose {

/// From what the length of a window follows [s]; 0: there is none.
struct WindowRule {
    double asked = 0;                           ///< by the case
    double period = 0;                          ///< a turn of the drive; without a drive the longest period of a body
    double interval = 0;                        ///< of the sensors
    std::optional<double> from = std::nullopt;  ///< of countedFrom
};
WindowRule windowRuleOf(const Case& c);

/// The length of a window [s] if the drive turns for `turning` [s]: what the case asks for, else one period, else a
/// twentieth of the time. The latter two become so many whole periods, or intervals, that they are not shorter than
/// kFewestRateIntervals sensor intervals.
double windowLength(const WindowRule& rule, double turning);

/// A stretch of the time in which the drive turns. Rests between its ends are no part of it.
struct RateWindow {
    double from = 0, to = 0;  ///< simulated time [s]
    double rate = 0;          ///< mass that came out in it, over its length [kg/s]
};

struct MassRate : SteadySeries {
    double window = std::numeric_limits<double>::quiet_NaN();  ///< length of one [s]; NaN if nothing turned
    std::vector<RateWindow> windows;                           ///< in order; the last lacks a hundredth at most

    /// When the steady part begins [s]; NaN without one.
    double steadyTime() const;
};

/// From the lines of a run's time series. Only what comes out while the drive turns forward counts, over that time; in
/// a run without doses all that comes out.
/// Between two lines the mass is taken to come out evenly.
MassRate massRate(const std::vector<FlowSample>& samples, const WindowRule& rule);

/// Whether the windows of its steady part scatter by more than their mean: a device that doses in strokes gives most of
/// its powder in few of them, and its steady rate is that of no time.
bool comesInPortions(const MassRate& rate);

using RateFigure = NamedFigure<MassRate>;
extern const std::span<const RateFigure> kRateFigures;
/// Under this name a target of a calibration has them: "rate.steady_kg_s".
inline constexpr const char* kRateName = "rate";

/// "0.402 g/s ± 0.0021 g/s": an error that is not known is left out. `plusMinus` is the sign.
std::string rateText(const SeriesFigures& f, const char* plusMinus);

}  // namespace vkdose
