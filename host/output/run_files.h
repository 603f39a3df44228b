#pragma once
// The files of a folder that a run has written: a new run may replace these and nothing else.

#include <filesystem>
#include <string>
#include <vector>

namespace vkdose {

/// This text stands at the head of every report.
inline constexpr const char* kReportMark = "<meta name=\"generator\" content=\"vkdose\">";

/// Whether a run has begun in the folder. Its time series is the sign.
bool holdsRun(const std::filesystem::path& folder);

/// The files there that bear the names a run gives. These include the files of its case's frames and fields, and halves
/// of files left by a run that was killed. report.html is among them only if vkdose has written it.
std::vector<std::filesystem::path> filesOfRun(const std::filesystem::path& folder);

/// Removes `files`, then the folders of frames and fields if nothing else is in them. Throws OutputError.
void removeRun(const std::filesystem::path& folder, const std::vector<std::filesystem::path>& files);

}  // namespace vkdose
