#include "host/bench/copies.h"

#include <fmt/format.h>
#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <new>
#include <stdexcept>

#include "host/core/error.h"

namespace vkdose::bench {

namespace {

/// Memory that the processes share: a barrier, and a row of figures for each copy.
class Shared {
  public:
    Shared(int copies, int repeats) : bytes_(kHead + sizeof(double) * std::size_t(copies) * std::size_t(repeats)) {
        memory_ = mmap(nullptr, bytes_, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
        if (memory_ == MAP_FAILED) throw std::bad_alloc();
        pthread_barrierattr_t shared;
        pthread_barrierattr_init(&shared);
        pthread_barrierattr_setpshared(&shared, PTHREAD_PROCESS_SHARED);
        pthread_barrier_init(barrier(), &shared, unsigned(copies));
        pthread_barrierattr_destroy(&shared);
    }
    // The barrier is unmapped with its memory. Destroying it would wait for a copy that died in it.
    ~Shared() { munmap(memory_, bytes_); }
    Shared(const Shared&) = delete;
    Shared& operator=(const Shared&) = delete;

    pthread_barrier_t* barrier() const { return static_cast<pthread_barrier_t*>(memory_); }
    double* figures() const { return reinterpret_cast<double*>(static_cast<char*>(memory_) + kHead); }

  private:
    static constexpr std::size_t kHead = (sizeof(pthread_barrier_t) + 63) / 64 * 64;
    std::size_t bytes_;
    void* memory_;
};

/// Pins this process to the `copy`th of the processors that it may use.
void pin(int copy) {
    cpu_set_t allowed;
    if (sched_getaffinity(0, sizeof allowed, &allowed) != 0) return;
    int nth = copy % std::max(1, CPU_COUNT(&allowed));
    for (int cpu = 0; cpu < CPU_SETSIZE; ++cpu) {
        if (!CPU_ISSET(cpu, &allowed) || nth-- > 0) continue;
        cpu_set_t one;
        CPU_ZERO(&one);
        CPU_SET(cpu, &one);
        sched_setaffinity(0, sizeof one, &one);
        return;
    }
}

/// The life of a copy. It does not return, so that no object of the caller's is destroyed twice.
[[noreturn]] void live(int copy, int repeats, const Shared& shared,
                       const std::function<std::vector<double>(const Meet&)>& work) {
    int status = 1;
    try {
        std::signal(SIGINT, SIG_DFL);
        pin(copy);
        setenv("LP_NUM_THREADS", "0", 0);
        const std::vector<double> figures = work([&] { pthread_barrier_wait(shared.barrier()); });
        if (figures.size() != std::size_t(repeats)) throw std::logic_error("a copy gives a figure for each repeat");
        std::copy(figures.begin(), figures.end(), shared.figures() + std::ptrdiff_t(copy) * repeats);
        status = 0;
    } catch (const std::exception& e) {
        std::fputs(fmt::format("vkdose: copy {}: {}\n", copy + 1, e.what()).c_str(), stderr);
    }
    std::fflush(stdout);
    _exit(status);
}

/// Whether all copies ended well. When one fails the others are ended, because they may be waiting for it.
bool waitForAll(std::vector<pid_t> copies) {
    bool well = true;
    while (!copies.empty()) {
        int status = 0;
        const pid_t ended = waitpid(-1, &status, 0);
        if (ended < 0) {
            if (errno == EINTR) continue;
            return false;
        }
        copies.erase(std::remove(copies.begin(), copies.end(), ended), copies.end());
        if (well && !(WIFEXITED(status) && WEXITSTATUS(status) == 0)) {
            well = false;
            for (const pid_t copy : copies) kill(copy, SIGKILL);
        }
    }
    return well;
}

}  // namespace

std::vector<double> sumOfCopies(int copies, int repeats, const std::function<std::vector<double>(const Meet&)>& work) {
    const Shared shared(copies, repeats);
    std::fflush(stdout);  // otherwise every copy prints it again
    std::vector<pid_t> started;
    for (int copy = 0; copy < copies; ++copy) {
        const pid_t id = fork();
        if (id == 0) live(copy, repeats, shared, work);
        if (id > 0) started.push_back(id);
    }
    if (started.size() < std::size_t(copies))
        for (const pid_t copy : started) kill(copy, SIGKILL);
    if (!waitForAll(started) || started.size() < std::size_t(copies))
        throw DeviceError(fmt::format("one of the {} copies failed and said why", copies));
    std::vector<double> sums(std::size_t(repeats), 0.0);
    for (int i = 0; i < copies * repeats; ++i) sums[std::size_t(i % repeats)] += shared.figures()[i];
    return sums;
}

}  // namespace vkdose::bench
