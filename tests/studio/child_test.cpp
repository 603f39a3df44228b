// A process that the workbench starts and reads.
#include "host/studio/child.h"

#include "tests/support/catch.h"

using namespace vkdose::studio;

TEST_CASE("a process that takes longer than it may is ended, and known by it") {
    Child slow("/bin/sleep", {"600"}, "/");
    const Ended ended = slow.read([](const std::string&) {}, std::chrono::milliseconds(1));
    CHECK(ended.late);
    CHECK(ended.code == 128 + 9);
    Child quick("/bin/echo", {"a", "b"}, "/");
    std::string said;
    const Ended well = quick.read([&](const std::string& line) { said = line; }, std::chrono::minutes(10));
    CHECK_FALSE(well.late);
    CHECK(well.code == 0);
    CHECK(said == "a b");
}

TEST_CASE("a process that runs for an answer is interrupted when the workbench is to stop") {
    Child slow("/bin/sleep", {"600"}, "/");
    const std::atomic<bool> stop = true;
    const Ended ended = slow.read([](const std::string&) {}, std::chrono::minutes(10), &stop);
    CHECK_FALSE(ended.late);
    CHECK(ended.code == 128 + 2);
}
