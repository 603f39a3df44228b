#include "host/core/child_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>

#include "host/core/error.h"
#include "host/core/memory_limit.h"

namespace vkdose {

namespace {

std::vector<char*> pointers(std::vector<std::string>& words) {
    std::vector<char*> list;
    for (std::string& word : words) list.push_back(word.data());
    list.push_back(nullptr);
    return list;
}

/// What takes the place of our terminal and our process group.
class Surroundings {
  public:
    explicit Surroundings(const ChildStart& start) {
        posix_spawn_file_actions_init(&files_);
        put(start.in, STDIN_FILENO);
        put(start.out, STDOUT_FILENO);
        put(start.error, STDERR_FILENO);
        if (!start.folder.empty()) posix_spawn_file_actions_addchdir_np(&files_, start.folder.c_str());
        posix_spawnattr_init(&attributes_);
        posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETPGROUP);
        posix_spawnattr_setpgroup(&attributes_, 0);
    }
    ~Surroundings() {
        posix_spawn_file_actions_destroy(&files_);
        posix_spawnattr_destroy(&attributes_);
    }
    Surroundings(const Surroundings&) = delete;
    Surroundings& operator=(const Surroundings&) = delete;

    posix_spawn_file_actions_t files_{};
    posix_spawnattr_t attributes_{};

  private:
    void put(int file, int place) {
        if (file >= 0)
            posix_spawn_file_actions_adddup2(&files_, file, place);
        else
            posix_spawn_file_actions_addopen(&files_, place, "/dev/null", place == STDIN_FILENO ? O_RDONLY : O_WRONLY,
                                             0);
    }
};

}  // namespace

Pipe::~Pipe() {
    for (const int end : {read, write})
        if (end >= 0) ::close(end);
}

void Pipe::open() {
    std::array<int, 2> ends{};
    if (pipe2(ends.data(), O_CLOEXEC) != 0) throw RunError(fmt::format("no pipe: {}", faultText(errno)));
    read = ends[0];
    write = ends[1];
}

pid_t startChild(ChildStart start) {
    const Surroundings around(start);
    pid_t process = 0;
    const int fault = posix_spawn(&process, start.program.c_str(), &around.files_, &around.attributes_,
                                  pointers(start.words).data(), pointers(start.variables).data());
    if (fault != 0) throw RunError(fmt::format("cannot start another process: {}", faultText(fault)));
    return process;
}

int waitForChild(pid_t process) {
    int status = 0;
    while (waitpid(process, &status, 0) < 0 && errno == EINTR) {
    }
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

}  // namespace vkdose
