// Signals that ask the program to end: which of them are one request, and which are two.
#include "host/app/interrupt.h"

#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <string>
#include <vector>

#include "tests/support/catch.h"

using namespace vkdose;

namespace {

struct Signal {
    int number;
    double time;  ///< [s]
};

double now = 0;

/// Sends the signals to a process that watches for them. How it ended, and how many it outlived with the flag set.
struct End {
    int status = 0;
    std::size_t outlived = 0;
};
End sentTo(const std::vector<Signal>& signals) {
    int ends[2];
    REQUIRE(pipe(ends) == 0);
    const pid_t child = fork();
    if (child == 0) {
        const std::atomic<bool>& flag = watchInterrupts([] { return now; });
        for (const Signal& s : signals) {
            now = s.time;
            raise(s.number);
            if (write(ends[1], flag ? "." : "?", 1) != 1) _exit(2);
        }
        _exit(0);
    }
    close(ends[1]);
    End end;
    char mark = 0;
    while (read(ends[0], &mark, 1) == 1) {
        CHECK(mark == '.');
        ++end.outlived;
    }
    close(ends[0]);
    REQUIRE(waitpid(child, &end.status, 0) == child);
    return end;
}

}  // namespace

TEST_CASE("signals within a second of the first are one request to end") {
    const End end = sentTo({{SIGINT, 7000}, {SIGINT, 7000}, {SIGTERM, 7000.3}, {SIGINT, 7000.999}, {SIGHUP, 7000.5}});
    CHECK(end.outlived == 5);
    CHECK(WIFEXITED(end.status));
}

TEST_CASE("a second request to end comes later than a second, and ends the program at once") {
    const int second = GENERATE(SIGINT, SIGTERM);
    const End end = sentTo({{SIGINT, 7000}, {SIGINT, 7000.5}, {second, 7001.01}, {SIGINT, 7002}});
    CHECK(end.outlived == 2);
    REQUIRE(WIFSIGNALED(end.status));
    CHECK(WTERMSIG(end.status) == second);
}

TEST_CASE("a terminal may tell of its closing again and again") {
    const End end = sentTo({{SIGHUP, 7000}, {SIGHUP, 7005}, {SIGHUP, 7010}});
    CHECK(end.outlived == 3);
    CHECK(WIFEXITED(end.status));
}
