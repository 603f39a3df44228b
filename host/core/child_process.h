#pragma once
// A program as another process.

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

namespace vkdose {

/// Both ends are closed with it, unless they are taken out. A process that is started inherits neither.
struct Pipe {
    int read = -1, write = -1;

    Pipe() = default;
    Pipe(const Pipe&) = delete;
    Pipe& operator=(const Pipe&) = delete;
    ~Pipe();
    /// Throws RunError if the system has no more.
    void open();
};

/// What a process is started with.
struct ChildStart {
    std::filesystem::path program;
    std::vector<std::string> words;      ///< its arguments, its name first
    std::vector<std::string> variables;  ///< its environment, "NAME=VALUE" each
    int in = -1;                         ///< file descriptor of its standard input; -1: it has none
    int out = -1;                        ///< likewise of its standard output; -1: that is thrown away
    int error = -1;                      ///< likewise of its standard error
    std::filesystem::path folder = {};   ///< that it works in; empty: ours
};

/// Starts it in a process group of its own, so that Ctrl-C on the terminal reaches it through us,
/// once. Throws RunError if the system starts no more processes.
pid_t startChild(ChildStart start);

/// Waits for its end. Gives its exit code, or 128 and the signal that ended it.
int waitForChild(pid_t process);

}  // namespace vkdose
