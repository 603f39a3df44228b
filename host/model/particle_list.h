#pragma once

#include <filesystem>
#include <vector>

#include "host/core/error.h"
#include "host/model/particles.h"

namespace vkdose {

/// Reads particles from a CSV in SI units with the header x,y,z,r and optionally vx,vy,vz and wx,wy,wz (in any order).
/// The particles.csv of a run is read too; only its active particles are taken.
/// Every fault, with the file and its line, is appended to `faults`; after 20 the rest is only counted.
Particles readParticleList(const std::filesystem::path& file, std::vector<Diagnostic>& faults);

}  // namespace vkdose
