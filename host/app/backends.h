#pragma once
// Backends for the commands.

#include <memory>
#include <string>
#include <vector>

#include "host/play/backend_choice.h"
#include "host/vk/device.h"

namespace vkdose {

/// openBackend in a process of our own: the number of `particles` decides how many threads lavapipe uses and how long
/// its vectors are, which this sets in the environment.
std::unique_ptr<Backend> makeBackend(const BackendChoice& choice, std::size_t particles);

/// openEnsemble likewise; `particles` is the number in all canisters together.
VulkanEnsemble makeEnsemble(const BackendChoice& choice, std::size_t particles);

/// The backend and device a description (Backend::description) stands for; `device` of `choice` wins, if given. Throws
/// DeviceError if that device is not there (vk::chooseAgain).
BackendChoice sameBackend(const std::string& description, const BackendChoice& choice);

/// Throws DeviceError if a run that was made on what `description` tells would go on on a backend of another kind
/// (vk::chooseAgain), and the choice names no device.
void requireSameKind(const std::string& description, const BackendChoice& choice, const Backend& backend);

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
