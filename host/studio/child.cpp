#include "host/studio/child.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>

#include "host/core/error.h"
#include "host/core/output_file.h"
#include "host/vk/driver_variable.h"

namespace vkdose::studio {

namespace {

constexpr std::size_t kRemembered = 16384;  // bytes of what it said on its standard error
constexpr std::size_t kLongest = 64 << 20;  // bytes of a line: the scene of a large case is one
constexpr int kMoment = 200;                // [ms]

std::vector<char*> pointers(std::vector<std::string>& words) {
    std::vector<char*> list;
    for (std::string& word : words) list.push_back(word.data());
    list.push_back(nullptr);
    return list;
}

/// Reads what there is; false at the end.
bool more(int file, std::string& text) {
    std::array<char, 16384> buffer{};
    const ssize_t n = retried([&] { return ::read(file, buffer.data(), buffer.size()); });
    if (n > 0) text.append(buffer.data(), std::size_t(n));
    return n > 0;
}

}  // namespace

Child::Child(const std::filesystem::path& program, const std::vector<std::string>& arguments,
             const std::filesystem::path& folder) {
    std::array<int, 2> out{}, error{};
    if (pipe2(out.data(), O_CLOEXEC) != 0) throw RunError(fmt::format("no pipe: {}", std::strerror(errno)));
    if (pipe2(error.data(), O_CLOEXEC) != 0) {
        ::close(out[0]);
        ::close(out[1]);
        throw RunError(fmt::format("no pipe: {}", std::strerror(errno)));
    }
    std::vector<std::string> words{"vkdose"}, variables = vk::usersEnvironment();
    words.insert(words.end(), arguments.begin(), arguments.end());
    posix_spawn_file_actions_t files;
    posix_spawnattr_t attributes;
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_adddup2(&files, out[1], STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&files, error[1], STDERR_FILENO);
    posix_spawn_file_actions_addchdir_np(&files, folder.c_str());
    posix_spawnattr_init(&attributes);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);  // Ctrl-C reaches it through us, once
    posix_spawnattr_setpgroup(&attributes, 0);
    const int fault = posix_spawn(&process_, program.c_str(), &files, &attributes, pointers(words).data(),
                                  pointers(variables).data());
    posix_spawn_file_actions_destroy(&files);
    posix_spawnattr_destroy(&attributes);
    ::close(out[1]);
    ::close(error[1]);
    out_ = out[0];
    error_ = error[0];
    if (fault == 0) return;
    ::close(out_);
    ::close(error_);
    throw RunError(fmt::format("cannot start another process: {}", std::strerror(fault)));
}

Child::~Child() {
    if (out_ >= 0) ::close(out_);
    if (error_ >= 0) ::close(error_);
    if (process_ == 0) return;
    kill(process_, SIGINT);
    while (waitpid(process_, nullptr, 0) < 0 && errno == EINTR) {
    }
}

void Child::interrupt() const {
    if (process_ != 0) kill(process_, SIGINT);
}

Ended Child::read(const std::function<void(const std::string&)>& line,
                  const std::optional<std::chrono::milliseconds>& limit) {
    using Clock = std::chrono::steady_clock;
    const auto begin = Clock::now();
    Ended ended;
    std::string text;
    bool out = true, error = true;
    while (out || error) {
        std::array<pollfd, 2> ends{{{out ? out_ : -1, POLLIN, 0}, {error ? error_ : -1, POLLIN, 0}}};
        (void)poll(ends.data(), ends.size(), kMoment);
        if (limit && Clock::now() - begin > *limit) kill(process_, SIGKILL);
        if (error && ends[1].revents != 0) error = more(error_, ended.error);
        if (ended.error.size() > kRemembered) ended.error.erase(0, ended.error.size() - kRemembered);
        if (!out || ends[0].revents == 0) continue;
        out = more(out_, text);
        for (std::size_t end = text.find('\n'); end != std::string::npos; end = text.find('\n')) {
            line(text.substr(0, end));
            text.erase(0, end + 1);
        }
        if (text.size() > kLongest) kill(process_, SIGKILL);
    }
    int status = 0;
    while (waitpid(process_, &status, 0) < 0 && errno == EINTR) {
    }
    process_ = 0;
    ended.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    return ended;
}

}  // namespace vkdose::studio
