#include "host/core/output_file.h"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <utility>

#include "host/core/error.h"
#include "host/core/file.h"

namespace vkdose {

bool writeAll(int handle, std::string_view content) {
    while (!content.empty()) {
        const ssize_t n = retried([&] { return ::write(handle, content.data(), content.size()); });
        if (n < 0) return false;
        content.remove_prefix(static_cast<std::size_t>(n));
    }
    return true;
}

bool syncAll(int handle) {
    if (retried([&] { return ::fsync(handle); }) == 0) return true;
    constexpr std::array kCannot{EINVAL, ENOTSUP, EROFS, ENOSYS};
    return std::find(kCannot.begin(), kCannot.end(), errno) != kCannot.end();
}

bool closeAll(int handle) {
    return ::close(handle) == 0 || errno == EINTR;
}

OutputFile::OutputFile(std::filesystem::path file, int flags)
    : file_(std::move(file)), handle_(openOutput(file_, flags)) {}

void OutputFile::write(std::string_view content) {
    if (!writeAll(handle_, content)) fail();
}

void OutputFile::sync() {
    if (!syncAll(handle_)) fail();
}

void OutputFile::cutAt(std::uint64_t size) {
    if (retried([&] { return ::ftruncate(handle_, static_cast<off_t>(size)); }) != 0) fail();
}

void OutputFile::goTo(std::uint64_t place) {
    if (::lseek(handle_, static_cast<off_t>(place), SEEK_SET) < 0) fail();
}

bool OutputFile::isWhereItWas() const {
    struct stat named {
    }, ours{};
    return ::stat(file_.c_str(), &named) == 0 && ::fstat(handle_, &ours) == 0 && named.st_dev == ours.st_dev &&
           named.st_ino == ours.st_ino;
}

void OutputFile::fail() const {
    throw OutputError(writeFault(file_));
}

OutputFile::OutputFile(OutputFile&& other) noexcept
    : file_(std::move(other.file_)), handle_(std::exchange(other.handle_, -1)) {}

OutputFile& OutputFile::operator=(OutputFile&& other) noexcept {
    std::swap(file_, other.file_);
    std::swap(handle_, other.handle_);
    return *this;
}

OutputFile::~OutputFile() {
    if (handle_ >= 0) ::close(handle_);
}

}  // namespace vkdose
