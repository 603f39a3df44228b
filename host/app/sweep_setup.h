#pragma once
// What `vkdose sweep` and `vkdose calibrate` begin with.

#include <filesystem>

#include "host/app/commands.h"

namespace vkdose {

/// Members at once. Throws DeviceError if there is no device to run them on.
int jobsFor(const SweepOptions& options);

/// The folder of the sweep: --out, or out/<name of the study's file>.
std::filesystem::path sweepFolder(const SweepOptions& options);

}  // namespace vkdose
