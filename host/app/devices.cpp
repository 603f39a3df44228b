#include <fmt/format.h>

#include "host/app/commands.h"
#include "host/app/exit_code.h"
#include "host/core/error.h"
#include "host/vk/device.h"

namespace vkdose {

int devicesCommand() {
    const std::vector<vk::DeviceInfo> devices = vk::listDevices();
    if (devices.empty()) {
        throw DeviceError(
            "no Vulkan device found; on Debian the package mesa-vulkan-drivers brings one that runs on the CPU");
    }
    bool any = false;
    fmt::print("{:>2}  {:<44} {:<15} {:<7} {:>8}  {:>10}  {}\n", "", "device", "type", "Vulkan", "subgroup",
               "buffer MiB", "driver");
    for (const vk::DeviceInfo& d : devices) {
        fmt::print("{:>2}  {:<44} {:<15} {:<7} {:>8}  {:>10}  {}\n", d.index, d.name, d.type, d.apiVersion,
                   d.subgroupSize, d.maxStorageBufferRange >> 20, d.driver);
        if (!d.usable) fmt::print("    not usable: {}\n", d.reason);
        any = any || d.usable;
    }
    return any ? kOk : kDeviceError;
}

}  // namespace vkdose
