#pragma once
// The finding of a calibration in the folder of its study: calibration.json, and the draws of a search.

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "host/study/calibration_finding.h"

namespace vkdose {

inline constexpr const char* kFindingName = "calibration.json";
inline constexpr const char* kDrawsName = "powder-draws.csv";

/// The content of calibration.json, which has no draws; what is not known is null.
nlohmann::ordered_json findingJson(const CalibrationFinding& finding);

/// The draws of a search as a CSV: a column for each parameter, and a row for each draw.
std::string drawsText(const CalibrationFinding& finding);

/// Writes calibration.json, and of a search powder-draws.csv, into the folder of a sweep. Throws OutputError.
void writeFinding(const std::filesystem::path& folder, const CalibrationFinding& finding);

/// Removes both files: a search goes on in this folder and may find something else. Throws OutputError.
void forgetFinding(const std::filesystem::path& folder);

/// The finding that a folder holds, if it has a calibration.json. Throws CaseError if a file is damaged, or the
/// draws of a search are missing.
std::optional<CalibrationFinding> readFinding(const std::filesystem::path& folder);

}  // namespace vkdose
