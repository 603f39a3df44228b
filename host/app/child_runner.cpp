#include "host/app/child_runner.h"

#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <utility>

#include "host/app/exit_code.h"
#include "host/core/child_process.h"
#include "host/core/output_file.h"
#include "host/vk/driver_variable.h"

namespace vkdose {

namespace {

constexpr int kMoment = 1000;              // [ms]
constexpr std::size_t kRemembered = 4096;  // bytes of what a member said

/// The user's environment; members side by side share the cores best with one thread each.
std::vector<std::string> environmentFor(int slots) {
    std::vector<std::string> variables = vk::usersEnvironment();
    const auto ofThreads = [](const std::string& v) { return v.starts_with("LP_NUM_THREADS="); };
    if (slots > 1 && std::none_of(variables.begin(), variables.end(), ofThreads))
        variables.emplace_back("LP_NUM_THREADS=0");
    return variables;
}

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
    Pipe pipe;
    pipe.open();
    // The path of the running program itself, even if its file has been replaced since.
    const pid_t process = startChild({"/proc/self/exe", arguments(task), environmentFor(slots_), -1, -1, pipe.write});
    children_.push_back({task.number, process, std::exchange(pipe.read, -1), "", false});
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
    const int code = waitForChild(child->process);
    ::close(child->said);
    MemberEnd end{child->number, code, lastSaid(child->text)};
    children_.erase(child);
    return end;
}

void ChildRunner::interrupt() {
    for (Child& child : children_)
        if (!std::exchange(child.interrupted, true)) kill(child.process, SIGINT);
}

}  // namespace vkdose
