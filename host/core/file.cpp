#include "host/core/file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <sstream>
#include <system_error>

#include "host/core/error.h"

namespace vkdose {

namespace fs = std::filesystem;

namespace {

/// Name for something at a path that is not a regular file: "a pipe", "a device", ...
const char* kindOf(fs::file_type type) {
    switch (type) {
        case fs::file_type::directory:
            return "a folder";
        case fs::file_type::fifo:
            return "a pipe";
        case fs::file_type::socket:
            return "a socket";
        case fs::file_type::block:
        case fs::file_type::character:
            return "a device";
        default:
            return "something else";
    }
}

/// Writes into an open file and closes it. Returns false, with errno set, if that fails.
bool writeAll(int handle, std::string_view content, bool sync) {
    bool good = true;
    for (std::size_t done = 0; good && done < content.size();) {
        const ssize_t n = ::write(handle, content.data() + done, content.size() - done);
        good = n >= 0 || errno == EINTR;
        if (n > 0) done += static_cast<std::size_t>(n);
    }
    good = good && (!sync || ::fsync(handle) == 0);
    const int why = errno;
    const bool closed = ::close(handle) == 0;
    if (!good) errno = why;
    return good && closed;
}

/// The path at the end of a chain of links. A file need not exist there.
fs::path linkEnd(fs::path file) {
    constexpr int kMostLinks = 40;  // as many as Linux follows
    std::error_code code;
    for (int links = 0; fs::is_symlink(file, code); ++links) {
        if (links == kMostLinks) {
            errno = ELOOP;
            throw OutputError(writeFault(file));
        }
        file = file.parent_path() / fs::read_symlink(file, code);
    }
    return file;
}

}  // namespace

void removeEmptyFolder(const fs::path& folder) {
    (void)rmdir(folder.c_str());  // std::filesystem::remove would take a file too
}

std::string writeFault(const fs::path& file) {
    const int why = errno;
    std::string text = fmt::format("cannot write {}: {}", file.string(), std::strerror(why));
    std::error_code code;
    if (why == ENOSPC || why == EDQUOT || why == EFBIG) text += "; make room";
    if (why == ENOENT && file.has_parent_path() && !fs::exists(file.parent_path(), code))
        text += fmt::format("; there is no folder {}", file.parent_path().string());
    return text;
}

std::ifstream inputFile(const fs::path& file) {
    std::error_code code;
    std::ifstream stream;
    if (fs::is_regular_file(file, code))
        stream.open(file, std::ios::binary);
    else
        stream.setstate(std::ios::failbit);
    return stream;
}

std::string readFault(const fs::path& file) {
    std::error_code code;
    const fs::file_status status = fs::status(file, code);
    if (status.type() == fs::file_type::not_found) return "there is no such file";
    if (status.type() == fs::file_type::regular || status.type() == fs::file_type::none) return "cannot be read";
    return fmt::format("cannot be read: it is {}, not a file", kindOf(status.type()));
}

std::string unreadable(const fs::path& file) {
    std::error_code code;
    const std::string name = shortenedPath(file.string());
    return fs::exists(file, code) ? name + " " + readFault(file) : "there is no file " + name;
}

std::optional<std::string> fileContent(const fs::path& file) {
    std::ifstream stream = inputFile(file);
    if (!stream) return std::nullopt;
    std::ostringstream bytes;
    bytes << stream.rdbuf();
    return std::move(bytes).str();
}

int openOutput(const fs::path& file, int flags) {
    std::error_code code;
    if (fs::is_block_file(file, code))
        throw OutputError(fmt::format("cannot write {}: it is a disk; name a file", file.string()));
    const int handle = ::open(file.c_str(), flags | O_CLOEXEC | O_NONBLOCK | O_NOCTTY, 0666);
    if (handle < 0 && errno == ENXIO)
        throw OutputError(fmt::format("cannot write {}: it is a pipe or a socket, and nobody reads it", file.string()));
    if (handle < 0) throw OutputError(writeFault(file));
    ::fcntl(handle, F_SETFL, ::fcntl(handle, F_GETFL) & ~O_NONBLOCK);
    return handle;
}

void replaceFile(const fs::path& file, std::string_view content) {
    std::error_code code;
    const fs::file_status status = fs::status(file, code);
    if (fs::exists(status) && !fs::is_regular_file(status)) {
        if (!writeAll(openOutput(file, O_WRONLY), content, false)) throw OutputError(writeFault(file));
        return;
    }
    const fs::path target = linkEnd(file);
    fs::path fresh = target;
    fresh += ".new";
    requireReplaceable(fresh);
    if (fs::is_symlink(fresh, code))
        throw OutputError(fmt::format("cannot write {}: it is first written as {}, which is a link; remove that",
                                      file.string(), fresh.string()));
    const int handle = ::open(fresh.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC | O_NOFOLLOW, 0666);
    if (handle < 0) throw OutputError(writeFault(file));
    if (!writeAll(handle, content, true) || std::rename(fresh.c_str(), target.c_str()) != 0) {
        const std::string fault = writeFault(file);
        ::unlink(fresh.c_str());
        throw OutputError(fault);
    }
    // The folder is synced too, so that the move itself survives a crash. A failure is ignored, because some file
    // systems cannot sync a folder.
    const int folder = ::open(target.has_parent_path() ? target.parent_path().c_str() : ".", O_RDONLY | O_DIRECTORY);
    if (folder >= 0) {
        ::fsync(folder);
        ::close(folder);
    }
}

void requireReplaceable(const fs::path& file) {
    std::error_code code;
    const fs::file_status status = fs::status(file, code);
    if (fs::exists(status) && !fs::is_regular_file(status))
        throw OutputError(fmt::format("cannot write {}: it is {}; name a file", file.string(), kindOf(status.type())));
}

std::optional<fs::path> readAndWritten(const std::vector<fs::path>& read, const std::vector<fs::path>& written) {
    std::error_code code;
    for (const fs::path& to : written)
        for (const fs::path& from : read)
            if (fs::equivalent(to, from, code)) return to;
    return std::nullopt;
}

void createFolder(const fs::path& folder) {
    std::error_code error;
    fs::create_directories(folder, error);
    if (error) throw OutputError(fmt::format("cannot create {}: {}", folder.string(), error.message()));
}

}  // namespace vkdose
