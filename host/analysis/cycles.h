#pragma once
// The mass of each cycle of a feeder: of each turn of its drive, pocket of its wheel, or stroke of its tray.

#include <string>
#include <vector>

#include "host/analysis/steady.h"
#include "host/analysis/turning_flow.h"
#include "host/core/columns.h"
#include "host/model/case.h"

namespace vkdose {

/// A body on a hinge between two stops, which tips over and comes back as its load says.
struct TippingBody {
    std::size_t hinge = 0;  ///< which of the bodies on a hinge
    double far = 0;         ///< from its stop at the start to the other one [rad]
};

/// What a cycle of a device is.
struct CycleRule {
    std::string what;  ///< "turn of the drive", "pocket of wheel", "stroke of tray", "tip of bucket"; empty: nothing
                       ///< repeats itself
    TurningFlow::By by = TurningFlow::By::Time;
    double length = 0;                               ///< of one: time [s], or angle of the drive [rad]
    double period = 0;                               ///< its shortest time [s]
    double interval = 0;                             ///< of the sensors [s]
    std::optional<double> from = std::nullopt;       ///< of countedFrom
    std::optional<TippingBody> tips = std::nullopt;  ///< a cycle is from tip to tip, however long that takes
};
/// The passing of a pocket if the case tells a wheel's pockets, else a turn of the drive, else the longest period of a
/// body, else the tip of the first body on a hinge that starts at one of its two stops.
CycleRule cycleRuleOf(const Case& c);

/// In the output folder of a run.
inline constexpr const char* kCyclesName = "cycles.csv";

struct CycleMass {
    int number = 0;             ///< from 1
    double start = 0, end = 0;  ///< simulated time [s]
    double mass = 0;            ///< that came out in it [kg]
    double left = 0;            ///< in the device at its start [kg]
};
inline constexpr auto kCycleColumns = columns(
    column<&CycleMass::number>("cycle", "1", "Number of the cycle, from 1."),
    column<&CycleMass::start>("start_time_s", "s", "Simulated time at which it began."),
    column<&CycleMass::end>("end_time_s", "s", "Simulated time at which it ended."),
    column<&CycleMass::mass>("mass_kg", "kg", "Mass that came out in it; of a drive while that turned forward."),
    column<&CycleMass::left>("left_kg", "kg", "Mass that was in the device at its start, throat included."));

struct Cycles : SteadySeries {
    std::string what;             ///< of CycleRule
    std::vector<CycleMass> list;  ///< in order; empty if the sensors cannot tell the mass of one

    /// When the steady part begins [s]; NaN without one.
    double steadyTime() const;
};

/// From the lines of a run's time series, while the drive turns forward; of a run without doses from all lines. The
/// mass is known at the ends of sensor intervals alone: a cycle must be kFewestRateIntervals long, or whole intervals.
Cycles cyclesOf(const std::vector<FlowSample>& samples, const CycleRule& rule);

/// "0.402 g ± 0.0021 g": an error that is not known is left out. `plusMinus` is the sign.
std::string cycleText(const SeriesFigures& f, const char* plusMinus);

using CycleFigure = NamedFigure<Cycles>;
extern const std::span<const CycleFigure> kCycleFigures;
/// Under this name a target of a calibration has them: "cycle.steady_kg".
inline constexpr const char* kCycleName = "cycle";

}  // namespace vkdose
