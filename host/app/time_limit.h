#pragma once
// The wall time that a sweep may take (--for).

#include <functional>
#include <string>

namespace vkdose {

class TimeLimit {
  public:
    /// Tells the time on a clock that never goes back [s].
    using Now = std::function<double()>;

    /// Begins now. `text` is a time with its unit: "480s", "8min", "2h". Throws UsageError if it is not.
    explicit TimeLimit(std::string text, Now now = wallClock());

    static Now wallClock();

    /// What of a time of so many seconds is kept for the members to end their calls and to write down their states [s].
    static double keptBack(double seconds);

    /// Whether the members are to stop.
    bool isUp() const { return now_() >= stop_; }
    const std::string& text() const { return text_; }

  private:
    std::string text_;
    Now now_;
    double stop_;
};

}  // namespace vkdose
