#pragma once
// The element tests of a case ([[measure]]) on a run that is over: their figures, from the files of the run.

#include <filesystem>
#include <string>
#include <vector>

#include "host/sim/runner.h"

namespace vkdose {

struct MeasuredFigure {
    std::string name;  ///< its key in summary.json, with its unit: "angle_deg"
    double value = 0;  ///< NaN where there is none
};

struct MeasureResult {
    std::string name;  ///< of the [[measure]]
    std::string kind;  ///< "angle_of_repose"
    std::vector<MeasuredFigure> figures;
    std::string why;  ///< in place of figures, the reason that there are none
};

/// The figures of all measures of a case, in its order. `folder` holds the run's time series and frames; its end state
/// is that of `result`. Throws OutputError if a frame cannot be read.
std::vector<MeasureResult> measuresOf(const std::filesystem::path& folder, const Case& c, const RunResult& result);

/// Lines for the end of a run: one for each measure, indented by the width of the other lines' first word.
std::string measureText(const std::vector<MeasureResult>& results);

}  // namespace vkdose
