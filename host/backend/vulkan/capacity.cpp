#include "host/backend/vulkan/capacity.h"

#include <algorithm>
#include <limits>

#include "host/backend/vulkan/pack.h"

namespace vkdose {

DeviceRoom roomOn(const vk::Device& device) {
    const VkPhysicalDeviceLimits& limits = device.limits();
    return {device.freeMemory() / 5 * 4, limits.maxStorageBufferRange, limits.maxComputeWorkGroupCount[1]};
}

TableSizes roomOf(const World& world, const Particles& particles, const std::shared_ptr<const UserLaw>& userLaw) {
    DeviceShape unlimited;
    unlimited.range = std::numeric_limits<std::uint64_t>::max();
    return tableSizes(world, Crowd(particles), packMember(world, {}, particles), unlimited, 1, userLaw);
}

bool fit(const std::vector<TableSizes>& canisters, const DeviceRoom& room) {
    if (canisters.size() > room.members) return false;
    TableSizes all = canisters.at(0);
    for (const TableSizes& s : canisters) all.growTo(s);
    all.members = std::uint32_t(canisters.size());
    const bool numbered = std::uint64_t(all.members) * all.share <= gpu::kMostParticles;
    if (!numbered || all.largestIndex() > std::numeric_limits<std::uint32_t>::max()) return false;
    return all.allBytes() <= room.memory && all.longestBytes() <= room.range;
}

}  // namespace vkdose
