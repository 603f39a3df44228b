#pragma once

#include <sys/resource.h>

namespace vkdose::test {

/// As long as it lives, the address space of this process is limited, but to more than any machine has.
class LimitedMemory {
  public:
    LimitedMemory() {
        getrlimit(RLIMIT_AS, &before_);
        rlimit limit = before_;
        if (limit.rlim_cur == RLIM_INFINITY) limit.rlim_cur = rlim_t(1) << 60U;
        setrlimit(RLIMIT_AS, &limit);
    }
    ~LimitedMemory() { setrlimit(RLIMIT_AS, &before_); }
    LimitedMemory(const LimitedMemory&) = delete;
    LimitedMemory& operator=(const LimitedMemory&) = delete;

  private:
    rlimit before_{};
};

}  // namespace vkdose::test
