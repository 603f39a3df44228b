#pragma once
// The data of a study's report, from the folder of a sweep, finished or not.

#include <filesystem>
#include <optional>
#include <vector>

#include "host/report/expected.h"
#include "host/report/run_report.h"

namespace vkdose::report {

/// Whether a folder is a sweep's.
bool isSweep(const std::filesystem::path& folder);

/// Everything that the page of a study shows, in SI: axes, points (the members of all seeds together, mean and standard
/// error), doses, and the verdicts on a table of published results if there is one. Throws CaseError if a file is
/// missing or damaged.
Json studyJson(const std::filesystem::path& folder, const std::optional<std::filesystem::path>& expected);

}  // namespace vkdose::report
