#pragma once
// A folder that one process at a time writes into.

#include <filesystem>
#include <functional>
#include <optional>

namespace vkdose {

/// The lock is on the folder itself, because files in it are replaced, and a lock on a file would go with it. A file
/// system without locks gives everybody the lock.
class FolderLock {
  public:
    /// Takes the lock. Returns nothing if another process holds it. Throws OutputError if the folder cannot be opened.
    static std::optional<FolderLock> take(const std::filesystem::path& folder);

    /// Whether another process holds the lock. A folder that does not exist is free.
    static bool isTaken(const std::filesystem::path& folder);

    /// Waits until no process holds the lock. Returns false if `giveUp`, which is asked several times a second, says so
    /// before.
    static bool await(const std::filesystem::path& folder, const std::function<bool()>& giveUp);

    FolderLock(const FolderLock&) = delete;
    FolderLock& operator=(const FolderLock&) = delete;
    FolderLock(FolderLock&& other) noexcept;
    FolderLock& operator=(FolderLock&& other) noexcept;
    ~FolderLock();

  private:
    explicit FolderLock(int handle) : handle_(handle) {}
    int handle_;
};

}  // namespace vkdose
