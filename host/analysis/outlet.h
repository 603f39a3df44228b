#pragma once
// Whether powder comes out while the coil turns: stops of the outlet, from a run's time series.

#include <map>
#include <optional>
#include <vector>

#include "host/core/csv_table.h"

namespace vkdose {

/// A line of the time series: the state at `time`, and what the coil did since the line before.
struct FlowSample {
    double time = 0;  ///< [s]
    bool turning = false;
    int dose = 0;
    double angle = 0;                 ///< of the coil, turned since the start [rad]
    double dosed = 0;                 ///< and gone through the end of a domain that repeats [kg]
    double inside = 0;                ///< canister and throat [kg]
    std::vector<double> hinges = {};  ///< by how much each body on a hinge has turned, in the order of the case [rad]
};

/// The lines of a run's timeseries.csv. Throws CaseError if a column is missing.
std::vector<FlowSample> flowSamples(const Table& series);

/// Stops of the outlet: times between two lines in which nothing was dosed, while the coil turns and more than a part
/// of the fill is inside. Successive ones are added up, over rests too. Lengths are whole sensor intervals, and a stop
/// may be up to two intervals longer than the length given here.
struct OutletFlow {
    struct Stop {
        int dose = 0;      ///< in which it began; 0: there was none
        double start = 0;  ///< [s]
        double time = 0;   ///< the coil turned [s]; rests do not count
        double turns = 0;  ///< of the coil in that time
    };
    /// Rotation until the first powder came out [s]. It counts as the coil's filling, not as a stop. None if no powder
    /// ever came out: then the whole rotation is a stop.
    std::optional<double> lead;
    Stop longest;
    std::optional<int> stoppedAt;     ///< dose in which the first stop longer than a turn began
    std::map<int, double> longestIn;  ///< of each dose with a stop: the longest within its rotation [s]
};

/// `filled` is the mass that the canister held [kg]. With the part `remaining` of it or less inside, the canister is
/// empty, not blocked. What another run had dosed before this one does not count.
OutletFlow outletFlow(const std::vector<FlowSample>& samples, double filled, double remaining = 0.01);

}  // namespace vkdose
