#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "host/core/error.h"
#include "host/model/particles.h"

namespace vkdose {

/// A powder that a list may name.
struct ListedPowder {
    std::string name;
    int material = kFirstPowder;
};

/// Reads particles from a CSV in SI units with the header x,y,z,r and optionally vx,vy,vz, wx,wy,wz and powder (in any
/// order). The particles.csv of a run is read too; only its active particles are taken. The column powder names one of
/// `powders`; where there are several, it must be there. Columns may be named by `properties` of a user's law too;
/// those that are not there are NaN.
/// Every fault, with the file and its line, is appended to `faults`; after 20 the rest is only counted.
Particles readParticleList(const std::filesystem::path& file, std::vector<Diagnostic>& faults,
                           const std::vector<ListedPowder>& powders = {},
                           const std::vector<std::string>& properties = {});

}  // namespace vkdose
