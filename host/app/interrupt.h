#pragma once

#include <atomic>

namespace vkdose {

/// Turns Ctrl-C, a polite termination and the closing of the terminal into a flag that the run looks at between calls
/// of the backend. A second Ctrl-C ends the program at once.
const std::atomic<bool>& watchInterrupts();

/// Sets that flag, as a first Ctrl-C does.
void interruptSelf();

/// From now on this process is interrupted, as by Ctrl-C, when the process `parent` that started it ends. Call after
/// watchInterrupts.
void endWithParent(int parent);

}  // namespace vkdose
