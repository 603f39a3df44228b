#include "host/vk/commands.h"

namespace vkdose::vk {

namespace {
/// What a submission does to memory, and what the commands after a barrier, or a later submission, may do.
constexpr VkPipelineStageFlags kWork = VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_TRANSFER_BIT;
constexpr VkAccessFlags kWrites = VK_ACCESS_SHADER_WRITE_BIT | VK_ACCESS_TRANSFER_WRITE_BIT;
constexpr VkPipelineStageFlags kUses = kWork | VK_PIPELINE_STAGE_DRAW_INDIRECT_BIT;
constexpr VkAccessFlags kUsed =
    kWrites | VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_TRANSFER_READ_BIT | VK_ACCESS_INDIRECT_COMMAND_READ_BIT;
}  // namespace

Commands::Commands(const Device& device) : Commands(device, nullptr) {
    VkCommandBufferAllocateInfo allocate{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO, nullptr, device.pool(),
                                         VK_COMMAND_BUFFER_LEVEL_PRIMARY, 1};
    check(vkAllocateCommandBuffers(device.handle(), &allocate, &commands_), "vkAllocateCommandBuffers");
    VkFenceCreateInfo fence{VK_STRUCTURE_TYPE_FENCE_CREATE_INFO, nullptr, 0};
    check(vkCreateFence(device.handle(), &fence, nullptr, &fence_), "vkCreateFence");
}

Commands::~Commands() {
    vkDestroyFence(device_.handle(), fence_, nullptr);
    if (commands_ != VK_NULL_HANDLE) vkFreeCommandBuffers(device_.handle(), device_.pool(), 1, &commands_);
}

void Commands::begin() {
    VkCommandBufferBeginInfo info{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO, nullptr, 0, nullptr};
    check(vkBeginCommandBuffer(commands_, &info), "vkBeginCommandBuffer");
    recording_ = true;
}

void Commands::submit() {
    if (recording_) check(vkEndCommandBuffer(commands_), "vkEndCommandBuffer");
    recording_ = false;
    VkSubmitInfo info{};
    info.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
    info.commandBufferCount = 1;
    info.pCommandBuffers = &commands_;
    check(vkQueueSubmit(device_.queue(), 1, &info, fence_), "vkQueueSubmit");
    constexpr std::uint64_t kMinute = 60'000'000'000ull;
    VkResult waited = VK_TIMEOUT;
    while (waited == VK_TIMEOUT) waited = vkWaitForFences(device_.handle(), 1, &fence_, VK_TRUE, kMinute);
    check(waited, "vkWaitForFences");
    check(vkResetFences(device_.handle(), 1, &fence_), "vkResetFences");
}

void Commands::memoryBarrier(VkPipelineStageFlags from, VkAccessFlags wrote, VkPipelineStageFlags to,
                             VkAccessFlags reads) {
    VkMemoryBarrier memory{VK_STRUCTURE_TYPE_MEMORY_BARRIER, nullptr, wrote, reads};
    vkCmdPipelineBarrier(commands_, from, to, 0, 1, &memory, 0, nullptr, 0, nullptr);
}

void Commands::barrier() {
    memoryBarrier(kWork, kWrites, kUses, kUsed);
}

void Commands::hostBarrier() {
    memoryBarrier(kWork, kWrites, kUses | VK_PIPELINE_STAGE_HOST_BIT,
                  kUsed | VK_ACCESS_HOST_READ_BIT | VK_ACCESS_HOST_WRITE_BIT);
}

void Commands::dispatch(std::uint32_t x, std::uint32_t y, std::uint32_t z) {
    vkCmdDispatch(commands_, x, y, z);
}

void Commands::dispatchIndirect(VkBuffer buffer, VkDeviceSize offset) {
    vkCmdDispatchIndirect(commands_, buffer, offset);
}

void Commands::copy(VkBuffer from, VkDeviceSize fromOffset, VkBuffer to, VkDeviceSize toOffset, VkDeviceSize size) {
    VkBufferCopy region{fromOffset, toOffset, size};
    vkCmdCopyBuffer(commands_, from, to, 1, &region);
}

}  // namespace vkdose::vk
