#include "host/vk/copy_bandwidth.h"

#include <algorithm>
#include <chrono>

#include "host/vk/buffer.h"
#include "host/vk/commands.h"

namespace vkdose::vk {

double copyBandwidth(const Device& device) {
    constexpr VkDeviceSize kBytes = 128ull << 20;
    constexpr int kCopies = 4, kTries = 3;
    const VkDeviceSize bytes = std::min(kBytes, VkDeviceSize(device.limits().maxStorageBufferRange) / 4 * 4);
    const Buffer from(device, "the copy's source", bytes), to(device, "the copy's target", bytes);
    double best = 0;
    for (int i = 0; i < kTries; ++i) {
        Commands commands(device);
        commands.begin();
        for (int copy = 0; copy < kCopies; ++copy) {
            commands.copy(from.handle(), 0, to.handle(), 0, bytes);
            commands.barrier();
        }
        const auto start = std::chrono::steady_clock::now();
        commands.submit();
        const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        best = std::max(best, 2.0 * kCopies * double(bytes) / seconds);
    }
    return best;
}

}  // namespace vkdose::vk
