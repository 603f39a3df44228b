#pragma once
// A run that is killed and goes on, beside one that is left alone.

#include <sys/wait.h>

#include <csignal>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include "tests/app/sandbox.h"
#include "tests/support/catch.h"

namespace vkdose::test {

/// `vkdose WORDS --out` into the folders whole and cut of the sandbox. That into cut is killed as soon as it has a
/// checkpoint, and resumed.
inline void runWholeAndCut(const Sandbox& box, const std::vector<std::string>& words) {
    const auto into = [&](const char* out) {
        auto all = words;
        all.insert(all.end(), {"--out", out});
        return all;
    };
    int status = 0;
    waitpid(box.start(into("whole")), &status, 0);
    REQUIRE(status == 0);
    const pid_t child = box.start(into("cut"));
    while (!std::filesystem::exists(box / "cut/checkpoint.h5")) {
        REQUIRE(waitpid(child, &status, WNOHANG) == 0);  // it must not end before
        std::this_thread::yield();
    }
    kill(child, SIGKILL);
    waitpid(child, &status, 0);
    REQUIRE(std::filesystem::exists(box / "cut/checkpoint.h5"));
    REQUIRE(box.vkdose("resume cut --quiet").code == 0);
}

}  // namespace vkdose::test
