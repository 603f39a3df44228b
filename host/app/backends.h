#pragma once
// The only place that names concrete backends.

#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "host/backend/backend.h"
#include "host/vk/device.h"

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

/// Makes the chosen backend. The number of `particles` decides how many threads lavapipe uses. Throws UsageError if a
/// device is asked for on the reference backend, and DeviceError if there is no device.
std::unique_ptr<Backend> makeBackend(const BackendChoice& choice, std::size_t particles);

/// Makes the backends of canisters that share a device (makeVulkanEnsemble); `particles` is the number in all of them
/// together.
std::vector<std::unique_ptr<Backend>> makeEnsemble(const BackendChoice& choice, std::size_t members,
                                                   std::size_t particles);

/// The backend and device a description (Backend::description) stands for; `device` of `choice` wins, if given.
BackendChoice sameBackend(const std::string& description, const BackendChoice& choice);

/// The choice for one of several processes that share a machine; `localRank` counts them from 0. If the choice names no
/// device, the processes take turns at the GPUs of the kind that the automatic choice prefers. The processor counts as
/// one device, however many drivers it has.
BackendChoice choiceOfRank(const BackendChoice& choice, const std::vector<vk::DeviceInfo>& devices, int localRank);

/// The findings of the Vulkan validation layer, if it was asked for; its absence counts as a finding.
std::vector<std::string> validationFindings(const BackendChoice& choice, const Backend& backend);

/// Prints that on stderr; false if there is any.
bool validationClean(const BackendChoice& choice, const Backend& backend);
bool validationClean(const BackendChoice& choice, const vk::Device& device);

}  // namespace vkdose
