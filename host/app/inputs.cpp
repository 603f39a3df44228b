#include "host/app/inputs.h"

#include <fmt/format.h>

#include <cctype>

#include "host/app/backends.h"
#include "host/core/file.h"

namespace vkdose {

void keepInputs(const std::vector<std::filesystem::path>& read, const std::vector<std::filesystem::path>& written) {
    if (const auto file = readAndWritten(read, written))
        throw UsageError(fmt::format(
            "{} is read by this command, and would be replaced; choose another name with --out", file->string()));
}

void requireSuffix(const std::filesystem::path& file, const std::string& suffix, const std::string& kind) {
    std::string own = file.extension().string();
    for (char& c : own) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    if (own.empty() || own == suffix) return;
    throw UsageError(
        fmt::format("--out {}: this command writes {}; give a name that ends in {}", file.string(), kind, suffix));
}

}  // namespace vkdose
