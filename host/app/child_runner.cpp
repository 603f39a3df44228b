#include "host/app/child_runner.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <utility>

#include "host/app/exit_code.h"
#include "host/core/error.h"
#include "host/core/output_file.h"
#include "host/vk/driver_variable.h"

namespace vkdose {

namespace {

constexpr int kMoment = 1000;              // [ms]
constexpr std::size_t kRemembered = 4096;  // bytes of what a member said

std::vector<char*> pointers(std::vector<std::string>& words) {
    std::vector<char*> list;
    for (std::string& word : words) list.push_back(word.data());
    list.push_back(nullptr);
    return list;
}

/// The user's environment; members side by side share the cores best with one thread each.
std::vector<std::string> environmentFor(int slots) {
    std::vector<std::string> variables = vk::usersEnvironment();
    const auto ofThreads = [](const std::string& v) { return v.starts_with("LP_NUM_THREADS="); };
    if (slots > 1 && std::none_of(variables.begin(), variables.end(), ofThreads))
        variables.emplace_back("LP_NUM_THREADS=0");
    return variables;
}

/// Replaces our terminal for a process: no input, no output, a pipe for error messages, and a process group of
/// its own, so that Ctrl-C on the terminal reaches it through us, once.
class Surroundings {
  public:
    explicit Surroundings(int said) {
        posix_spawn_file_actions_init(&files_);
        posix_spawn_file_actions_addopen(&files_, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
        posix_spawn_file_actions_addopen(&files_, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
        posix_spawn_file_actions_adddup2(&files_, said, STDERR_FILENO);
        posix_spawnattr_init(&attributes_);
        posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETPGROUP);
        posix_spawnattr_setpgroup(&attributes_, 0);
    }
    ~Surroundings() {
        posix_spawn_file_actions_destroy(&files_);
        posix_spawnattr_destroy(&attributes_);
    }
    Surroundings(const Surroundings&) = delete;
    Surroundings& operator=(const Surroundings&) = delete;

    posix_spawn_file_actions_t files_{};
    posix_spawnattr_t attributes_{};
};

}  // namespace

ChildRunner::~ChildRunner() {
    // An error ends the sweep, and the members that were started must end with it.
    ChildRunner::interrupt();
    while (!children_.empty()) reap(children_.begin());
}

std::vector<std::string> ChildRunner::arguments(const MemberTask& task) const {
    const std::string folder = task.folder.string();
    std::vector<std::string> words{"vkdose"};
    if (task.resume)
        words.insert(words.end(), {"resume", folder});
    else
        words.insert(words.end(),
                     {"run", folder + "/case.toml", "--out", folder, "--force", "--backend", choice_.backend});
    if (!task.resume && !task.bed) words.insert(words.end(), {"--member", std::to_string(task.number)});
    if (!choice_.device.empty()) words.insert(words.end(), {"--device", choice_.device});
    if (choice_.validation) words.emplace_back("--validation");
    words.insert(words.end(), {"--quiet", "--parent", std::to_string(getpid())});
    return words;
}

void ChildRunner::start(const MemberTask& task) {
    std::array<int, 2> ends{};
    if (pipe2(ends.data(), O_CLOEXEC) != 0) throw RunError(fmt::format("no pipe: {}", std::strerror(errno)));
    std::vector<std::string> words = arguments(task), variables = environmentFor(slots_);
    const Surroundings around(ends[1]);
    pid_t process = 0;
    // The path of the running program itself, even if its file has been replaced since.
    const int fault = posix_spawn(&process, "/proc/self/exe", &around.files_, &around.attributes_,
                                  pointers(words).data(), pointers(variables).data());
    ::close(ends[1]);
    if (fault != 0) {
        ::close(ends[0]);
        throw RunError(fmt::format("cannot start another process: {}", std::strerror(fault)));
    }
    children_.push_back({task.number, process, ends[0], "", false});
}

std::optional<MemberEnd> ChildRunner::wait() {
    std::vector<pollfd> ends;
    for (const Child& child : children_) ends.push_back({child.said, POLLIN, 0});
    if (poll(ends.data(), ends.size(), kMoment) <= 0) return std::nullopt;  // a signal ends the waiting too
    auto child = children_.begin();
    for (std::size_t i = 0; i < ends.size(); ++i, ++child) {
        if (ends[i].revents == 0) continue;
        std::array<char, 1024> buffer{};
        const ssize_t n = retried([&] { return ::read(child->said, buffer.data(), buffer.size()); });
        if (n <= 0) return reap(child);  // its end of the pipe is closed: it is gone
        child->text.append(buffer.data(), std::size_t(n));
        if (child->text.size() > kRemembered) child->text.erase(0, child->text.size() - kRemembered);
    }
    return std::nullopt;
}

MemberEnd ChildRunner::reap(std::list<Child>::iterator child) {
    int status = 0;
    while (waitpid(child->process, &status, 0) < 0 && errno == EINTR) {
    }
    ::close(child->said);
    MemberEnd end{child->number, WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status),
                  lastSaid(child->text)};
    children_.erase(child);
    return end;
}

void ChildRunner::interrupt() {
    for (Child& child : children_)
        if (!std::exchange(child.interrupted, true)) kill(child.process, SIGINT);
}

}  // namespace vkdose
