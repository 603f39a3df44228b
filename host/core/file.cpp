#include "host/core/file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <new>
#include <system_error>

#include "host/core/error.h"
#include "host/core/memory_limit.h"
#include "host/core/output_file.h"

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

std::string refusedBy(const fs::path& file, int why) {
    return fmt::format("{} cannot be read: {}", shortenedPath(file.string()), faultText(why));
}

/// Writes into an open file and closes it. Returns false, with errno set, if that fails.
bool writeAndClose(int handle, std::string_view content, bool sync) {
    const bool good = writeAll(handle, content) && (!sync || syncAll(handle));
    const int why = errno;
    const bool closed = closeAll(handle);
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
    std::string text = fmt::format("cannot write {}: {}", file.string(), faultText(why));
    std::error_code code;
    if (why == ENOSPC || why == EDQUOT || why == EFBIG) text += "; make room";
    if (why == ENOENT && file.has_parent_path() && !fs::exists(file.parent_path(), code))
        text += fmt::format("; there is no folder {}", file.parent_path().string());
    return text;
}

std::optional<InputFile> InputFile::open(const fs::path& file) {
    struct stat found {};
    // Looked at before it is opened, because opening a device may move it, and again after, because it may be another.
    if (::stat(file.c_str(), &found) != 0) {
        // No file can have a name that is too long.
        if (errno == ENOENT || errno == ENOTDIR || errno == ENAMETOOLONG) return std::nullopt;
        throw ReadError(refusedBy(file, errno));
    }
    if (!S_ISREG(found.st_mode)) return std::nullopt;
    const int handle = retried([&] { return ::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY); });
    if (handle < 0 && errno == ENOENT) return std::nullopt;
    if (handle < 0) throw ReadError(refusedBy(file, errno));
    InputFile opened(file, handle);
    if (::fstat(handle, &found) != 0) opened.fail();
    if (!S_ISREG(found.st_mode)) return std::nullopt;
    return opened;
}

std::size_t InputFile::read(char* to, std::size_t most) {
    std::size_t done = 0;
    while (done < most) {
        const ssize_t n = retried([&] { return ::read(handle_, to + done, most - done); });
        if (n < 0) fail();
        if (n == 0) break;
        done += static_cast<std::size_t>(n);
        at_ += static_cast<std::uint64_t>(n);
    }
    return done;
}

void InputFile::skipToLast(std::uint64_t most) {
    const std::uint64_t all = size();
    at_ = all - std::min(all, most);
    if (::lseek(handle_, static_cast<off_t>(at_), SEEK_SET) < 0) fail();
}

std::string InputFile::rest(std::uint64_t most) {
    constexpr std::uint64_t kBlock = 1U << 16;
    const std::uint64_t all = size();
    // One byte more than the size asks for the end in the same turn. The system tells no size of files of its own
    // (/proc), and a file may grow meanwhile.
    std::uint64_t next = std::max(kBlock, all - std::min(all, at_) + 1);
    std::string bytes;
    for (;;) {
        const std::size_t before = bytes.size();
        const auto wanted = static_cast<std::size_t>(std::min(next, most - before));
        try {
            bytes.resize(before + wanted);
        } catch (const std::bad_alloc&) {
            throw ReadError(fmt::format("{} cannot be read: there is no memory for its {} MiB{}",
                                        shortenedPath(file_.string()), all >> 20U, memoryLimitText()));
        }
        const std::size_t n = read(bytes.data() + before, wanted);
        bytes.resize(before + n);
        if (n < wanted || bytes.size() == most) return bytes;
        next = kBlock + bytes.size();
    }
}

std::uint64_t InputFile::size() const {
    struct stat found {};
    if (::fstat(handle_, &found) != 0) fail();
    return static_cast<std::uint64_t>(found.st_size);
}

void InputFile::fail() const {
    const int why = errno;
    const std::string name = shortenedPath(file_.string());
    throw ReadError(fmt::format("{} cannot be read from byte {} on: {}", name, at_, faultText(why)));
}

InputFile::InputFile(InputFile&& other) noexcept
    : file_(std::move(other.file_)), handle_(std::exchange(other.handle_, -1)), at_(other.at_) {}

InputFile& InputFile::operator=(InputFile&& other) noexcept {
    std::swap(file_, other.file_);
    std::swap(handle_, other.handle_);
    std::swap(at_, other.at_);
    return *this;
}

InputFile::~InputFile() {
    if (handle_ >= 0) ::close(handle_);
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
    if (fs::exists(file, code)) return name + " " + readFault(file);
    const bool tooLong = code == std::errc::filename_too_long;
    return "there is no file " + name + (tooLong ? ": no name may be so long" : "");
}

std::optional<std::string> fileContent(const fs::path& file) {
    auto opened = InputFile::open(file);
    return opened ? std::optional(opened->rest()) : std::nullopt;
}

std::optional<std::string> fileStart(const fs::path& file, std::uint64_t most) {
    auto opened = InputFile::open(file);
    return opened ? std::optional(opened->rest(most)) : std::nullopt;
}

std::optional<std::string> fileEnd(const fs::path& file, std::uint64_t most) {
    auto opened = InputFile::open(file);
    if (!opened) return std::nullopt;
    opened->skipToLast(most);
    return opened->rest(most);
}

std::vector<fs::path> entriesOf(const fs::path& folder) {
    std::vector<fs::path> entries;
    std::error_code code;
    fs::directory_iterator entry(folder, code);
    while (!code && entry != fs::directory_iterator()) {
        entries.push_back(entry->path());
        entry.increment(code);
    }
    const bool absent = code == std::errc::no_such_file_or_directory || code == std::errc::not_a_directory;
    if (code && !absent)
        throw ReadError(
            fmt::format("the folder {} cannot be listed: {}", shortenedPath(folder.string()), code.message()));
    return entries;
}

int openOutput(const fs::path& file, int flags) {
    std::error_code code;
    if (fs::is_block_file(file, code))
        throw OutputError(fmt::format("cannot write {}: it is a disk; name a file", file.string()));
    const int handle = retried([&] { return ::open(file.c_str(), flags | O_CLOEXEC | O_NONBLOCK | O_NOCTTY, 0666); });
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
        if (!writeAndClose(openOutput(file, O_WRONLY), content, false)) throw OutputError(writeFault(file));
        return;
    }
    const fs::path target = linkEnd(file);
    fs::path fresh = target;
    fresh += ".new";
    requireReplaceable(fresh);
    if (fs::is_symlink(fresh, code))
        throw OutputError(fmt::format("cannot write {}: it is first written as {}, which is a link; remove that",
                                      file.string(), fresh.string()));
    constexpr int kFlags = O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC | O_NOFOLLOW;
    const int handle = retried([&] { return ::open(fresh.c_str(), kFlags, 0666); });
    if (handle < 0) throw OutputError(writeFault(file));
    if (!writeAndClose(handle, content, true) ||
        retried([&] { return std::rename(fresh.c_str(), target.c_str()); }) != 0) {
        const std::string fault = writeFault(file);
        ::unlink(fresh.c_str());
        throw OutputError(fault);
    }
    // The folder is synced too, so that the move itself survives a crash. One that may be written and not read cannot
    // be opened for that.
    const fs::path above = target.has_parent_path() ? target.parent_path() : ".";
    const int folder = retried([&] { return ::open(above.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC); });
    if (folder < 0) return;
    const bool synced = syncAll(folder);
    const std::string fault = synced ? "" : writeFault(above);
    ::close(folder);
    if (!synced) throw OutputError(fault);
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
