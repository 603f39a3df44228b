#pragma once

#include <string>

namespace vkdose {

/// "; the memory of this process is limited to 400 MiB of address space (ulimit -v)"; empty without such a limit.
std::string memoryLimitText();

}  // namespace vkdose
