// The program as a user meets it: arguments in; exit code, text and files out.

#include <sys/types.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

#include "tests/app/list_of_commands.h"
#include "tests/app/sandbox.h"
#include "tests/support/catch.h"

using namespace vkdose::test;
namespace fs = std::filesystem;

namespace {

const std::string kMini = "'" VKDOSE_SOURCE_DIR "/cases/mini.toml' ";

/// The mini canister cut to a few hundred steps.
const std::string kShort =
    kMini + "--set settle.time_s=0.01 --set dose.rotate_s=0.005 --set dose.rest_s=0.002 --set stop.max_doses=2 ";

/// One sphere falls out of its domain, 10 cm deep, after 0.14 s.
const std::string kFalls = R"(name = "falls"
boundaries = "none"
[particles]
density = 1427.0
list = "list.csv"
[contact]
k = 2000.0
k1_over_k = 0.2
kc_over_k = 0.0
plasticity_depth = 0.05
damping = 0.0827
friction = 0.5
[domain]
low = [-0.1, -0.1, -0.1]
high = [0.1, 0.1, 0.1]
[settle]
time_s = 1.0
[sensors]
interval_s = 0.01
)";

}  // namespace

TEST_CASE("help and usage") {
    const Sandbox box;
    const auto help = box.vkdose("--help");
    CHECK(help.code == 0);
    for (const char* word : {"run", "resume", "sweep", "calibrate", "check", "devices", "profile", "manual", "test"})
        CHECK_THAT(help.out, Catch::Contains(word));
    CHECK(box.vkdose("run --help").code == 0);
    CHECK_THAT(box.vkdose("--version").out, Catch::StartsWith("vkdose "));
    for (const char* bad : {"fly", "run", "run x.toml --backend cuda", "run x.toml --nonsense", "test", "test fly",
                            "test compare x.toml --steps 5 --time 1", "test compare x.toml --steps 0"}) {
        const auto o = box.vkdose(bad);
        CAPTURE(bad, o.err);
        CHECK(o.code == 2);
        CHECK_FALSE(o.err.empty());
        CHECK(o.out.empty());
    }
    CHECK(box.files().empty());
    // The culprit by its name: the word that is no command, the command that lacks something.
    CHECK_THAT(box.vkdose("rnu x.toml").err, Catch::Contains("there is no command rnu; did you mean run?"));
    CHECK_THAT(box.vkdose("verify --list").err,
               Catch::Contains("there is no command verify; did you mean test verify?"));
    CHECK_THAT(box.vkdose("test run x.toml").err,
               Catch::Contains("vkdose test: there is no command run; did you mean run?"));
    CHECK_THAT(box.vkdose("manual").err,
               Catch::StartsWith("vkdose manual: ") && Catch::Contains("`vkdose manual --help`"));
    CHECK_THAT(box.vkdose("test --help").out, Catch::Contains("verify") && Catch::Contains("compare"));
    CHECK_THAT(box.vkdose("run").err, Catch::Contains("a case is missing") && Catch::Contains("--from DIR"));
    const auto alone = box.vkdose("");
    CHECK(alone.code == 0);
    CHECK_THAT(alone.out, Catch::Contains("vkdose run quickstart") && Catch::Contains("calibrate"));
}

TEST_CASE("every command has examples, whose options it knows") {
    const Sandbox box;
    int found = 0;
    for (const std::string& name : commandsOf(box)) {
        CAPTURE(name);
        ++found;
        const std::string help = box.vkdose(name + " --help").out;
        const std::size_t examples = help.find("Examples:");
        REQUIRE(examples != std::string::npos);
        CHECK_THAT(help.substr(examples), Catch::Contains("vkdose " + name));
        std::istringstream words(help.substr(examples));
        for (std::string word; words >> word;)
            if (word.rfind("--", 0) == 0)
                CHECK_THAT(help.substr(0, examples), Catch::Contains(word.substr(0, word.find('='))));
    }
    CHECK(found > 10);
}

TEST_CASE("a case or a study is found by its name") {
    const Sandbox box;
    CHECK_THAT(box.vkdose("check mini").out, Catch::Contains("case       mini"));
    CHECK_THAT(box.vkdose("check mini.toml").out, Catch::Contains("case       mini"));
    CHECK(box.vkdose("sweep coarse-none --dry-run").code == 2);
    CHECK_THAT(box.vkdose("sweep strong-cohesion --dry-run").out, Catch::Contains("member 0000"));
    CHECK_THAT(box.vkdose("check quickstrat").err, Catch::Contains("did you mean quickstart?"));
    CHECK_THAT(box.vkdose("sweep strong-cohesoin").err, Catch::Contains("did you mean strong-cohesion?"));
    // A file of one's own comes first, and a folder of that name is none.
    box.write("own", readText(VKDOSE_SOURCE_DIR "/cases/mini.toml") + "");
    CHECK(box.vkdose("check own").code == 0);
    fs::create_directories(box / "mini");
    CHECK(box.vkdose("check mini").code == 0);
    fs::create_directories(box / "cases");
    box.write("cases/mini.toml", "base = \"" VKDOSE_SOURCE_DIR "/cases/mini.toml\"\nname = \"mine\"\n");
    CHECK_THAT(box.vkdose("check mini").out, Catch::Contains("case       mine"));
}

