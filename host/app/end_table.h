#pragma once
// The table at the end of a run.

#include <string>

#include "host/sim/runner.h"

namespace vkdose {

/// Doses beside the closed form, their statistics, the ledger, the speed, why the run ended.
std::string reportText(const Case& c, const RunResult& result, const std::string& backend);

}  // namespace vkdose
