#pragma once
// The history of a run beyond its doses, from its files: how the powder flowed, and where it arched.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "host/analysis/blockage.h"
#include "host/analysis/cycles.h"
#include "host/analysis/mass_rate.h"
#include "host/analysis/outlet.h"
#include "host/output/frames.h"
#include "host/output/measured.h"
#include "host/sim/runner.h"

namespace vkdose {

/// The void over the coil in the frame nearest to the end of a dose.
struct DoseArch {
    int dose = 0;
    double time = 0;  ///< of the frame [s]
    std::optional<Arch> arch;
};

/// Arches at the ends of those complete ones of `doses` that have a frame within half a frame interval of their end.
/// None without a coil in a canister. Throws OutputError if a frame cannot be read.
std::vector<DoseArch> archesAtDoseEnds(const Frames& frames, const Case& c, const std::vector<Dose>& doses);

/// The lines of the time series in this folder. Empty without a time series.
std::vector<FlowSample> flowIn(const std::filesystem::path& folder);

struct RunHistory {
    OutletFlow outlet;
    MassRate rate;
    Cycles cycles;
    std::vector<DoseArch> arches;
    std::string origin;  ///< the state of another run that it began with, in words; empty: none
    std::vector<MeasureResult> measures;
};

/// From the time series and the frames in a run's output folder. Throws OutputError as above.
RunHistory historyOf(const std::filesystem::path& folder, const Case& c, const RunResult& result);

}  // namespace vkdose
