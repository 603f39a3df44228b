#pragma once
// Which members of a sweep share the device at the same time.

#include <vector>

#include "host/backend/vulkan/capacity.h"

namespace vkdose {

struct BatchMember {
    int number = 0;
    double steps = 0;   ///< it is expected to make
    TableSizes tables;  ///< roomOf
};

/// Cuts members into batches of at most `most` that fit the device. A batch holds members of one kind, as far as
/// possible with similar numbers of steps, so that they end together. A member that does not fit even alone gets a
/// batch of its own, and its backend then says what is short.
std::vector<std::vector<int>> batchesOf(std::vector<BatchMember> members, const DeviceRoom& room, std::size_t most);

}  // namespace vkdose
