#pragma once
// The runs of a workbench. Each is a process of the program that prints its events; they are kept, so that a page that
// comes later sees all of them. A run goes on when its page is closed.

#include <chrono>
#include <condition_variable>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "host/studio/child.h"

namespace vkdose::studio {

class Runs {
  public:
    Runs(std::filesystem::path program, std::filesystem::path folder)
        : program_(std::move(program)), folder_(std::move(folder)) {}
    /// Interrupts what still runs, which leaves its checkpoint, and waits for it.
    ~Runs();
    Runs(const Runs&) = delete;
    Runs& operator=(const Runs&) = delete;

    /// Starts `vkdose ARGUMENTS` as the run of this output folder, relative to the workbench's. Throws RunError if that
    /// run is going on, if kMost are, or if the system starts no more processes.
    void start(const std::string& name, const std::vector<std::string>& arguments);
    static constexpr std::size_t kMost = 8;

    /// As Ctrl-C does. Returns false if no such run is going on.
    bool stop(const std::string& name);
    /// Gives it a line on its standard input. Returns false likewise, or if it takes none now.
    bool tell(const std::string& name, const std::string& line);

    struct State {
        bool known = false, running = false;
        int code = 0;       ///< its exit code, once it has ended
        std::string error;  ///< what it said on its standard error, once it has ended
        std::vector<std::string> events;
        std::size_t next = 0;  ///< the number of the first event after these
    };
    /// The events of a run from number `from` on. If there is none it waits for one, or for the end of the run, no
    /// longer than `patience`.
    State eventsOf(const std::string& name, std::size_t from, std::chrono::milliseconds patience);

    /// The runs that go on.
    std::vector<std::string> running();

  private:
    struct Run {
        std::unique_ptr<Child> child;
        std::thread reader;
        std::vector<std::string> events;
        bool running = true;
        Ended ended;
    };
    void read(Run& run);

    std::filesystem::path program_, folder_;
    std::mutex mutex_;
    std::condition_variable changed_;
    std::map<std::string, std::unique_ptr<Run>> runs_;
};

}  // namespace vkdose::studio
