#include "host/app/interrupt.h"

#include <sys/prctl.h>
#include <unistd.h>

#include <csignal>

namespace vkdose {

namespace {

std::atomic<bool> interrupted{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may touch lock-free atomics only");

extern "C" void onSignal(int) {
    interrupted = true;
}

}  // namespace

const std::atomic<bool>& watchInterrupts() {
    struct sigaction action {};
    action.sa_handler = onSignal;
    action.sa_flags = SA_RESETHAND | SA_RESTART;
    sigemptyset(&action.sa_mask);
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
    return interrupted;
}

void endWithParent(int parent) {
    prctl(PR_SET_PDEATHSIG, SIGINT);
    if (getppid() != parent) interrupted = true;  // it had ended before we asked
}

}  // namespace vkdose