TEST_CASE("a bad case is refused with exit code 2 and nothing written") {
    const Sandbox box;
    struct Bad {
        std::string arguments;
        std::string says;
    };
    const std::vector<Bad> all{
        {"missing.toml", "missing.toml"},
        {kMini + "--set canister.lenght_mm=3", "length_mm"},
        {kMini + "--set contact.k=-1", "contact.k"},
        {kMini + "--set contact.k=nan", "contact.k"},
        {kMini + "--set contact.k=stiff", "contact.k"},
        {kMini + "--set particles.mass_g=500", "mass_g"},
        {kMini + "--set coil.radius_mm=9", "radius_mm"},
        {kMini + "--set time.step_s=1e-3", "step_s"},
        {kMini + "--set nonsense", "nonsense"},
    };
    for (const Bad& bad : all) {
        for (const char* command : {"run --backend reference --out out ", "check ", "test compare "}) {
            const auto o = box.vkdose(command + bad.arguments);
            CAPTURE(command, bad.arguments, o.err);
            CHECK(o.code == 2);
            CHECK_THAT(o.err, Catch::Contains(bad.says));
            CHECK(o.out.empty());
        }
    }
    CHECK(box.files().empty());
}

TEST_CASE("every fault of a case is one line of its own") {
    const Sandbox box;
    const auto o = box.vkdose("check " + kMini + "--set contact.k=-1 --set particles.density=-5");
    CHECK(o.code == 2);
    CHECK(std::count(o.err.begin(), o.err.end(), '\n') >= 2);
    CHECK_THAT(o.err, Catch::Contains("density") && Catch::Contains("contact.k"));
}

TEST_CASE("check prints what the case implies") {
    const Sandbox box;
    const auto o = box.vkdose("check '" VKDOSE_SOURCE_DIR "/cases/paper-48g.toml'");
    CHECK(o.code == 0);
    CHECK(o.err.empty());
    for (const char* words : {"particle-particle", "particle-wall", "particle-coil", "1.73e-05", "0.0001129",
                              "13.13 mm/s", "98.02 mm/s", "4.201 g", "11.4"}) {
        CHECK_THAT(o.out, Catch::Contains(words));
    }
    CHECK(box.files().empty());
}

TEST_CASE("check warns, and other programs can read it") {
    const Sandbox box;
    const std::string slips = kMini + "--set settle.time_s=0.01 --set coil.speed_rpm=0";
    const auto o = box.vkdose("check " + slips);
    CHECK(o.code == 0);
    CHECK_THAT(o.out, Catch::Contains("warning    settle.time_s = 0.01: ") && Catch::Contains("(settle-time)") &&
                          Catch::Contains("warning    coil.speed_rpm = 0: ") &&
                          Catch::Contains("accepted   contact.max_overlap_ratio = 0.2: "));
    const auto read = nlohmann::json::parse(box.vkdose("check --json " + slips).out);
    CHECK(read["case"] == "mini");
    CHECK(read["errors"].empty());
    REQUIRE(read["warnings"].size() == 3);
    for (const auto& w : read["warnings"]) {
        for (const char* part : {"name", "key", "value", "text", "cure"})
            CHECK_FALSE(w[part].get<std::string>().empty());
        CHECK(w["accepted"] == (w["name"] == "pinch"));
    }
    CHECK(read["figures"]["particles"] == 111);
    CHECK(read["figures"]["dose_kg"].is_null());

    const auto bad = box.vkdose("check --json " + kMini + "--set contact.k=-1 --set particles.density=-5");
    CHECK(bad.code == 2);
    const auto faults = nlohmann::json::parse(bad.out);
    REQUIRE(faults["errors"].size() == 2);
    CHECK(faults["errors"][0]["key"] == "particles.density");
    CHECK(faults["errors"][0]["value"] == "-5");
    CHECK(faults["warnings"].empty());
}

TEST_CASE("a run tells its warnings once, and ends with what to do next") {
    const Sandbox box;
    const auto o = box.vkdose("run " + kShort + "--backend reference --out 'my run'");
    CAPTURE(o.err);
    REQUIRE(o.code == 0);
    const std::string mark = "vkdose: warning: settle.time_s = 0.01: ";
    const std::size_t at = o.err.find(mark);
    REQUIRE(at != std::string::npos);
    CHECK(o.err.find(mark, at + 1) == std::string::npos);
    CHECK(o.err.find("(pinch)") == std::string::npos);  // mini accepts it
    CHECK_THAT(o.out, Catch::Contains("next     vkdose report 'my run'"));
}

