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
    double angle = 0;   ///< of the coil, turned since the start [rad]
    double dosed = 0;   ///< [kg]
    double inside = 0;  ///< canister and throat [kg]
};

/// The lines of a run's timeseries.csv. Throws CaseError if a column is missing.
std::vector<FlowSample> flowSamples(const Table& series);

/// While the coil turns and more than a part of the fill is inside, the time between two lines in which nothing was
/// dosed; on end, over rests too. So lengths are whole sensor intervals, and a stop is up to two of them longer than it
/// is told.
struct OutletFlow {
    struct Stop {
        int dose = 0;      ///< in which it began; 0: there was none
        double start = 0;  ///< [s]
        double time = 0;   ///< the coil turned [s]; rests do not count
        double turns = 0;  ///< of the coil in that time
    };
    /// Rotation until something had come out [s], which is the coil's filling and no stop; none if nothing ever did:
    /// then all of it is one.
    std::optional<double> lead;
    Stop longest;
    std::optional<int> stoppedAt;     ///< dose in which the first stop longer than a turn began
    std::map<int, double> longestIn;  ///< of each dose with a stop: the longest within its rotation [s]
};

/// `filled` is what the canister held [kg]; with the part `remaining` of it or less inside, it is empty, not blocked.
OutletFlow outletFlow(const std::vector<FlowSample>& samples, double filled, double remaining = 0.01);

}  // namespace vkdose
