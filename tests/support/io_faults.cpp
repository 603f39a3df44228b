// A library to be preloaded (LD_PRELOAD) that makes a good disk a bad one, for tests: production code has no hooks.
//
// VKDOSE_IO_FILE   the files whose calls are spoilt: the end of their path, from a slash on. Of a folder likewise.
// VKDOSE_IO_FAULT  the faults, separated by commas. Each is one of
//                      CALL:ERROR         every such call fails with this error of errno
//                      CALL:ERROR:N       from the N-th such call on, counted from 0
//                      CALL:ERROR:N:M     M of them, and then no more
//                      read:short:N       no call reads more than N bytes
//                      write:short:N      no call writes more than N bytes
//                  CALL is open, read (pread too), write, fsync, close, rename or flock. A close does its work even if
//                  it fails, as Linux has it.
// VKDOSE_IO_TOLD   a file that gets a line for each call that was spoilt: "read EIO"
//
// What the C library reads by itself (fopen, std::ifstream) goes past this library where it does not call `read`.
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <climits>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

namespace {

enum Call { kOpen, kRead, kWrite, kFsync, kClose, kRename, kFlock, kCalls };
constexpr std::array<std::string_view, kCalls> kNames{"open", "read", "write", "fsync", "close", "rename", "flock"};

struct Fault {
    std::string name;
    int error = 0;  ///< 0: the call is cut short
    long from = 0;  ///< its first call; of a short one the bytes
    long count = LONG_MAX;
};

int errorOf(std::string_view name) {
    constexpr std::array<std::pair<std::string_view, int>, 10> kErrors{{{"short", 0},
                                                                        {"EIO", EIO},
                                                                        {"EINTR", EINTR},
                                                                        {"EINVAL", EINVAL},
                                                                        {"ENOTSUP", ENOTSUP},
                                                                        {"EROFS", EROFS},
                                                                        {"ENOSPC", ENOSPC},
                                                                        {"EACCES", EACCES},
                                                                        {"ENOLCK", ENOLCK},
                                                                        {"ESTALE", ESTALE}}};
    for (const auto& [known, error] : kErrors)
        if (known == name) return error;
    std::fprintf(stderr, "io_faults: no error %s\n", std::string(name).c_str());
    std::abort();
}

std::vector<std::string_view> split(std::string_view text, char at) {
    std::vector<std::string_view> parts;
    while (!text.empty()) {
        parts.push_back(text.substr(0, text.find(at)));
        text.remove_prefix(std::min(text.size(), parts.back().size() + 1));
    }
    return parts;
}

std::vector<Fault> faultsOf(Call call) {
    std::vector<Fault> faults;
    const char* all = std::getenv("VKDOSE_IO_FAULT");
    for (const std::string_view one : split(all == nullptr ? "" : all, ',')) {
        const std::vector<std::string_view> parts = split(one, ':');
        if (parts.size() < 2 || parts[0] != kNames[call]) continue;
        const auto number = [&](std::size_t i, long usual) {
            return i < parts.size() ? std::atol(std::string(parts[i]).c_str()) : usual;
        };
        faults.push_back({std::string(parts[1]), errorOf(parts[1]), number(2, 0), number(3, LONG_MAX)});
    }
    return faults;
}

bool isMeant(std::string_view path) {
    const char* file = std::getenv("VKDOSE_IO_FILE");
    if (file == nullptr || *file == '\0') return false;
    return path == file || (path.ends_with(file) && path[path.size() - std::strlen(file) - 1] == '/');
}

bool isMeant(int handle) {
    std::array<char, PATH_MAX> path{};
    const std::string link = "/proc/self/fd/" + std::to_string(handle);
    const ssize_t size = readlink(link.c_str(), path.data(), path.size());
    return size > 0 && isMeant(std::string_view(path.data(), static_cast<std::size_t>(size)));
}

void told(Call call, const std::string& name) {
    const char* file = std::getenv("VKDOSE_IO_TOLD");
    if (file == nullptr) return;
    const long handle = syscall(SYS_openat, AT_FDCWD, file, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
    const std::string line = std::string(kNames[call]) + " " + name + "\n";
    if (handle >= 0) syscall(SYS_write, handle, line.data(), line.size());
    if (handle >= 0) syscall(SYS_close, handle);
}

/// The errno with which this call on a file that is meant fails; 0: it does not. `most` becomes the bytes of a short
/// one.
int failsNow(Call call, std::size_t* most = nullptr) {
    static std::array<std::atomic<long>, kCalls> calls{};
    const long now = calls[call]++;
    for (const Fault& fault : faultsOf(call)) {
        if (fault.error == 0 && most != nullptr && *most > static_cast<std::size_t>(fault.from)) {
            *most = static_cast<std::size_t>(fault.from);
            told(call, fault.name);
        }
        if (fault.error == 0 || now < fault.from || now - fault.from >= fault.count) continue;
        told(call, fault.name);
        return fault.error;
    }
    return 0;
}

template <class Function>
Function* real(const char* name) {
    return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

int openedBy(const char* name, const char* path, int flags, mode_t mode) {
    if (const int error = isMeant(path) ? failsNow(kOpen) : 0) {
        errno = error;
        return -1;
    }
    return real<int(const char*, int, mode_t)>(name)(path, flags, mode);
}

mode_t modeOf(int flags, va_list more) {
    return (flags & (O_CREAT | O_TMPFILE)) != 0 ? va_arg(more, mode_t) : 0;
}

}  // namespace

#define VKDOSE_OPEN(name)                          \
    int name(const char* path, int flags, ...) {   \
        va_list more;                              \
        va_start(more, flags);                     \
        const mode_t mode = modeOf(flags, more);   \
        va_end(more);                              \
        return openedBy(#name, path, flags, mode); \
    }

extern "C" {

VKDOSE_OPEN(open)
VKDOSE_OPEN(open64)

ssize_t read(int handle, void* to, size_t most) {
    if (const int error = isMeant(handle) ? failsNow(kRead, &most) : 0) {
        errno = error;
        return -1;
    }
    return real<ssize_t(int, void*, size_t)>("read")(handle, to, most);
}

ssize_t pread(int handle, void* to, size_t most, off_t at) {
    if (const int error = isMeant(handle) ? failsNow(kRead, &most) : 0) {
        errno = error;
        return -1;
    }
    return real<ssize_t(int, void*, size_t, off_t)>("pread")(handle, to, most, at);
}

ssize_t pread64(int handle, void* to, size_t most, off64_t at) {
    if (const int error = isMeant(handle) ? failsNow(kRead, &most) : 0) {
        errno = error;
        return -1;
    }
    return real<ssize_t(int, void*, size_t, off64_t)>("pread64")(handle, to, most, at);
}

ssize_t write(int handle, const void* from, size_t most) {
    if (const int error = isMeant(handle) ? failsNow(kWrite, &most) : 0) {
        errno = error;
        return -1;
    }
    return real<ssize_t(int, const void*, size_t)>("write")(handle, from, most);
}

int fsync(int handle) {
    if (const int error = isMeant(handle) ? failsNow(kFsync) : 0) {
        errno = error;
        return -1;
    }
    return real<int(int)>("fsync")(handle);
}

int close(int handle) {
    const int error = isMeant(handle) ? failsNow(kClose) : 0;
    const int result = real<int(int)>("close")(handle);
    if (error == 0) return result;
    errno = error;
    return -1;
}

int rename(const char* from, const char* to) noexcept {
    if (const int error = isMeant(to) ? failsNow(kRename) : 0) {
        errno = error;
        return -1;
    }
    return real<int(const char*, const char*)>("rename")(from, to);
}

int flock(int handle, int operation) noexcept {
    if (const int error = isMeant(handle) ? failsNow(kFlock) : 0) {
        errno = error;
        return -1;
    }
    return real<int(int, int)>("flock")(handle, operation);
}

}  // extern "C"
