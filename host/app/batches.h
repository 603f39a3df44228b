#pragma once
// Which members of a sweep share the device, and how many of them at a time.

#include <cstddef>
#include <vector>

#include "host/backend/vulkan/capacity.h"

namespace vkdose {

struct BatchMember {
    int number = 0;
    double steps = 0;   ///< it is expected to make
    TableSizes tables;  ///< roomOf
};

/// Members that go through the same tables, each as soon as there is a place for it.
struct Batch {
    std::size_t places = 0;
    std::vector<int> members;  ///< numbers, in the order in which they begin

    bool operator==(const Batch&) const = default;
};

/// Makes batches with at most `most` places, which fit the device whichever of the batch's members have them. The
/// members of a batch are of one kind and need about as much room: the largest tables are at most twice the smallest.
/// Those with the most steps begin first, so that the places empty together in the end. A member that does not fit even
/// alone has a place all the same, and its backend then says what is short.
std::vector<Batch> batchesOf(std::vector<BatchMember> members, const DeviceRoom& room, std::size_t most);

}  // namespace vkdose
