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

/// Cuts members into batches of at most `most` that fit the device: those of a kind together, and among them those with
/// about as many steps, so that a batch ends together. One that does not even fit alone is a batch of its own, whose
/// backend then tells what is short.
std::vector<std::vector<int>> batchesOf(std::vector<BatchMember> members, const DeviceRoom& room, std::size_t most);

}  // namespace vkdose
