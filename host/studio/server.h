#pragma once
// The workbench: a server for the browser of this machine. It has no engine of its own. What it is asked it has the
// program do, in processes, and its page shows what they say.

#include <atomic>
#include <filesystem>
#include <functional>
#include <string>

namespace vkdose::studio {

struct ServerOptions {
    std::filesystem::path folder;  ///< that it works in
    std::filesystem::path first;   ///< a case that a new one begins as
    int port = 0;                  ///< 0: any that is free
    /// The program that does the work: this one, even if its file has been replaced since it began.
    std::filesystem::path program = "/proc/self/exe";
};

/// Serves until `stop` is set. Calls `listening` with the address once it can be opened. Throws RunError if there is no
/// such folder or the port cannot be had.
void serve(const ServerOptions& options, const std::function<void(const std::string& address)>& listening,
           const std::atomic<bool>& stop);

}  // namespace vkdose::studio
