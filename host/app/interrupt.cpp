#include "host/app/interrupt.h"

#include <fcntl.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <ctime>
#include <limits>

namespace vkdose {

namespace {

std::atomic<bool> interrupted{false};
std::atomic<double> firstRequest{std::numeric_limits<double>::infinity()};  // when it came [s]
std::atomic<SignalClock> requestClock{monotonicSeconds};
bool outputIsTerminal = false, errorIsTerminal = false;  // as it is when the watch begins
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<double>::is_always_lock_free &&
                  std::atomic<SignalClock>::is_always_lock_free,
              "a signal handler may touch lock-free atomics only");

extern "C" void onSignal(int number) {
    const int before = errno;
    const double now = requestClock.load()();
    double first = std::numeric_limits<double>::infinity();
    firstRequest.compare_exchange_strong(first, now);  // `first` is then what was there before
    interrupted = true;
    if (now - first > kSameRequest) {
        std::signal(number, SIG_DFL);
        raise(number);  // it ends the program when this handler returns, because until then it is held back
    }
    errno = before;
}

/// The terminal is closed, so output that would go to it is discarded from now on.
extern "C" void onHangup(int) {
    const int before = errno, nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
    if (outputIsTerminal) dup2(nowhere, STDOUT_FILENO);
    if (errorIsTerminal) dup2(nowhere, STDERR_FILENO);
    close(nowhere);
    errno = before;
    interrupted = true;
}

}  // namespace

double monotonicSeconds() {
    timespec now{};
    clock_gettime(CLOCK_MONOTONIC, &now);
    return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
}

const std::atomic<bool>& watchInterrupts(SignalClock clock) {
    requestClock = clock;
    struct sigaction action {};
    action.sa_handler = onSignal;
    action.sa_flags = SA_RESTART;
    sigemptyset(&action.sa_mask);
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
    // Closing a terminal sends this signal more than once, so a second one does not end the program at once. Under
    // nohup it stays ignored.
    struct sigaction before {};
    sigaction(SIGHUP, nullptr, &before);
    if (before.sa_handler != SIG_IGN) {
        outputIsTerminal = isatty(STDOUT_FILENO) == 1;
        errorIsTerminal = isatty(STDERR_FILENO) == 1;
        action.sa_handler = onHangup;
        action.sa_flags = SA_RESTART;
        sigaction(SIGHUP, &action, nullptr);
    }
    return interrupted;
}

void interruptSelf() {
    interrupted = true;
}

void endWithParent(int parent) {
    prctl(PR_SET_PDEATHSIG, SIGINT);
    if (getppid() != parent) interrupted = true;  // it had ended before we asked
}

}  // namespace vkdose
