#pragma once
// Times the two ways in which passes can store their vectors on a device.

#include <vector>

#include "host/vk/device.h"
#include "shaders/shared/layout.h"

namespace vkdose {

struct StoreTrial {
    /// One way of storing.
    struct Way {
        double seconds = 0;             ///< shortest of several tries, the device's work and its start [s]
        std::vector<gpu::vec4> stored;  ///< what the buffer holds in the end; the same for both
    };
    Way plain;   ///< the four numbers of a vector as they are
    Way packed;  ///< two numbers at a time, as an integer of 64 bits
};

/// Stores two vectors from each of some thousand invocations, in the one way and the other in turns. The device must
/// have 64-bit integers. Throws DeviceError if the device fails.
StoreTrial tryStores(const vk::Device& device);

/// Whether the device is faster by a tenth when it stores packed. Tried once for each device in the life of the
/// process. The choice changes no bit of a result. False without 64-bit integers.
bool storesFasterPacked(const vk::Device& device);

}  // namespace vkdose
