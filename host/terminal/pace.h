#pragma once
// When to draw again, so that drawing costs no more than a share of the time.

#include <algorithm>

namespace vkdose::terminal {

class Pace {
  public:
    /// `share`: of all time, for drawing at most; `interval`: between two drawings at least [s].
    Pace(double share, double interval) : share_(share), interval_(interval) {}

    /// Whether it is time at `now` [s].
    bool due(double now) const { return now >= next_; }

    /// Tells that drawing took from `begin` to `end` [s]. After it comes a break so long that the two together are to
    /// the drawing as 1 to `share`.
    void drew(double begin, double end) { next_ = std::max(begin + interval_, begin + (end - begin) / share_); }

  private:
    double share_, interval_;
    double next_ = 0;
};

}  // namespace vkdose::terminal
