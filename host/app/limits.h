#pragma once
// Limits that the shell or the system puts on this process: `ulimit -s` on stacks, `ulimit -v` on its
// address space (host/core/memory_limit.h tells of it).

#include <functional>

namespace vkdose {

/// Runs `program` so that a small limit on stacks does not reach it: in a thread with a stack of the usual size, which
/// every thread made later has too. Graphics drivers compile shaders in threads of their own and overrun small ones.
///
/// Where the address space is limited, a crash is told as what it most likely is, memory that a driver did not get, and
/// ends with the code of a device that failed. Without that limit a crash stays a crash.
int withinLimits(const std::function<int()>& program);

}  // namespace vkdose
