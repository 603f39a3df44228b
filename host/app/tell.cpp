#include "host/app/tell.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>

#include "host/core/exit_code.h"
#include "host/core/output_file.h"

namespace vkdose {

namespace {

int lost = 0;           ///< errno of the first text on stdout that could not be written
bool terminal = false;  ///< stdout was one at the start

/// Whether there is nobody any more who could miss the text: the pipe's reader has ended, the terminal was closed.
bool unread(int error) {
    return error == EPIPE || (error == EIO && terminal);
}

bool arrived(std::FILE* stream, bool good) {
    if (!good && stream == stdout && lost == 0) lost = errno;
    return good;
}

}  // namespace

bool say(std::FILE* stream, std::string_view text) {
    return arrived(stream, std::fwrite(text.data(), 1, text.size(), stream) == text.size());
}

bool sendText(std::FILE* stream) {
    return arrived(stream, std::fflush(stream) == 0);
}

void openText() {
    std::signal(SIGPIPE, SIG_IGN);
    terminal = ::isatty(STDOUT_FILENO) == 1;
    for (const int handle : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
        if (::fcntl(handle, F_GETFD) >= 0 || errno != EBADF) continue;
        // The wrong way round, so that reading and writing fail as they do without it. It gets the lowest number.
        (void)retried([&] { return ::open("/dev/null", handle == STDIN_FILENO ? O_WRONLY : O_RDONLY); });
    }
}

int closedText(int code) {
    sendText(stdout);
    if (lost == 0 || unread(lost)) return code;
    tell(stderr, "vkdose: not all of the text could be written to the standard output: {}\n", std::strerror(lost));
    return code == kOk ? kOutputError : code;
}

}  // namespace vkdose
