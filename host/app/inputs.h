#pragma once

#include <filesystem>
#include <vector>

namespace vkdose {

/// Throws UsageError if a file that a command is about to write is one that it reads.
void keepInputs(const std::vector<std::filesystem::path>& read, const std::vector<std::filesystem::path>& written);

}  // namespace vkdose
