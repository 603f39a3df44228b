#pragma once
// The finding of a design, as people see it: `vkdose design` prints it, the file design.json in the study's folder
// keeps it, and the report of the study shows it.

#include <cstdint>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "host/study/front_search.h"
#include "host/study/study.h"

namespace vkdose {

inline constexpr const char* kDesignName = "design.json";

/// "rate.steady_kg_s largest, at least 0.005"
std::string goalText(const CalibrationAim& aim, const CalibrationTarget& goal);

/// The content of design.json; what is not known is null.
nlohmann::ordered_json designJson(const Study& study, const FrontResult& result,
                                  const std::vector<std::uint64_t>& confirmingSeeds);

/// The content of design.json in a folder; null without the file. Throws CaseError if it is damaged.
nlohmann::ordered_json readDesign(const std::filesystem::path& folder);

/// The case of a point of the front, numbered from 1, in the folder of the study.
std::filesystem::path designCase(const std::filesystem::path& folder, std::size_t number);

/// design.json and all cases that a design may leave in the folder, whether they are there or not.
std::vector<std::filesystem::path> designFiles(const std::filesystem::path& folder);

/// Removes design.json and the cases: a search goes on in this folder and may find others. Throws OutputError.
void forgetDesign(const std::filesystem::path& folder);

}  // namespace vkdose