TEST_CASE("a device is for the vulkan backend only") {
    const Sandbox box;
    const auto o = box.vkdose("run " + kShort + "--backend reference --device 0 --out out");
    CHECK(o.code == 2);
    CHECK_THAT(o.err, Catch::Contains("--device"));
    CHECK(box.files().empty());
}

TEST_CASE("a device that is not there is a device error, and nothing is written") {
    const Sandbox box;
    const auto o = box.vkdose("run " + kShort + "--device 'no such thing' --out out");
    CHECK(o.code == 4);
    CHECK_FALSE(o.err.empty());
    CHECK(box.files().empty());
}

TEST_CASE("an output folder is named after the case, and never overwritten by accident") {
    const Sandbox box;
    const auto first = box.vkdose("run " + kShort + "--backend reference");
    CAPTURE(first.err);
    REQUIRE(first.code == 0);
    CHECK(fs::exists(box / "out/mini/summary.json"));
    const auto second = box.vkdose("run " + kShort + "--backend reference");
    CHECK(second.code == 2);
    CHECK_THAT(second.err, Catch::Contains("--force"));
    const auto third = box.vkdose("run " + kShort + "--backend reference --force --quiet");
    CHECK(third.code == 0);
    CHECK(third.out.empty());
    CHECK(third.err.empty());
}

TEST_CASE("an override is in the resolved case, and the resolved case runs again") {
    const Sandbox box;
    REQUIRE(box.vkdose("run " + kShort + "--backend reference --out a --set seed=5").code == 0);
    const auto again = box.vkdose("run a/case.toml --backend reference --out b");
    CAPTURE(again.err);
    REQUIRE(again.code == 0);
    CHECK(readText(box / "a/particles.csv") == readText(box / "b/particles.csv"));
    CHECK(readText(box / "a/timeseries.csv") == readText(box / "b/timeseries.csv"));
    REQUIRE(box.vkdose("run " + kShort + "--backend reference --out c --set seed=6").code == 0);
    CHECK(readText(box / "a/particles.csv") != readText(box / "c/particles.csv"));
}

TEST_CASE("a particle that leaves the domain is a run error that keeps what was computed") {
    const Sandbox box;
    box.write("list.csv", "x,y,z,r\n0,0.001,0,0.001\n");
    box.write("falls.toml", kFalls);
    const auto o = box.vkdose("run falls.toml --backend reference --out out");
    CAPTURE(o.err);
    CHECK(o.code == 3);
    CHECK_THAT(o.err, Catch::Contains("particle 0"));
    const auto summary = nlohmann::json::parse(readText(box / "out/summary.json"));
    CHECK(summary["stop_reason"] == "run_error");
    CHECK(readCsv(box / "out/timeseries.csv").size() > 2);
}

TEST_CASE("Ctrl-C ends a run with what was computed") {
    const Sandbox box;
    const pid_t child = box.start({"run", VKDOSE_SOURCE_DIR "/cases/mini.toml", "--backend", "reference", "--quiet",
                                   "--set", "settle.time_s=1000", "--out", "out"});
    REQUIRE(child > 0);
    int status = 0;
    bool ended = false;
    while (!ended && readCsv(box / "out/timeseries.csv").size() < 2) {
        ended = waitpid(child, &status, WNOHANG) == child;
        std::this_thread::yield();
    }
    REQUIRE_FALSE(ended);
    kill(child, SIGINT);
    waitpid(child, &status, 0);
    REQUIRE(WIFEXITED(status));
    CHECK(WEXITSTATUS(status) == 130);
    const auto summary = nlohmann::json::parse(readText(box / "out/summary.json"));
    CHECK(summary["interrupted"] == true);
    CHECK(summary["stop_reason"] == "interrupted");
    CHECK(fs::exists(box / "out/particles.csv"));
}

TEST_CASE("export-body writes the coil of a case") {
    const Sandbox box;
    const std::string paper = "export-body '" VKDOSE_SOURCE_DIR "/cases/paper-48g.toml' ";
    const auto outcome = box.vkdose(paper + "--out c.stl --around 12 --per-turn 20");
    INFO(outcome.out << outcome.err);
    REQUIRE(outcome.code == 0);
    // 160 pieces of 24, two ends of 10
    CHECK_THAT(outcome.out, Catch::Contains("coil: 3860 triangles in c.stl, lengths in mm"));
    CHECK(fs::file_size(box / "c.stl") == 84 + 50 * 3860);
    CHECK(box.vkdose(paper + "--out no/c.stl").code == 5);
    const auto none = box.vkdose(paper + "screw");
    CHECK(none.code == 2);
    CHECK_THAT(none.err, Catch::Contains("no \"screw\"; give one of: coil"));
    const auto other = box.vkdose("export-body " + kMini + "--out coil.obj");
    CHECK(other.code == 2);
    CHECK_THAT(other.err, Catch::Contains("writes an STL mesh; give a name that ends in .stl"));
    CHECK_FALSE(fs::exists(box / "coil.obj"));
}
