#pragma once

#include <filesystem>

#include "host/model/case.h"
#include "host/sim/frame.h"

namespace vkdose {

/// The end of a run as a frame without contacts, from particles.csv and summary.json of its output folder. Particles
/// that had been dosed by then are not in it. Throws OutputError if one of the files is missing or cannot be read.
Frame readEndState(const std::filesystem::path& folder, const Case& c);

}  // namespace vkdose
