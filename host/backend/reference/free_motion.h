#pragma once
// How bodies that move freely go on in a step.

#include <cstdint>
#include <vector>

#include "host/backend/reference/forces.h"

namespace vkdose::reference {

/// Kicks and moves the world's bodies that move freely by one step, `step` steps after the load. `loads` are those of
/// this step.
void moveFreeBodies(const World& world, const Loads& loads, std::uint64_t step, const std::vector<BodyClock>& clocks,
                    std::vector<FreeBody>& bodies);

/// For Backend::snapshot, and back. Throws RecordError if the record has other bodies.
void saveFreeBodies(const std::vector<FreeBody>& bodies, Record& record);
void restoreFreeBodies(const Record& record, std::vector<FreeBody>& bodies);

}  // namespace vkdose::reference
