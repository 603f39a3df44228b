#pragma once
// The data of a page about several runs: their figures side by side, their curves in the same charts, and their cases
// key by key.

#include <filesystem>
#include <vector>

#include "host/report/run_report.h"

namespace vkdose::report {

/// Short names for the runs: those of their folders, or the paths as given where these are the same.
std::vector<std::string> runLabels(const std::vector<std::filesystem::path>& folders);

/// The cases key by key, [{"key", "values", "same"}, ...], those that differ first; then in the order of the first
/// case. A value is as TOML has it, "" where a case lacks the key. Names and reasons are left out. `cases` are resolved
/// cases.
Json comparedCases(const std::vector<std::string>& cases);

/// The data of the page, in SI. Throws CaseError like `runJson`.
Json runsJson(const std::vector<std::filesystem::path>& folders);

}  // namespace vkdose::report
