#pragma once
// Limits that the shell or the system puts on this process: `ulimit -s` on stacks, `ulimit -v` on its address space.

#include <functional>
#include <string>

namespace vkdose {

/// Runs `program` so that a small limit on stacks does not reach it: in a thread with a stack of the usual size, which
/// every thread made later has too. Graphics drivers compile shaders in threads of their own and overrun small ones.
///
/// Where the address space is limited, a crash is told as what it most likely is, memory that a driver did not get, and
/// ends with the code of a device that failed. Without that limit a crash stays a crash.
int withinLimits(const std::function<int()>& program);

/// "; the memory of this process is limited to 400 MiB of address space (ulimit -v)"; empty without such a limit.
std::string memoryLimitText();

}  // namespace vkdose
