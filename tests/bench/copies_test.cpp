// Processes side by side.

#include "host/bench/copies.h"

#include <sys/wait.h>

#include <cerrno>
#include <cstdlib>
#include <stdexcept>

#include "host/core/error.h"
#include "tests/app/sandbox.h"
#include "tests/support/catch.h"

using namespace vkdose::bench;
using vkdose::test::Sandbox;

TEST_CASE("the figures of the copies are summed, repeat by repeat") {
    const auto sums = sumOfCopies(3, 2, [](const Meet& meet) {
        meet();
        meet();
        return std::vector<double>{1.5, 10};
    });
    CHECK(sums == std::vector<double>{4.5, 30});
    CHECK((waitpid(-1, nullptr, WNOHANG) == -1 && errno == ECHILD));  // none is left behind
}

TEST_CASE("copies keep lavapipe to their own processor, if nothing else is asked for") {
    const auto asked = [](const Meet&) {
        const char* threads = std::getenv("LP_NUM_THREADS");
        return std::vector<double>{threads == nullptr ? -1.0 : double(std::atoi(threads))};
    };
    unsetenv("LP_NUM_THREADS");
    CHECK(sumOfCopies(2, 1, asked)[0] == 0);
    setenv("LP_NUM_THREADS", "3", 1);
    CHECK(sumOfCopies(2, 1, asked)[0] == 6);
    unsetenv("LP_NUM_THREADS");
}

TEST_CASE("a copy that fails ends the others, who wait for it") {
    const Sandbox box;
    const auto failsOnce = [&](const Meet& meet) {
        if (std::filesystem::create_directory(box / "only one process makes this"))
            throw std::runtime_error("this copy was made to fail");
        meet();
        return std::vector<double>{1};
    };
    CHECK_THROWS_AS(sumOfCopies(3, 1, failsOnce), vkdose::DeviceError);
    CHECK((waitpid(-1, nullptr, WNOHANG) == -1 && errno == ECHILD));
}
