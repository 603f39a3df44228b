#pragma once
// The Vulkan backend: the passes of shaders/pass on any device with Vulkan 1.1 compute.

#include <memory>

#include "host/backend/backend.h"
#include "host/vk/device.h"

namespace vkdose {

struct VulkanOptions {
    vk::DeviceChoice device;
    /// How particle state is read: through texel-buffer views where the device's limit allows, or always from storage
    /// buffers.
    enum class Reads { Automatic, Storage } reads = Reads::Automatic;
    std::uint32_t workgroup = 64;  ///< invocations; a power of two, at most 128
    std::uint32_t batch = 0;       ///< steps per submission; 0: adapted to the device. Changes no bit of the result.
};

/// Throws DeviceError if there is no such device or it cannot compute.
std::unique_ptr<Backend> makeVulkanBackend(const VulkanOptions& options);
inline std::unique_ptr<Backend> makeVulkanBackend(const vk::DeviceChoice& device) {
    return makeVulkanBackend(VulkanOptions{device});
}

/// Messages the validation layer gave to a backend made by makeVulkanBackend; `validated` tells whether it listened.
struct ValidationReport {
    bool validated = false;
    std::vector<std::string> messages;
};
ValidationReport validationReport(const Backend& backend);

}  // namespace vkdose
