#pragma once
// Instance, device and queue. Knows no physics.

#include <volk.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "host/core/error.h"
#include "host/vk/device_info.h"

namespace vkdose::vk {

/// Throws DeviceError naming the call and the result unless `result` is VK_SUCCESS.
void check(VkResult result, const char* call);

struct DeviceChoice {
    /// Empty: automatic (discrete, then integrated, then virtual, then CPU). Else an index of listDevices() or a
    /// case-insensitive part of a device's name.
    std::string name;
    bool validation = false;  ///< load the validation layer with synchronisation checks, if it is installed
};

/// Every device the Vulkan loader shows. Throws DeviceError if there is no loader or no driver.
std::vector<DeviceInfo> listDevices();

struct ValidationMessages;

class Device {
  public:
    explicit Device(const DeviceChoice& choice);
    ~Device();
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;

    VkDevice handle() const { return device_; }
    VkPhysicalDevice physical() const { return physical_; }
    VkQueue queue() const { return queue_; }
    VkCommandPool pool() const { return pool_; }
    const VkPhysicalDeviceLimits& limits() const { return limits_; }
    const DeviceInfo& info() const { return info_; }
    /// Whether shaders may use 64-bit integers; enabled where the device has them.
    bool hasInt64() const { return int64_; }
    /// Whether shaders may reach buffers by address; enabled where the device can.
    bool hasAddresses() const { return addresses_; }
    /// Of a buffer that was made for it. Needs hasAddresses.
    VkDeviceAddress addressOf(VkBuffer buffer) const;
    /// The longest buffer that can be allocated, and reached whole by its address [bytes]. Without addresses, the
    /// longest that can be bound.
    VkDeviceSize longestBuffer() const;

    /// Free memory of the device's largest heap [bytes]. The driver says how much other programs leave
    /// (VK_EXT_memory_budget). Where it does not say, the whole heap counts as free.
    std::uint64_t freeMemory() const;

    /// The memory types among `typeBits` that have all of `wanted` and a heap of at least `size` bytes; best first.
    std::vector<std::uint32_t> memoryTypes(std::uint32_t typeBits, VkMemoryPropertyFlags wanted,
                                           VkDeviceSize size) const;
    VkMemoryPropertyFlags memoryFlags(std::uint32_t type) const { return memory_.memoryTypes[type].propertyFlags; }

    /// Messages of the validation layer since creation (warnings and errors).
    std::vector<std::string> validationMessages() const;
    /// True if validation was asked for and the layer is there.
    bool validated() const { return messenger_ != VK_NULL_HANDLE; }

  private:
    Device();
    void createInstance(bool validation);
    void createDevice(std::uint32_t family, std::uint32_t apiVersion);
    bool hasExtension(const char* name) const;

    VkInstance instance_ = VK_NULL_HANDLE;
    VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
    VkPhysicalDevice physical_ = VK_NULL_HANDLE;
    VkDevice device_ = VK_NULL_HANDLE;
    VkQueue queue_ = VK_NULL_HANDLE;
    VkCommandPool pool_ = VK_NULL_HANDLE;
    VkPhysicalDeviceLimits limits_{};
    VkPhysicalDeviceMemoryProperties memory_{};
    DeviceInfo info_;
    bool int64_ = false, addresses_ = false;
    PFN_vkGetBufferDeviceAddress addressOf_ = nullptr;
    std::unique_ptr<ValidationMessages> messages_;
};

}  // namespace vkdose::vk
