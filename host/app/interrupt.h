#pragma once

#include <atomic>

namespace vkdose {

/// A clock that a signal handler may read [s]; only differences of its readings count.
using SignalClock = double (*)();

/// The system's monotonic clock.
double monotonicSeconds();

/// The same request to end may come as several signals: timeout(1) sends one to its child and one to the group of its
/// child, and a launcher of many processes does likewise. So signals count as one request as long as this after the
/// first [s].
inline constexpr double kSameRequest = 1;

/// Turns Ctrl-C, a polite termination and the closing of the terminal into a flag that the run looks at between calls
/// of the backend. A second Ctrl-C or termination, later than kSameRequest after the first, ends the program at once.
const std::atomic<bool>& watchInterrupts(SignalClock clock = monotonicSeconds);

/// Sets that flag, as a first Ctrl-C does.
void interruptSelf();

/// From now on this process is interrupted, as by Ctrl-C, when the process `parent` that started it ends. Call after
/// watchInterrupts.
void endWithParent(int parent);

}  // namespace vkdose
