#include "host/app/time_limit.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "host/app/measures.h"

namespace vkdose {

TimeLimit::TimeLimit(std::string text, Now now) : text_(std::move(text)), now_(std::move(now)) {
    const double seconds = measureOf(Measure::WallTime, "--for", text_, "480s, 8min or 2h");
    stop_ = now_() + seconds - keptBack(seconds);
}

TimeLimit::Now TimeLimit::wallClock() {
    return [] { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); };
}

double TimeLimit::keptBack(double seconds) {
    return std::clamp(seconds / 20, std::min(2.0, seconds / 2), 30.0);
}

}  // namespace vkdose
