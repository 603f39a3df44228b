#include "host/core/folder_lock.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "host/core/error.h"

namespace vkdose {

namespace {

// A child process does not inherit the handle: it would hold the lock longer than this process.
int opened(const std::filesystem::path& folder) {
    return ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
}

}  // namespace

std::optional<FolderLock> FolderLock::take(const std::filesystem::path& folder) {
    const int handle = opened(folder);
    if (handle < 0) throw OutputError(fmt::format("cannot open {}: {}", folder.string(), std::strerror(errno)));
    FolderLock lock(handle);
    if (::flock(handle, LOCK_EX | LOCK_NB) != 0) return std::nullopt;
    return lock;
}

bool FolderLock::isTaken(const std::filesystem::path& folder) {
    const int handle = opened(folder);
    if (handle < 0) return false;
    const FolderLock lock(handle);
    return ::flock(handle, LOCK_EX | LOCK_NB) != 0;
}

void FolderLock::await(const std::filesystem::path& folder) {
    const int handle = opened(folder);
    if (handle < 0) return;
    const FolderLock lock(handle);
    (void)::flock(handle, LOCK_EX);
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
