#include "host/vk/timestamps.h"

#include <cassert>

namespace vkdose::vk {

Timestamps::Timestamps(const Device& device, std::uint32_t capacity) : device_(device), capacity_(capacity) {
    VkQueryPoolCreateInfo create{};
    create.sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO;
    create.queryType = VK_QUERY_TYPE_TIMESTAMP;
    create.queryCount = capacity;
    check(vkCreateQueryPool(device.handle(), &create, nullptr, &pool_), "vkCreateQueryPool");
}

Timestamps::~Timestamps() {
    vkDestroyQueryPool(device_.handle(), pool_, nullptr);
}

void Timestamps::reset(Commands& commands) {
    vkCmdResetQueryPool(commands.handle(), pool_, 0, capacity_);
    used_ = 0;
}

void Timestamps::mark(Commands& commands) {
    assert(used_ < capacity_);
    vkCmdWriteTimestamp(commands.handle(), VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, pool_, used_++);
}

std::vector<double> Timestamps::durations() const {
    std::vector<std::uint64_t> ticks(used_);
    if (used_ < 2) return {};
    check(vkGetQueryPoolResults(device_.handle(), pool_, 0, used_, ticks.size() * sizeof ticks[0], ticks.data(),
                                sizeof ticks[0], VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT),
          "vkGetQueryPoolResults");
    // Bits beyond the valid ones are undefined, and the counter may wrap between two marks.
    const unsigned bits = device_.info().timestampBits;
    const std::uint64_t mask = bits >= 64 ? ~0ull : (1ull << bits) - 1;
    std::vector<double> seconds;
    for (std::size_t i = 1; i < ticks.size(); ++i)
        seconds.push_back(double((ticks[i] - ticks[i - 1]) & mask) * double(device_.limits().timestampPeriod) * 1e-9);
    return seconds;
}

}  // namespace vkdose::vk
