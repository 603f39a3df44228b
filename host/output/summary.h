#pragma once
// summary.json: the case, the backend and the results of a run, for scripts.

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "host/output/run_history.h"

namespace vkdose {

/// The summary as indented JSON. Units are in the names; a figure that does not exist is null.
std::string summaryJson(const Case& c, const RunResult& result, const std::string& backend,
                        const RunHistory& history = {});

/// The summary in a run's output folder, if it is there and whole.
std::optional<nlohmann::ordered_json> readSummary(const std::filesystem::path& folder);

}  // namespace vkdose
