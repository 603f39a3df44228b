#include "host/core/memory_limit.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include <cerrno>
#include <cstring>

namespace vkdose {

std::string memoryLimitText() {
    rlimit limit{};
    if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return "";
    return fmt::format("; the memory of this process is limited to {} MiB of address space (ulimit -v)",
                       limit.rlim_cur >> 20);
}

std::string faultText(int why) {
    return std::strerror(why) + (why == ENOMEM ? memoryLimitText() : "");
}

}  // namespace vkdose
