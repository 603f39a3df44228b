#include "host/play/backend_choice.h"

#include <fmt/format.h>

#include "host/backend/reference/reference.h"
#include "host/core/error.h"

namespace vkdose {

std::unique_ptr<Backend> openBackend(const BackendChoice& choice) {
    if (choice.backend == "reference") {
        if (!choice.device.empty())
            throw UsageError("a device (--device) is for the vulkan backend; the reference runs on the CPU");
        return makeReferenceBackend();
    }
    return openEnsemble(choice).enter();
}

VulkanEnsemble openEnsemble(const BackendChoice& choice) {
    if (choice.backend == "reference") throw UsageError("an ensemble needs a device; the reference runs one canister");
    if (choice.backend != "vulkan")
        throw UsageError(fmt::format("there is no backend \"{}\"; give vulkan or reference", choice.backend));
    VulkanOptions options;
    options.device.name = choice.device;
    options.device.validation = choice.validation;
    return VulkanEnsemble(options);
}

}  // namespace vkdose
