#pragma once
// How many canisters a device holds at once.

#include <cstdint>
#include <vector>

#include "host/backend/vulkan/tables.h"
#include "host/vk/device.h"

namespace vkdose {

/// The limits of a device on the canisters that share it.
struct DeviceRoom {
    std::uint64_t memory = 0;   ///< for tables [bytes]
    std::uint64_t range = 0;    ///< longest buffer that can be bound [bytes]
    std::uint32_t members = 0;  ///< rows of workgroups in a dispatch
};

/// The present limits of the device. A fifth of the free memory is left for pipelines, staging and other programs.
DeviceRoom roomOn(const vk::Device& device);

/// The room that one canister takes on a device without limits. Throws RunError if it needs more than 32-bit indices.
TableSizes roomOf(const World& world, const Particles& particles,
                  const std::shared_ptr<const UserLaw>& userLaw = nullptr);

/// Whether all these canisters fit the device at once. They must be able to share tables.
bool fit(const std::vector<TableSizes>& canisters, const DeviceRoom& room);

}  // namespace vkdose
