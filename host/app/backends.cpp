#include "host/app/backends.h"

#include "host/backend/reference/reference.h"
#include "host/backend/vulkan/vulkan.h"

namespace vkdose {

std::unique_ptr<Backend> makeBackend(const BackendChoice& choice) {
    if (choice.backend == "reference") {
        if (!choice.device.empty())
            throw UsageError("--device is for the vulkan backend; the reference runs on the CPU");
        return makeReferenceBackend();
    }
    vk::DeviceChoice device;
    device.name = choice.device;
    device.validation = choice.validation;
    return makeVulkanBackend(device);
}

}  // namespace vkdose
