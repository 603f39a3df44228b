#include "host/app/inputs.h"

#include <fmt/format.h>

#include "host/app/backends.h"
#include "host/core/file.h"

namespace vkdose {

void keepInputs(const std::vector<std::filesystem::path>& read, const std::vector<std::filesystem::path>& written) {
    if (const auto file = readAndWritten(read, written))
        throw UsageError(fmt::format(
            "{} is read by this command, and would be replaced; choose another name with --out", file->string()));
}

}  // namespace vkdose
