#pragma once
// A file that a key of a case or of a study names.

#include <filesystem>
#include <string>

#include "host/model/case_reader.h"

namespace vkdose {

/// Whether the file is there and may be opened. If not, that is a fault of the key at `path`.
bool requireFile(CaseReader& reader, const std::string& path, const std::filesystem::path& file,
                 const std::string& remedy);

}  // namespace vkdose
