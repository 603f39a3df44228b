#include "host/core/folder_lock.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <thread>
#include <utility>

#include "host/core/error.h"
#include "host/core/output_file.h"

namespace vkdose {

namespace {

// A child process does not inherit the handle: it would hold the lock longer than this process.
int opened(const std::filesystem::path& folder) {
    return retried([&] { return ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC); });
}

/// Whether another process has the lock. Where the file system knows no locks, nobody has it: a run must not be
/// forbidden there.
bool isHeld(int handle) {
    return retried([&] { return ::flock(handle, LOCK_EX | LOCK_NB); }) != 0 && errno == EWOULDBLOCK;
}

}  // namespace

std::optional<FolderLock> FolderLock::take(const std::filesystem::path& folder) {
    const int handle = opened(folder);
    if (handle < 0) throw OutputError(fmt::format("cannot open {}: {}", folder.string(), std::strerror(errno)));
    FolderLock lock(handle);
    if (isHeld(handle)) return std::nullopt;
    return lock;
}

bool FolderLock::isTaken(const std::filesystem::path& folder) {
    const int handle = opened(folder);
    if (handle < 0) return false;
    const FolderLock lock(handle);
    return isHeld(handle);
}

bool FolderLock::await(const std::filesystem::path& folder, const std::function<bool()>& giveUp) {
    while (isTaken(folder)) {
        if (giveUp()) return false;
        std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
    return true;
}

FolderLock::FolderLock(FolderLock&& other) noexcept : handle_(std::exchange(other.handle_, -1)) {}

FolderLock& FolderLock::operator=(FolderLock&& other) noexcept {
    std::swap(handle_, other.handle_);
    return *this;
}

FolderLock::~FolderLock() {
    if (handle_ >= 0) ::close(handle_);
}

}  // namespace vkdose
