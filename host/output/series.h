#pragma once
// The times of files that belong together, as ParaView wants to be told.

#include <filesystem>
#include <string>
#include <vector>

namespace vkdose {

inline constexpr const char* kSeriesExtension = ".series";

struct SeriesFile {
    std::string name;  ///< beside the series
    double time = 0;   ///< [s]
};

/// Replaces `file`, which ends in .series and is opened in place of the files it names. Throws OutputError.
void writeSeries(const std::filesystem::path& file, const std::vector<SeriesFile>& files);

}  // namespace vkdose
