#pragma once
// Which files of a folder a run has written: what a new run may replace, and nothing else.

#include <filesystem>
#include <string>
#include <vector>

namespace vkdose {

/// Stands at the head of every report.
inline constexpr const char* kReportMark = "<meta name=\"generator\" content=\"vkdose\">";

/// Whether a run has begun in the folder: its time series is there.
bool holdsRun(const std::filesystem::path& folder);

/// The files there that bear the names a run gives: those of its case's frames and fields too, and halves of files that
/// a run left that was killed. Of report.html only if vkdose has written it.
std::vector<std::filesystem::path> filesOfRun(const std::filesystem::path& folder);

/// Removes `files` of them, and the folders of frames and fields if nothing else is in them. Throws OutputError.
void removeRun(const std::filesystem::path& folder, const std::vector<std::filesystem::path>& files);

}  // namespace vkdose
