#include "host/studio/child.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>

#include "host/core/child_process.h"
#include "host/core/error.h"
#include "host/core/output_file.h"
#include "host/vk/driver_variable.h"

namespace vkdose::studio {

namespace {

constexpr std::size_t kRemembered = 16384;  // bytes of what it said on its standard error
constexpr std::size_t kLongest = 64 << 20;  // bytes of a line: the scene of a large case is one
constexpr int kMoment = 200;                // [ms]

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
    std::vector<std::string> words{"vkdose"};
    words.insert(words.end(), arguments.begin(), arguments.end());
    out_ = out[0];
    error_ = error[0];
    try {
        process_ = startChild({program, words, vk::usersEnvironment(), out[1], error[1], folder});
    } catch (const RunError&) {
        for (const int end : {out[0], out[1], error[0], error[1]}) ::close(end);
        throw;
    }
    ::close(out[1]);
    ::close(error[1]);
}

Child::~Child() {
    if (out_ >= 0) ::close(out_);
    if (error_ >= 0) ::close(error_);
    if (process_ == 0) return;
    kill(process_, SIGINT);
    (void)waitForChild(process_);
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
    ended.code = waitForChild(process_);
    process_ = 0;
    return ended;
}

}  // namespace vkdose::studio
