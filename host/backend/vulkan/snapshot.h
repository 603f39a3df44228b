#pragma once
// The device's state as a record, and back. The neighbour rows are not stored: a restored load starts with rows that
// hold what touched, and the rebuild that opens every load carries these contacts' histories into the full rows.

#include "host/backend/vulkan/passes.h"
#include "host/core/record.h"

namespace vkdose {

/// State of the first `particles` slots, read from half `source`. The device must be idle, and sensed since its last
/// step (the sensors' accumulators are not stored).
void saveState(const Passes& passes, std::size_t particles, std::uint32_t source, Record& record);

/// Writes it into half 0 of freshly loaded passes. Throws RecordError if it does not fit them.
void restoreState(Passes& passes, std::size_t particles, const Record& record);

}  // namespace vkdose
