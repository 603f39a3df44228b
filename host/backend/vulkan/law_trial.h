#pragma once
// Tries a user's law on a device.

#include "host/model/user_law_trial.h"
#include "host/vk/device.h"

namespace vkdose {

/// As LawTrial. The answers to the same question are kept for the life of the process.
std::vector<std::vector<LawPoint>> tryLaw(const vk::DeviceChoice& device, const UserLaw& law,
                                          const std::vector<LawLoading>& loadings);

/// From now on cases of this process try their laws on the device that is chosen automatically.
void tryLawsOnDevices();

}  // namespace vkdose
