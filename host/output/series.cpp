#include "host/output/series.h"

#include <nlohmann/json.hpp>

#include "host/core/file.h"

namespace vkdose {

void writeSeries(const std::filesystem::path& file, const std::vector<SeriesFile>& files) {
    auto list = nlohmann::ordered_json::array();
    for (const SeriesFile& f : files) list.push_back({{"name", f.name}, {"time", f.time}});
    const nlohmann::ordered_json series{{"file-series-version", "1.0"}, {"files", std::move(list)}};
    replaceFile(file, series.dump(1) + "\n");
}

}  // namespace vkdose
