#pragma once
// summary.json: what was run, on what, and what came out, for scripts.

#include <string>

#include "host/output/run_history.h"

namespace vkdose {

/// The summary as indented JSON. Units are in the names; a figure that does not exist is null.
std::string summaryJson(const Case& c, const RunResult& result, const std::string& backend,
                        const RunHistory& history = {});

}  // namespace vkdose
