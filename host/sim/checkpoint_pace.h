#pragma once
// When a checkpoint is due by the clock of the wall.

#include <algorithm>

namespace vkdose {

/// The first one comes early, so that a run that is killed soon can go on. The later the run, the rarer they become, up
/// to the interval of the case, and all of them together take little of the run's time. All times are readings of one
/// clock [s]. It decides when states are stored, and nothing about the run itself.
class CheckpointPace {
  public:
    static constexpr double kFirst = 10;         ///< after the start [s]
    static constexpr double kTimesTheWork = 20;  ///< how many times longer an interval is than a checkpoint takes

    /// `longest`: the interval of the case [s]; 0: none is due by the clock.
    CheckpointPace(double longest, double start)
        : longest_(longest), start_(start), last_(start), interval_(std::min(longest, kFirst)) {}

    bool due(double now) const { return longest_ > 0 && now - last_ >= interval_; }

    /// A checkpoint that was begun at `begun` has been stored at `now`.
    void stored(double begun, double now) {
        last_ = now;
        interval_ = std::min(longest_, std::max({kFirst, now - start_, kTimesTheWork * (now - begun)}));
    }

  private:
    double longest_, start_, last_, interval_;
};

}  // namespace vkdose
