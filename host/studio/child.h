#pragma once
// The program itself as another process, whose lines are read while it runs. A crash of it does not end the workbench.

#include <sys/types.h>

#include <atomic>
#include <chrono>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace vkdose::studio {

struct Ended {
    int code = 0;       ///< its exit code; 128 and the signal if one ended it
    bool late = false;  ///< it was ended because it took longer than it may
    std::string error;  ///< what it said on its standard error, at most the last 16 KiB
};

class Child {
  public:
    /// Starts the program with these arguments in a folder; with `hears` it can be told lines. Throws RunError if the
    /// system starts no more processes.
    Child(const std::filesystem::path& program, const std::vector<std::string>& arguments,
          const std::filesystem::path& folder, bool hears = false);
    ~Child();
    Child(const Child&) = delete;
    Child& operator=(const Child&) = delete;

    /// Calls `line` for each line of its standard output until it has ended. Call once. With a limit it is killed after
    /// so long, and when `stop` comes true it is interrupted.
    Ended read(const std::function<void(const std::string&)>& line,
               const std::optional<std::chrono::milliseconds>& limit = {}, const std::atomic<bool>* stop = nullptr);
    /// As Ctrl-C does. May be called from another thread.
    void interrupt() const;
    /// Gives it a line on its standard input. Returns false if it takes none now. May be called from another thread.
    bool tell(const std::string& line) const;

  private:
    pid_t process_ = 0;
    int in_ = -1, out_ = -1, error_ = -1;
};

}  // namespace vkdose::studio
