#include "host/app/film.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <string>
#include <utility>

#include "host/app/backends.h"
#include "host/core/child_process.h"
#include "host/core/error.h"
#include "host/core/file.h"
#include "host/core/memory_limit.h"
#include "host/core/output_file.h"

namespace vkdose {

namespace {

std::string contentOf(int file) {
    std::string text(4096, '\0');
    const ssize_t n = retried([&] { return ::pread(file, text.data(), text.size(), 0); });
    text.resize(n > 0 ? std::size_t(n) : 0);
    while (!text.empty() && text.back() == '\n') text.pop_back();
    return text;
}

/// If the encoder ends early, this must be reported as an error. Without this class a signal would end our program.
class NoPipeSignal {
  public:
    NoPipeSignal() : before_(std::signal(SIGPIPE, SIG_IGN)) {}
    ~NoPipeSignal() { std::signal(SIGPIPE, before_); }
    NoPipeSignal(const NoPipeSignal&) = delete;
    NoPipeSignal& operator=(const NoPipeSignal&) = delete;

  private:
    void (*before_)(int);
};

}  // namespace

Film::Film(std::filesystem::path file, int width, int height, double rate) : file_(std::move(file)) {
    std::vector<std::string> words{"ffmpeg", "-nostdin", "-loglevel", "error", "-y", "-f", "rawvideo", "-pix_fmt",
                                   "bgr0", "-s", fmt::format("{}x{}", width, height), "-framerate",
                                   fmt::format("{:.6g}", rate), "-i", "pipe:0",
                                   // Every player takes this format. An absolute path cannot be taken for an option.
                                   "-pix_fmt", "yuv420p", std::filesystem::absolute(file_).string()};
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);

    requireReplaceable(file_);  // the encoder would wait for a pipe, and goes to and fro in its file
    Pipe pipe;
    pipe.open();
    said_ = memfd_create("ffmpeg", MFD_CLOEXEC);
    if (said_ < 0) throw OutputError(fmt::format("no place for what ffmpeg says: {}", faultText(errno)));
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_adddup2(&files, pipe.read, STDIN_FILENO);
    posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_adddup2(&files, said_, STDERR_FILENO);
    const int fault = posix_spawnp(&process_, "ffmpeg", &files, nullptr, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&files);
    pictures_ = std::exchange(pipe.write, -1);
    if (fault == 0) return;
    process_ = -1;
    close();
    throw UsageError(
        fmt::format("a film takes the program ffmpeg ({}): install it (Debian: ffmpeg), or name a folder for "
                    "single pictures",
                    faultText(fault)));
}

int Film::close() {
    int status = 0;
    if (pictures_ >= 0) ::close(pictures_);
    pictures_ = -1;
    if (process_ > 0)
        while (waitpid(process_, &status, 0) < 0 && errno == EINTR) {
        }
    process_ = -1;
    return status;
}

Film::~Film() {
    if (process_ > 0) kill(process_, SIGTERM);
    close();
    if (said_ >= 0) ::close(said_);
}

void Film::fail() {
    close();
    const std::string said = contentOf(said_);
    throw OutputError(
        fmt::format("ffmpeg could not write {}: {}", file_.string(), said.empty() ? "it ended without a word" : said));
}

void Film::add(const std::vector<std::uint8_t>& picture) {
    const NoPipeSignal quiet;
    if (!writeAll(pictures_, {reinterpret_cast<const char*>(picture.data()), picture.size()})) fail();
}

void Film::finish() {
    const int status = close();
    if (status != 0) fail();
}

}  // namespace vkdose
