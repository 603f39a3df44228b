#include "host/output/csv.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "host/core/error.h"

namespace vkdose {

std::string writeFault(const std::filesystem::path& file) {
    return fmt::format("cannot write {}: {}", file.string(), std::strerror(errno));
}

// "e": a child process has no part in the file, nor in its lock.
CsvFile::CsvFile(std::filesystem::path path, std::string_view header)
    : path_(std::move(path)), file_(std::fopen(path_.c_str(), "we")) {
    if (!file_) fail();
    line(std::string(header));
    flush();
}

CsvFile::CsvFile(std::filesystem::path path, std::uint64_t bytes)
    : path_(std::move(path)), file_(std::fopen(path_.c_str(), "r+e")) {
    if (!file_) fail();
    std::error_code error;
    const std::uint64_t size = std::filesystem::file_size(path_, error);
    if (error || size < bytes)
        throw OutputError(fmt::format("{} has {} bytes; it had {} when the checkpoint was written", path_.string(),
                                      error ? 0 : size, bytes));
    if (std::fseek(file_.get(), static_cast<long>(bytes), SEEK_SET) != 0) fail();
    cut_ = size > bytes;
}

void CsvFile::line(const std::string& fields) {
    if (cut_ && ::ftruncate(fileno(file_.get()), std::ftell(file_.get())) != 0) fail();
    cut_ = false;
    if (std::fputs(fields.c_str(), file_.get()) < 0 || std::fputc('\n', file_.get()) < 0) fail();
}

void CsvFile::flush() {
    if (std::fflush(file_.get()) != 0) fail();
}

std::uint64_t CsvFile::store() {
    flush();
    if (::fsync(fileno(file_.get())) != 0) fail();
    const long at = std::ftell(file_.get());
    if (at < 0) fail();
    return static_cast<std::uint64_t>(at);
}

bool CsvFile::lock() {
    return ::flock(fileno(file_.get()), LOCK_EX | LOCK_NB) == 0;
}

void CsvFile::fail() const {
    throw OutputError(writeFault(path_));
}

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
