#include "host/study/finding_file.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "host/core/error.h"
#include "host/core/file.h"

namespace vkdose {

using Json = nlohmann::ordered_json;

void writeFindingFile(const std::filesystem::path& file, const Json& finding) {
    replaceFile(file, finding.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

Json readFindingFile(const std::filesystem::path& file, const std::function<bool(const Json&)>& isWhole,
                     const std::string& what, const std::string& command) {
    if (!std::filesystem::exists(file)) return nullptr;
    try {
        Json j = Json::parse(fileContent(file).value_or(""));
        if (isWhole(j)) return j;
    } catch (const Json::exception&) {  // told below, as what is incomplete
    }
    throw CaseError(
        {{file.string(), 0, "", "", fmt::format("is not {}", what), fmt::format("run {} again to write it", command)}});
}

void removeFindings(const std::vector<std::filesystem::path>& files) {
    for (const std::filesystem::path& file : files) {
        std::error_code code;
        std::filesystem::remove(file, code);
        if (code) throw OutputError(fmt::format("cannot remove {}: {}", file.string(), code.message()));
    }
}

}  // namespace vkdose
