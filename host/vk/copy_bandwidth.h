#pragma once

#include "host/vk/device.h"

namespace vkdose::vk {

/// Bandwidth with which the device copies one buffer to another [bytes/s]. Bytes read and bytes written both count, and
/// the best of a few tries is returned. The buffers are too large for any cache of a processor. Takes about 0.1 s on a
/// processor.
double copyBandwidth(const Device& device);

}  // namespace vkdose::vk
