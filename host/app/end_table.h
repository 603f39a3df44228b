#pragma once
// The table at the end of a run.

#include <string>

#include "host/analysis/cycles.h"
#include "host/analysis/mass_rate.h"
#include "host/sim/runner.h"

namespace vkdose {

/// Doses beside the closed form, their statistics, the ledger, the speed, why the run ended.
std::string reportText(const Case& c, const RunResult& result, const std::string& backend);

/// A line with the mass rate of a feeder: a run of one dose, or one whose doses have no closed form. Empty of other
/// runs, and with too few windows.
std::string rateLine(const RunResult& result, const MassRate& rate);
/// The same with the mass of its cycles.
std::string cycleLine(const RunResult& result, const Cycles& cycles);

}  // namespace vkdose
