#pragma once
// How much work goes into one submission.

#include <chrono>
#include <cstdint>

namespace vkdose {

/// Counts steps, or other work that comes in equal pieces. Long submissions starve the display and trip watchdogs,
/// short ones waste time on the fence. So the number of pieces is adapted until a submission takes a time between two
/// bounds.
class Pace {
  public:
    Pace(std::uint32_t first, std::uint32_t most) : count_(first), most_(most) {}

    std::uint32_t count() const { return count_; }
    void begin() { start_ = Clock::now(); }
    /// `count` pieces have been made since `begin`.
    void end(std::uint32_t count) {
        constexpr double kShortest = 0.05, kLongest = 0.25;  // [s]
        const double seconds = std::chrono::duration<double>(Clock::now() - start_).count();
        if (count == count_ && seconds < kShortest && count_ < most_) count_ *= 2;
        if (seconds > kLongest && count_ > 1) count_ /= 2;
    }

  private:
    using Clock = std::chrono::steady_clock;
    std::uint32_t count_, most_;
    Clock::time_point start_{};
};

}  // namespace vkdose
