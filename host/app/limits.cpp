#include "host/app/limits.h"

#include <pthread.h>
#include <sys/resource.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstring>
#include <exception>

#include "host/core/exit_code.h"
#include "host/core/memory_limit.h"

namespace vkdose {

namespace {

constexpr std::size_t kStack = 8UL << 20;  // [bytes], the usual limit

std::array<char, 512> lastWords{};  // made beforehand, because a handler may not format

extern "C" void onCrash(int) {
    [[maybe_unused]] const ssize_t told = write(STDERR_FILENO, lastWords.data(), std::strlen(lastWords.data()));
    _exit(kDeviceError);
}

void explainCrashes() {
    const std::string limit = memoryLimitText();
    if (limit.empty()) return;
    const std::string words = "vkdose: crashed, most likely for want of memory in a graphics driver" + limit +
                              ": raise the limit, use fewer particles or --backend reference\n";
    words.copy(lastWords.data(), lastWords.size() - 1);
    for (const int number : {SIGSEGV, SIGBUS, SIGABRT}) {
        struct sigaction action {};
        action.sa_handler = onCrash;
        sigemptyset(&action.sa_mask);
        sigaction(number, &action, nullptr);
    }
}

struct Work {
    const std::function<int()>* program = nullptr;
    int code = 0;
};

extern "C" void* work(void* given) {
    auto* w = static_cast<Work*>(given);
    w->code = (*w->program)();
    return nullptr;
}

}  // namespace

int withinLimits(const std::function<int()>& program) {
    explainCrashes();
    rlimit stack{};
    if (getrlimit(RLIMIT_STACK, &stack) != 0 || stack.rlim_cur >= kStack) return program();
    pthread_attr_t attributes;
    Work w{&program};
    pthread_t thread{};
    pthread_attr_init(&attributes);
    pthread_attr_setstacksize(&attributes, kStack);
    pthread_setattr_default_np(&attributes);
    const bool started = pthread_create(&thread, &attributes, work, &w) == 0;
    pthread_attr_destroy(&attributes);
    if (!started) return program();
    pthread_join(thread, nullptr);
    return w.code;
}

}  // namespace vkdose
