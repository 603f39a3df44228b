#pragma once
// Concrete backends by their names.

#include <memory>
#include <stdexcept>
#include <string>

#include "host/backend/backend.h"
#include "host/backend/vulkan/vulkan.h"
#include "host/model/case.h"

namespace vkdose {

/// Options that make no sense together.
class UsageError : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

struct BackendChoice {
    std::string backend = "vulkan";  ///< or "reference"
    std::string device;              ///< index or part of a name; empty: automatic
    bool validation = false;         ///< Vulkan validation layer
};

/// Makes the chosen backend. Throws UsageError if there is no backend of this name or if a device is asked for on the
/// reference backend, and DeviceError if there is no device.
std::unique_ptr<Backend> openBackend(const BackendChoice& choice);

/// An ensemble for backends of canisters that share a device. Throws as above.
VulkanEnsemble openEnsemble(const BackendChoice& choice);

}  // namespace vkdose
