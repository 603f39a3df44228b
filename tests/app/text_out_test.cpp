// What a command prints either arrives or is told to be lost.

#include <fcntl.h>

#include <array>
#include <sstream>

#include "tests/app/sandbox.h"
#include "tests/support/catch.h"

using namespace vkdose::test;

namespace {

const std::string kMini = " '" VKDOSE_SOURCE_DIR "/cases/mini.toml' ";
const std::string kShort =
    "--backend reference --set settle.time_s=0.005 --set dose.rotate_s=0.005 --set dose.rest_s=0.005 --set "
    "stop.max_doses=1 ";

/// The program with its standard output at `where`, as the shell has it.
Sandbox::Outcome printedTo(const Sandbox& box, const std::string& arguments, const std::string& where) {
    const std::string command = "cd '" + box.path().string() + "' && '" VKDOSE_BINARY_DIR "/vkdose' " + arguments +
                                " " + where + " 2> stderr.txt < /dev/null";
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, "", readText(box / "stderr.txt")};
}

/// The exit code of the command where all of its text arrives.
int plainCode(const Sandbox& box, const std::string& words) {
    std::filesystem::remove(box / "my.toml");
    const int code = box.vkdose(words).code;
    std::filesystem::remove(box / "my.toml");
    return code;
}

/// Every command that prints, with what it takes.
std::vector<std::string> commands() {
    return {"",
            "--help",
            "--version",
            "run --help",
            "run" + kMini + kShort + "--out run --force",
            "run" + kMini + kShort + "--out run --force --live",
            "check" + kMini + "--assume",
            "check" + kMini + "--assume --json",
            "check" + kMini + "--set seed=-1 --json",
            "devices",
            "manual keys",
            "manual keys --schema",
            "manual columns",
            "manual options",
            "manual completion bash",
            "manual man",
            "export-body" + kMini,
            "test compare" + kMini + "--steps 3 --twins 1",
            "test validate --list",
            "report ready",
            "render ready --size 64x64",
            "test verify --backend reference --only free-fall",
            "new my.toml --canister 80x30x100mm --coil 6x5mm --fill 48g"};
}

void checkTold(const std::string& where, const std::string& why) {
    const Sandbox box;
    REQUIRE(box.vkdose("run" + kMini + kShort + "--quiet --out ready").code == 0);
    for (const std::string& words : commands()) {
        const int plain = plainCode(box, words);
        const auto o = printedTo(box, words, where);
        CAPTURE(words, plain, o.err);
        CHECK(o.code == (plain == 0 ? 5 : plain));
        CHECK_THAT(o.err, Catch::EndsWith(
                              "vkdose: not all of the text could be written to the standard output: " + why + "\n"));
    }
    CHECK(readText(box / "run/timeseries.csv") == readText(box / "ready/timeseries.csv"));
    CHECK(printedTo(box, "run" + kMini + kShort + "--quiet --force --out run", where).code == 0);  // prints nothing
}

}  // namespace

TEST_CASE("a text that a full disk does not take ends with an error") {
    checkTold("> /dev/full", "No space left on device");
}

TEST_CASE("a closed standard output is an error, and the text goes into no other file") {
    checkTold(">&-", "Bad file descriptor");
}

TEST_CASE("a pipe that nobody reads any more ends no command, and is no error") {
    std::array<int, 2> ends{};
    REQUIRE(pipe(ends.data()) == 0);
    close(ends[0]);
    const Sandbox box;
    REQUIRE(box.vkdose("run" + kMini + kShort + "--quiet --out ready").code == 0);
    for (const std::string& words : commands()) {
        const int plain = plainCode(box, words);
        const auto o = printedTo(box, words, ">&" + std::to_string(ends[1]));
        CAPTURE(words, plain, o.err);
        CHECK(o.code == plain);
        CHECK(o.err.find("standard output") == std::string::npos);
    }
    CHECK(readText(box / "run/timeseries.csv") == readText(box / "ready/timeseries.csv"));
    // Of events the reader has gone: the run ends, and can go on.
    CHECK(printedTo(box, "run" + kMini + kShort + "--events --out told", ">&" + std::to_string(ends[1])).code == 130);
    CHECK(std::filesystem::exists(box / "told/checkpoint.h5"));
    close(ends[1]);
}
