#pragma once
// Decides when to draw again, so that drawing costs no more than a share of the time.

#include <algorithm>

namespace vkdose::terminal {

class Pace {
  public:
    /// `share`: largest fraction of the time that drawing may take; `interval`: least time between two drawings [s].
    Pace(double share, double interval) : share_(share), interval_(interval) {}

    /// Whether it is time to draw at `now` [s].
    bool due(double now) const { return now >= next_; }

    /// Tells that drawing took from `begin` to `end` [s]. The pause after it is chosen so that drawing takes at most
    /// the fraction `share` of the elapsed time.
    void drew(double begin, double end) { next_ = std::max(begin + interval_, begin + (end - begin) / share_); }

  private:
    double share_, interval_;
    double next_ = 0;
};

}  // namespace vkdose::terminal
