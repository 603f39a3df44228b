#pragma once
// A folder that one process at a time writes into.

#include <filesystem>
#include <optional>

namespace vkdose {

/// The folder itself is what is locked: files in it come and go, which would shake a lock off.
class FolderLock {
  public:
    /// Nothing if another process holds the folder. Throws OutputError if it cannot be opened.
    static std::optional<FolderLock> take(const std::filesystem::path& folder);

    /// Whether another process holds it; a folder that is not there is free.
    static bool isTaken(const std::filesystem::path& folder);

    /// Waits until none does, or a signal comes.
    static void await(const std::filesystem::path& folder);

    FolderLock(FolderLock&& other) noexcept;
    FolderLock& operator=(FolderLock&& other) noexcept;
    ~FolderLock();

  private:
    explicit FolderLock(int handle) : handle_(handle) {}
    int handle_;
};

}  // namespace vkdose
