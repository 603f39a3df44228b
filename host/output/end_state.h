#pragma once

#include <filesystem>

#include "host/model/case.h"
#include "host/sim/frame.h"

namespace vkdose {

/// The end of a run, of its output folder's particles.csv and summary.json, as a frame without contacts; what had been
/// dosed by then is not among its particles. Throws OutputError if one of the files is missing or cannot be read.
Frame readEndState(const std::filesystem::path& folder, const Case& c);

}  // namespace vkdose
