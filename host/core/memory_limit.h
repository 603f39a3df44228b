#pragma once

#include <string>

namespace vkdose {

/// "; the memory of this process is limited to 400 MiB of address space (ulimit -v)"; empty without such a limit.
std::string memoryLimitText();

/// What a number of errno means, and the limit if it is want of memory.
std::string faultText(int why);

}  // namespace vkdose
