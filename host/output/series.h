#pragma once
// The times of files that belong together, in the form that ParaView reads.

#include <filesystem>
#include <string>
#include <vector>

namespace vkdose {

inline constexpr const char* kSeriesExtension = ".series";

struct SeriesFile {
    std::string name;  ///< beside the series
    double time = 0;   ///< [s]
};

/// Replaces `file`. Its name ends in .series, and ParaView opens it in place of the files it names. Throws OutputError.
void writeSeries(const std::filesystem::path& file, const std::vector<SeriesFile>& files);

}  // namespace vkdose
