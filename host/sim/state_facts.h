#pragma once
// What the state of a run says of it, without a case to restore it by.

#include <cstdint>
#include <vector>

#include "host/core/record.h"

namespace vkdose {

struct StateFacts {
    std::vector<double> radii;  ///< of all particles [m]
    std::uint64_t step = 0;     ///< steps it had made
    std::uint64_t active = 0;   ///< particles in the canister and in the throat
    bool settled = false;       ///< its settling was over
    bool dosing = false;        ///< its first dose had begun
    bool sinceSample = false;   ///< it made steps after its last sample
};

/// From the runner's part of a checkpoint. Throws RecordError if it is none.
StateFacts factsOf(const Record& run);

}  // namespace vkdose
