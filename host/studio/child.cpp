#include "host/studio/child.h"

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <utility>

#include "host/core/child_process.h"
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
             const std::filesystem::path& folder, bool hears) {
    std::array<Pipe, 3> pipes;  // standard input, output and error
    for (std::size_t i = hears ? 0 : 1; i < pipes.size(); ++i) pipes[i].open();
    std::vector<std::string> words{"vkdose"};
    words.insert(words.end(), arguments.begin(), arguments.end());
    process_ =
        startChild({program, words, vk::usersEnvironment(), pipes[0].read, pipes[1].write, pipes[2].write, folder});
    in_ = std::exchange(pipes[0].write, -1);
    out_ = std::exchange(pipes[1].read, -1);
    error_ = std::exchange(pipes[2].read, -1);
    // A program that does not read holds up nobody.
    if (in_ >= 0) (void)fcntl(in_, F_SETFL, O_NONBLOCK);
}

Child::~Child() {
    for (const int end : {in_, out_, error_})
        if (end >= 0) ::close(end);
    if (process_ == 0) return;
    kill(process_, SIGINT);
    (void)waitForChild(process_);
}

void Child::interrupt() const {
    if (process_ != 0) kill(process_, SIGINT);
}

bool Child::tell(const std::string& line) const {
    const std::string text = line + "\n";
    return in_ >= 0 && ::write(in_, text.data(), text.size()) == ssize_t(text.size());
}

Ended Child::read(const std::function<void(const std::string&)>& line,
                  const std::optional<std::chrono::milliseconds>& limit, const std::atomic<bool>* stop) {
    using Clock = std::chrono::steady_clock;
    const auto begin = Clock::now();
    Ended ended;
    std::string text;
    bool out = true, error = true, stopped = false;
    while (out || error) {
        std::array<pollfd, 2> ends{{{out ? out_ : -1, POLLIN, 0}, {error ? error_ : -1, POLLIN, 0}}};
        (void)poll(ends.data(), ends.size(), kMoment);
        if (limit && Clock::now() - begin > *limit) {
            ended.late = true;
            kill(process_, SIGKILL);
        }
        if (stop != nullptr && *stop && !std::exchange(stopped, true)) interrupt();
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
