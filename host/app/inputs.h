#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace vkdose {

/// Throws UsageError if a file that a command is about to write is one that it reads.
void keepInputs(const std::vector<std::filesystem::path>& read, const std::vector<std::filesystem::path>& written);

/// Throws UsageError if the name of `file` ends in another suffix than that of `kind`, ".png" for "a PNG picture". A
/// name without a suffix will do.
void requireSuffix(const std::filesystem::path& file, const std::string& suffix, const std::string& kind);

}  // namespace vkdose
