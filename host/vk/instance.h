#pragma once
// The entry to Vulkan: the loader, an instance, and the devices that it shows.

#include <volk.h>

#include <memory>
#include <string>
#include <type_traits>
#include <vector>

namespace vkdose::vk {

/// Of VK_LAYER_KHRONOS_validation on this machine.
bool validationInstalled();

struct DestroyInstance {
    void operator()(VkInstance instance) const { vkDestroyInstance(instance, nullptr); }
};
using Instance = std::unique_ptr<std::remove_pointer_t<VkInstance>, DestroyInstance>;

/// An instance of all drivers. If the loader fails as a whole, one of those drivers that work. `validation` loads the
/// validation layer with synchronisation checks. Throws DeviceError, which names the drivers that do not work, if there
/// is no loader, no driver that works, or no device.
Instance openInstance(bool validation);

/// Its devices, in an order that is the same each time. Throws DeviceError if they cannot be listed, or if there is
/// none.
std::vector<VkPhysicalDevice> devicesOf(VkInstance instance);

/// How the drivers start that the loader looks at now.
struct Start {
    bool showsDevices = false;
    std::string problem;  ///< why there are none; empty if they only find no hardware
};
/// Throws DeviceError if there is no loader.
Start startDrivers();

}  // namespace vkdose::vk
