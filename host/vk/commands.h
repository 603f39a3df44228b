#pragma once
// One primary command buffer, recorded, submitted and waited for, once or again and again.

#include <volk.h>

#include <cstddef>
#include <cstdint>

#include "host/vk/device.h"

namespace vkdose::vk {

class Commands {
  public:
    explicit Commands(const Device& device);
    ~Commands();
    Commands(const Commands&) = delete;
    Commands& operator=(const Commands&) = delete;

    void begin();
    /// Ends the recording, submits it and waits for the device. Without a `begin` since then, submits it again.
    void submit();

    /// Every write of a dispatch or copy before is visible to every dispatch, indirect argument or copy after.
    void barrier();
    /// Likewise, and to reads and writes of the host. A submission ends with it, so that later ones see what it wrote.
    void hostBarrier();
    /// Workgroups.
    void dispatch(std::uint32_t x, std::uint32_t y, std::uint32_t z);
    /// Workgroup counts from three consecutive words of `buffer` at `offset`.
    void dispatchIndirect(VkBuffer buffer, VkDeviceSize offset);
    void copy(VkBuffer from, VkDeviceSize fromOffset, VkBuffer to, VkDeviceSize toOffset, VkDeviceSize size);

    VkCommandBuffer handle() const { return commands_; }

  private:
    Commands(const Device& device, std::nullptr_t) : device_(device) {}
    void memoryBarrier(VkPipelineStageFlags from, VkAccessFlags wrote, VkPipelineStageFlags to, VkAccessFlags reads);

    const Device& device_;
    VkCommandBuffer commands_ = VK_NULL_HANDLE;
    VkFence fence_ = VK_NULL_HANDLE;
    bool recording_ = false;
};

}  // namespace vkdose::vk
