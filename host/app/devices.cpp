#include <fmt/format.h>

#include "host/app/commands.h"
#include "host/app/exit_code.h"
#include "host/app/tell.h"
#include "host/core/printable.h"
#include "host/vk/device.h"
#include "host/vk/drivers.h"

namespace vkdose {

int devicesCommand() {
    const std::vector<vk::DeviceInfo> devices = vk::listDevices();
    bool any = false;
    tell("{:>2}  {:<44} {:<15} {:<7} {:>8}  {:>10}  {}\n", "", "device", "type", "Vulkan", "subgroup", "buffer MiB",
         "driver");
    for (const vk::DeviceInfo& d : devices) {
        tell("{:>2}  {:<44} {:<15} {:<7} {:>8}  {:>10}  {}\n", d.index, d.name, d.type, d.apiVersion, d.subgroupSize,
             d.maxStorageBufferRange >> 20, d.driver);
        if (!d.usable) tell("    not usable: {}\n", d.reason);
        any = any || d.usable;
    }
    for (const vk::BrokenDriver& d : vk::tryDrivers().broken)
        tell("driver {} cannot be used: {}\n", printable(d.file.string()), d.problem);
    return any ? kOk : kDeviceError;
}

}  // namespace vkdose
