#pragma once
// Times on the device's own clock, between commands of one submission.

#include <volk.h>

#include <cstdint>
#include <vector>

#include "host/vk/commands.h"
#include "host/vk/device.h"

namespace vkdose::vk {

class Timestamps {
  public:
    /// Whether the device keeps time for its compute queue.
    static bool available(const Device& device) { return device.info().timestampBits > 0; }

    /// Room for `capacity` times. Needs `available`.
    Timestamps(const Device& device, std::uint32_t capacity);
    ~Timestamps();
    Timestamps(const Timestamps&) = delete;
    Timestamps& operator=(const Timestamps&) = delete;

    /// Before the first `mark` of a recording.
    void reset(Commands& commands);
    /// Notes the time at which everything recorded before is done.
    void mark(Commands& commands);

    /// Durations between successive marks, once the submission is done [s].
    std::vector<double> durations() const;

  private:
    const Device& device_;
    std::uint32_t capacity_, used_ = 0;
    VkQueryPool pool_ = VK_NULL_HANDLE;
};

}  // namespace vkdose::vk
