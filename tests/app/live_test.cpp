// `--live` on a terminal that the test plays, and where there is none.

#include <fcntl.h>
#include <pty.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <nlohmann/json.hpp>

#include "host/core/csv_table.h"
#include "tests/app/sandbox.h"
#include "tests/support/catch.h"

using namespace vkdose::test;

namespace {

const std::string kCase = "'" VKDOSE_SOURCE_DIR "/cases/mini.toml' ";
/// The mini canister cut to a second or so on the reference backend, which needs no device.
const std::string kShort =
    kCase +
    "--backend reference --set settle.time_s=0.02 --set dose.rotate_s=0.02 --set dose.rest_s=0.005 "
    "--set stop.max_doses=2 --set checkpoint.time_s=0.01 ";

struct Shown {
    int code;          ///< exit code, or minus the signal that ended it
    std::string text;  ///< all that came out on the terminal, stdout and stderr
};

/// Runs the program on a terminal of 100 x 30 and types `key` once `until` has been seen.
Shown onTerminal(const Sandbox& box, const std::string& arguments, const std::string& until = "", char key = 0,
                 const std::string& before = "COLORTERM= ") {
    winsize size{30, 100, 0, 0};
    int terminal = -1;
    const pid_t child = forkpty(&terminal, nullptr, nullptr, &size);
    REQUIRE(child >= 0);
    if (child == 0) {
        const std::string command = "cd '" + box.path().string() + "' && TERM=xterm " + before +
                                    "exec '" VKDOSE_BINARY_DIR "/vkdose' " + arguments;
        execl("/bin/sh", "sh", "-c", command.c_str(), nullptr);
        _exit(127);
    }
    Shown shown{0, ""};
    char buffer[4096];
    bool typed = key == 0;
    for (ssize_t n = 0; (n = read(terminal, buffer, sizeof buffer)) > 0;) {
        shown.text.append(buffer, std::size_t(n));
        if (!typed && shown.text.find(until) != std::string::npos) typed = write(terminal, &key, 1) == 1;
    }
    close(terminal);
    int status = 0;
    waitpid(child, &status, 0);
    shown.code = WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
    return shown;
}

/// Runs the program on a terminal that is closed once something stands on it. The exit code, or minus the signal.
int onClosedTerminal(const Sandbox& box, const std::string& arguments, const std::string& before = "") {
    int terminal = -1;
    const pid_t child = forkpty(&terminal, nullptr, nullptr, nullptr);
    REQUIRE(child >= 0);
    if (child == 0) {
        const std::string command =
            before + "cd '" + box.path().string() + "' && TERM=xterm exec '" VKDOSE_BINARY_DIR "/vkdose' " + arguments;
        execl("/bin/sh", "sh", "-c", command.c_str(), nullptr);
        _exit(127);
    }
    std::string text;
    char buffer[4096];
    for (ssize_t n = 0; text.find("t = ") == std::string::npos && (n = read(terminal, buffer, sizeof buffer)) > 0;)
        text.append(buffer, std::size_t(n));
    close(terminal);
    int status = 0;
    waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

std::size_t count(const std::string& text, const std::string& part) {
    std::size_t n = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
    return n;
}

/// Whether the cursor is shown in the end.
void requireCursorBack(const std::string& text) {
    CHECK(count(text, "\033[?25l") > 0);
    CHECK(text.rfind("\033[?25h") > text.rfind("\033[?25l"));
}

}  // namespace

TEST_CASE("a run looked at gives the same bits as one that is not") {
    const Sandbox box;
    REQUIRE(box.vkdose("run " + kShort + "--quiet --out plain").code == 0);
    const Shown live = onTerminal(box, "run " + kShort + "--live --out live");
    CAPTURE(live.text);
    REQUIRE(live.code == 0);
    for (const char* file : {"timeseries.csv", "doses.csv", "particles.csv", "case.toml"})
        CHECK(readText(box / "plain" / file) == readText(box / "live" / file));
    CHECK_THAT(live.text, Catch::Contains("closed form") && Catch::Contains("dose 2") &&
                              Catch::Contains("particle-steps/s") && Catch::Contains("⡇"));
    CHECK_THAT(live.text, !Catch::Contains("\033[38;2;"));  // no colours were promised
    requireCursorBack(live.text);
    // It is hidden only while a picture is drawn. Ctrl-C would make the terminal drop what is not shown yet.
    CHECK(count(live.text, "\033[?25l") == count(live.text, "\033[?25h"));
    // The table follows below the last picture.
    CHECK(live.text.rfind("stopped") > live.text.rfind("\033[?25h"));

    const Shown colour = onTerminal(box, "run " + kShort + "--live --force --out live", "", 0, "COLORTERM=truecolor ");
    CHECK_THAT(colour.text, Catch::Contains("\033[38;2;") && Catch::Contains("▀"));
}

TEST_CASE("Ctrl-C while a run is looked at leaves the terminal in order, and a resumed run can be looked at") {
    const Sandbox box;
    // Longer than anyone waits: it ends by the key only.
    const std::string endless = kCase +
                                "--backend reference --set settle.time_s=0 --set dose.rotate_s=0.005 --set "
                                "dose.rest_s=0.002 --set stop.rule=\\\"none\\\" --set stop.max_doses=100000 ";
    const Shown cut = onTerminal(box, "run " + endless + "--live --out cut", "dose 2", '\x03');
    CAPTURE(cut.text);
    CHECK(cut.code == 130);
    requireCursorBack(cut.text);
    CHECK_THAT(cut.text, Catch::Contains("vkdose resume cut"));
    // The last doses from before stand in the first picture. The very last may have been cut.
    const std::size_t doses = vkdose::Table::read(box / "cut/doses.csv").rows();
    const std::string before = "dose " + std::to_string(std::max<std::size_t>(doses, 2) - 1) + " ";
    const Shown rest = onTerminal(box, "resume cut --live", "\033[?25h", '\x03');
    CAPTURE(rest.text);
    CHECK(rest.code == 130);
    requireCursorBack(rest.text);
    CHECK_THAT(rest.text.substr(0, rest.text.find("\033[?25h")), Catch::Contains(before));
}

TEST_CASE("a run whose terminal is closed stores a checkpoint and ends") {
    const std::string manner = GENERATE(as<std::string>(), "", "--live ");
    CAPTURE(manner);
    const Sandbox box;
    const int code =
        onClosedTerminal(box, "run " + kCase + "--backend reference --set settle.time_s=1000 --out out " + manner);
    CHECK(code == 130);
    CHECK(nlohmann::json::parse(readText(box / "out/summary.json"))["stop_reason"] == "interrupted");
    CHECK(std::filesystem::exists(box / "out/checkpoint.h5"));
}

TEST_CASE("under nohup a run outlives its terminal") {
    const Sandbox box;
    CHECK(onClosedTerminal(box, "run " + kShort + "--out out", "trap '' HUP; ") == 0);
    CHECK(nlohmann::json::parse(readText(box / "out/summary.json"))["stop_reason"] != "interrupted");
}

TEST_CASE("a command whose messages find no room does its work, and its exit code tells") {
    const Sandbox box;
    const auto withoutRoom = [&](const std::string& arguments) {
        const std::string command = "cd '" + box.path().string() + "' && exec '" VKDOSE_BINARY_DIR "/vkdose' " +
                                    arguments + " > /dev/full 2> /dev/full";
        const int status = std::system(command.c_str());
        return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
    };
    CHECK(withoutRoom("run " + kShort + "--out out") == 5);
    CHECK(nlohmann::json::parse(readText(box / "out/summary.json"))["interrupted"] == false);
    CHECK(withoutRoom("run " + kShort + "--set contact.max_overlap_ratio=1e-9 --out b") == 3);
    CHECK(withoutRoom("run nothing.toml") == 2);
    CHECK(withoutRoom("rum") == 2);
}

TEST_CASE("without a terminal --live says so and goes on with plain progress") {
    const Sandbox box;
    const auto o = box.vkdose("run " + kShort + "--live --out a");
    CHECK(o.code == 0);
    CHECK_THAT(o.err, Catch::Contains("not a terminal") && Catch::Contains("dose 2"));
    CHECK_THAT(o.out, !Catch::Contains("\033"));
    const Shown dumb = onTerminal(box, "run " + kShort + "--live --out b", "", 0, "TERM=dumb ");
    CHECK(dumb.code == 0);
    CHECK_THAT(dumb.text, Catch::Contains("TERM"));
    CHECK_THAT(dumb.text, !Catch::Contains("\033[?25l"));
    CHECK(box.vkdose("run " + kShort + "--live --quiet --out c").code == 2);
}
