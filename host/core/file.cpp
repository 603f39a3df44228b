#include "host/core/file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <sstream>
#include <system_error>

#include "host/core/error.h"

namespace vkdose {

namespace {

/// Writes and syncs a new file; false, with errno set, if that fails.
bool writeWhole(const std::filesystem::path& file, std::string_view content) {
    const int handle = ::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (handle < 0) return false;
    bool good = true;
    for (std::size_t done = 0; good && done < content.size();) {
        const ssize_t n = ::write(handle, content.data() + done, content.size() - done);
        good = n >= 0 || errno == EINTR;
        if (n > 0) done += static_cast<std::size_t>(n);
    }
    good = good && ::fsync(handle) == 0;
    const int why = errno;
    const bool closed = ::close(handle) == 0;
    if (!good) errno = why;
    return good && closed;
}

}  // namespace

std::string writeFault(const std::filesystem::path& file) {
    return fmt::format("cannot write {}: {}", file.string(), std::strerror(errno));
}

std::optional<std::string> fileContent(const std::filesystem::path& file) {
    std::error_code code;
    std::ifstream stream(file, std::ios::binary);
    if (!stream || std::filesystem::is_directory(file, code)) return std::nullopt;
    std::ostringstream bytes;
    bytes << stream.rdbuf();
    return std::move(bytes).str();
}

void createFolder(const std::filesystem::path& folder) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error) throw OutputError(fmt::format("cannot create {}: {}", folder.string(), error.message()));
}

void replaceFile(const std::filesystem::path& file, std::string_view content) {
    std::filesystem::path fresh = file;
    fresh += ".new";
    if (!writeWhole(fresh, content) || std::rename(fresh.c_str(), file.c_str()) != 0) {
        const std::string fault = writeFault(file);
        ::unlink(fresh.c_str());
        throw OutputError(fault);
    }
    // The move itself has to survive a crash as well; a file system that cannot sync a folder has done what it can.
    const int folder = ::open(file.has_parent_path() ? file.parent_path().c_str() : ".", O_RDONLY | O_DIRECTORY);
    if (folder >= 0) {
        ::fsync(folder);
        ::close(folder);
    }
}

}  // namespace vkdose
