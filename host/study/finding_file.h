#pragma once
// Files in the folder of a sweep that keep what a command found.

#include <filesystem>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace vkdose {

/// Writes a finding into its file; texts that are no UTF-8 are mended. Throws OutputError.
void writeFindingFile(const std::filesystem::path& file, const nlohmann::ordered_json& finding);

/// The content of such a file; null without it. Throws CaseError if it is damaged: `isWhole` says no, or looks for what
/// is not there. `what` it should hold ("the finding of a design"), and the `command` that writes it, are for the
/// message.
nlohmann::ordered_json readFindingFile(const std::filesystem::path& file,
                                       const std::function<bool(const nlohmann::ordered_json&)>& isWhole,
                                       const std::string& what, const std::string& command);

/// Removes such files, whether they are there or not. Throws OutputError.
void removeFindings(const std::vector<std::filesystem::path>& files);

}  // namespace vkdose
