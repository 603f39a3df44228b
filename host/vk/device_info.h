#pragma once
// What a device is, whether vkdose can use it, and which one is chosen.

#include <volk.h>

#include <cstdint>
#include <string>
#include <vector>

#include "host/core/error.h"

namespace vkdose::vk {

/// The largest number of storage buffers in one binding set. A device that allows fewer per stage is refused before
/// anything is built on it. The passes of a step bind all tables, and no other set is larger.
extern const std::uint32_t kStorageBuffers;

struct DeviceInfo {
    int index = 0;
    std::string name;
    std::string type;    ///< "discrete GPU", "integrated GPU", "virtual GPU", "CPU", "other"
    std::string driver;  ///< name and version, as "llvmpipe: Mesa 22.3.6 (LLVM 15.0.6)"; before Vulkan 1.2 a number
    std::string apiVersion;
    unsigned subgroupSize = 0;
    std::uint64_t maxStorageBufferRange = 0;  ///< [bytes]
    unsigned timestampBits = 0;               ///< of the compute queue's clock; 0: it keeps none
    bool usable = false;
    std::string reason;  ///< why not usable

    bool isGpu() const { return type.find("GPU") != std::string::npos; }
};

/// Queue family with compute; -1 if none.
int computeFamily(VkPhysicalDevice physical);

/// In the order of `devices`, which give the indices. Throws DeviceError without a device.
std::vector<DeviceInfo> describeAll(const std::vector<VkPhysicalDevice>& devices);

/// The usable devices of the best kind among `devices`. The automatic choice takes the first of them.
std::vector<DeviceInfo> bestOf(const std::vector<DeviceInfo>& devices);

/// The device that `wanted` names as DeviceChoice::name does. Throws DeviceError that lists what there is, if none of
/// `infos` fits or the one that does cannot be used.
DeviceInfo choose(const std::vector<DeviceInfo>& infos, const std::string& wanted);

/// The device on which a run was made that is to go on, by its full name. If it is not there, the one that has the same
/// name without a last part in parentheses: lavapipe's names its compiler's version and changes with an update. Throws
/// DeviceError as `choose` does, and says how to go on with another.
DeviceInfo chooseAgain(const std::vector<DeviceInfo>& infos, const std::string& name);

}  // namespace vkdose::vk
