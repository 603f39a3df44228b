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

/// For `particles`, of which it takes the number of lavapipe's threads. Throws UsageError if a device is asked for on
/// the reference backend, DeviceError if there is none.
std::unique_ptr<Backend> makeBackend(const BackendChoice& choice, std::size_t particles);

/// Backends of canisters that share a device (makeVulkanEnsemble), of `particles` all together.
std::vector<std::unique_ptr<Backend>> makeEnsemble(const BackendChoice& choice, std::size_t members,
                                                   std::size_t particles);

/// The backend and device a description (Backend::description) stands for; `device` of `choice` wins, if given.
BackendChoice sameBackend(const std::string& description, const BackendChoice& choice);

/// The choice for one of several processes that share a machine, counted from 0. Where nothing says which device, they
/// take turns at the GPUs of the kind that is taken by itself; the processor is one device, whatever drivers it has.
BackendChoice choiceOfRank(const BackendChoice& choice, const std::vector<vk::DeviceInfo>& devices, int localRank);

/// The findings of the Vulkan validation layer, if it was asked for; its absence counts as a finding.
std::vector<std::string> validationFindings(const BackendChoice& choice, const Backend& backend);

/// Prints that on stderr; false if there is any.
bool validationClean(const BackendChoice& choice, const Backend& backend);
bool validationClean(const BackendChoice& choice, const vk::Device& device);

}  // namespace vkdose
