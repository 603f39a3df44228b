#pragma once
// The mass rate of a feeder over time: its windows, their mean and scatter, and the part of the run that is steady.

#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "host/analysis/outlet.h"
#include "host/model/case.h"

namespace vkdose {

/// From what the length of a window follows [s]; 0: there is none.
struct WindowRule {
    double asked = 0;     ///< by the case
    double period = 0;    ///< a turn of the drive; without a drive the longest period of a body
    double interval = 0;  ///< of the sensors
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

/// Of windows; NaN where there are too few.
struct RateFigures {
    double mean = std::numeric_limits<double>::quiet_NaN();      ///< [kg/s]; NaN without a window
    double error = std::numeric_limits<double>::quiet_NaN();     ///< standard error of the mean [kg/s]
    double relative = std::numeric_limits<double>::quiet_NaN();  ///< their deviation over the mean; NaN if that is 0
};

/// Fewer windows have no error and no RSD.
inline constexpr std::size_t kFewestWindows = 5;
/// In fewer windows no steady part is sought: half of them must have an error.
inline constexpr std::size_t kFewestForSteady = 2 * kFewestWindows;

/// The error is that of the means of at most ten blocks of windows in a row, which differ by one window at most
/// (batch means; Schmeiser 1982, Oper. Res. 30, 556: more than ten to thirty batches gain little).
RateFigures rateFigures(std::span<const RateWindow> windows);

/// The first window of the steady part by MSER-5 (White 1997, Simulation 69, 323; White, Cobb and Spratt 2000, Winter
/// Simulation Conference): the truncation d, at most half of the n batches of five observations, for which the sum of
/// squares of the rest about its mean, over (n - d)^2, is least. A window is a batch: its observations are the rates
/// in its fifths. None with fewer than kFewestForSteady windows, without any mass, or if the least is at half: then the
/// rate still changes.
std::optional<std::size_t> steadyFrom(std::span<const RateWindow> windows);

struct MassRate {
    double window = std::numeric_limits<double>::quiet_NaN();  ///< length of one [s]; NaN if nothing turned
    std::vector<RateWindow> windows;                           ///< in order; the last lacks a hundredth at most
    RateFigures all;
    std::optional<std::size_t> steady;  ///< the first window of the steady part
    RateFigures steadyPart;

    /// When the steady part begins [s]; NaN if there is none.
    double steadyTime() const;
};

/// From the lines of a run's time series. Only what comes out while the drive turns forward counts, over that time.
/// Between two lines the mass is taken to come out evenly.
MassRate massRate(const std::vector<FlowSample>& samples, const WindowRule& rule);

/// A figure of the mass rate as files name it, with the unit in the name.
struct RateFigure {
    const char* name = "";
    double (*of)(const MassRate&) = nullptr;  ///< NaN where there is none
    const char* error = nullptr;              ///< the name of its standard error, if it has one
};
extern const std::span<const RateFigure> kRateFigures;
/// Under this name a target of a calibration has them: "rate.steady_kg_s".
inline constexpr const char* kRateName = "rate";
/// The figure that a target names so; null if it is none.
const RateFigure* rateFigureNamed(const std::string& target);

/// "0.402 g/s ± 0.0021 g/s": an error that is not known is left out. `plusMinus` is the sign.
std::string rateText(const RateFigures& f, const char* plusMinus);

}  // namespace vkdose
