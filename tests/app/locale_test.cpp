// In a process with a decimal comma the library computes, reads and writes what it does in any other.

#include <fmt/format.h>

#include <cstdio>
#include <map>
#include <sstream>

#include "host/app/commands.h"
#include "host/app/measures.h"
#include "host/backend/vulkan/law_trial.h"
#include "host/core/number.h"
#include "host/model/case.h"
#include "host/study/member.h"
#include "host/study/study.h"
#include "tests/app/sandbox.h"
#include "tests/support/catch.h"
#include "tests/support/comma.h"

using namespace vkdose;
using namespace vkdose::test;
namespace fs = std::filesystem;

namespace {

const fs::path kCases = VKDOSE_SOURCE_DIR "/cases";
const std::vector<std::string> kShort{"settle.time_s=0.01", "dose.rotate_s=0.01",     "dose.rest_s=0.01",
                                      "stop.max_doses=1",   "frames.interval_s=0.01", "sensors.energy=true"};

void checkCommaHolds() {
    char text[8];
    std::snprintf(text, sizeof text, "%.1f", 0.5);
    REQUIRE(std::string(text) == "0,5");
    std::ostringstream stream;
    stream << 1234.5;
    REQUIRE(stream.str() == "1.234,5");
}

/// What the library makes of cases, studies and runs: texts by names, and every file that it leaves.
std::map<std::string, std::string> made(const Sandbox& box) {
    std::map<std::string, std::string> all;
    const Case c = loadCase(kCases / "mini.toml", {"particles.size.radius_min_mm=0.95"});
    all["step"] = fmt::format("{}", c.world.timeStep);
    all["case"] = c.resolved;
    all["again"] = loadResolvedCase(c.resolved, "case.toml").resolved;
    all["length"] = lengthText(measureOf(Measure::Length, "--x", "1.25mm", "1mm"));

    box.write("study.toml",
              "base = \"" + (kCases / "mini.toml").string() +
                  "\"\nseeds = 2\n[[axis]]\nkey = \"contact.friction\"\nfrom = 0.25\nto = 0.75\nsteps = 3\n");
    for (const Member& m : membersOf(readStudy(box / "study.toml")))
        all[fmt::format("member {}", m.number)] = m.caseText;

    RunOptions run;
    run.input = {kCases / "mini.toml", kShort};
    run.backend.backend = "reference";
    run.out = box / "run";
    run.quiet = true;
    REQUIRE(runCommand(run) == 0);
    ReportOptions report;
    report.sources = {box / "run"};
    report.out = box / "report.html";
    REQUIRE(reportCommand(report) == 0);
    RunOptions wet = run;  // a law in GLSL, compiled for the device
    wet.input = {kCases / "laws/liquid-bridge.toml", {}};
    wet.backend.backend = "vulkan";
    wet.out = box / "wet";
    tryLawsOnDevices();
    REQUIRE(runCommand(wet) == 0);
    for (const auto& entry : fs::recursive_directory_iterator(box.path())) {
        const std::string name = entry.path().lexically_relative(box.path()).string();
        if (entry.is_regular_file() && entry.path().filename() != "summary.json") all[name] = readText(entry.path());
    }
    return all;
}

}  // namespace

TEST_CASE("a number is read and written without the locale") {
    const DecimalComma comma;
    checkCommaHolds();
    CHECK(numberOf("0.5") == 0.5);
    CHECK(numberOf("-1.5e-3") == -1.5e-3);
    for (const char* none : {"", "0,5", "1.234,5", " 1", "1 ", "+1", "1x", "0x10"}) CHECK_FALSE(numberOf(none));
    CHECK(wholeNumberOf("1234") == 1234);
    for (const char* none : {"", "-1", "1.0", "1.234", "1 "}) CHECK_FALSE(wholeNumberOf(none));
    CHECK(nearestDecimal(0.123456, 3) == 0.123);
    CHECK(nearestDecimal(1234.5, 2) == 1200);
    CHECK(nearestDecimal(-2.6e-9, 1) == -3e-9);
}

TEST_CASE("in a process with a decimal comma cases, studies, runs and reports are the same") {
    const Folder above;
    std::map<std::string, std::string> plain, other;
    {
        const Sandbox box;
        plain = made(box);
    }
    {
        const DecimalComma comma;
        const Sandbox box;
        checkCommaHolds();
        other = made(box);
    }
    REQUIRE(plain.size() == other.size());
    for (const auto& [name, text] : plain) {
        CAPTURE(name);
        CHECK(other[name] == text);
    }
}

TEST_CASE("a user's locale does not reach the program") {
    const DecimalComma comma;
    const Sandbox box;
    const std::string run = "run '" + (kCases / "mini.toml").string() +
                            "' --backend reference --quiet --set settle.time_s=0.01 --set dose.rotate_s=0.01 --set "
                            "stop.max_doses=1 --out ";
    REQUIRE(box.vkdose(run + "plain", "env -u LOCPATH LC_ALL=C ").code == 0);
    REQUIRE(box.vkdose(run + "comma", "LC_ALL=de_DE LC_NUMERIC=de_DE ").code == 0);
    for (const char* name : {"case.toml", "timeseries.csv", "doses.csv", "particles.csv"})
        CHECK(readText(box / "plain" / name) == readText(box / "comma" / name));
}
