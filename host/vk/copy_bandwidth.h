#pragma once

#include "host/vk/device.h"

namespace vkdose::vk {

/// Bandwidth of the device itself in copying one buffer to another, read and write counted, the best of a few tries
/// [bytes/s]. Takes about 0.1 s on a processor. Of buffers that no cache of a processor holds.
double copyBandwidth(const Device& device);

}  // namespace vkdose::vk
