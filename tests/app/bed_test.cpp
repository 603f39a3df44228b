// A study settles once for each distinct bed, and its members are as if each had settled.

#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <thread>

#include "host/output/checkpoint.h"
#include "tests/app/sandbox.h"
#include "tests/app/sweep_tables.h"
#include "tests/support/catch.h"

using namespace vkdose;
using namespace vkdose::test;
namespace fs = std::filesystem;

namespace {

/// Two frictions, which act while the powder settles, and of each two adhesions of the doses with two speeds, which do
/// not.
const std::string kStudy = R"(base = ")" VKDOSE_SOURCE_DIR R"(/cases/mini.toml"
[set]
"stop.max_doses" = 2
settle.time_s = 0.03
dose.rotate_s = 0.05
dose.rest_s = 0.01
sensors.interval_s = 0.003
field = [{preset = "height-profile"}, {preset = "outlet", average = true}]
[[axis]]
key = "contact.friction"
values = [0.2, 0.4]
[[axis]]
keys = ["contact.kc_over_k", "coil.speed_rpm", "dose.ramp_s"]
values = [[0.5, 120, 0], [0.9, 60, 0.01]]
)";

/// The summary without what depends on the clock.
nlohmann::json timelessSummary(const fs::path& run) {
    auto summary = nlohmann::json::parse(readText(run / "summary.json"));
    summary.erase("particle_steps_per_second");
    summary.erase("stepping_wall_time_s");
    return summary;
}

/// Every member of `sweep` as it is if it is run by itself.
void checkAsIfAlone(const Sandbox& box, const std::string& sweep, const std::string& backend) {
    for (const char* member : {"0000", "0001", "0002", "0003"}) {
        const fs::path shared = box / sweep / "members" / member, alone = box / ("alone-" + std::string(member));
        CAPTURE(member);
        if (!fs::exists(alone))
            REQUIRE(box.vkdose("run " + sweep + "/members/" + member + "/case.toml --quiet " + backend +
                               " --out alone-" + member)
                        .code == 0);
        for (const char* name : {"case.toml", "timeseries.csv", "doses.csv", "particles.csv",
                                 "fields/height-profile.csv", "fields/outlet.csv"}) {
            CAPTURE(name);
            REQUIRE(fs::exists(alone / name));
            CHECK(readText(shared / name) == readText(alone / name));
        }
        CHECK(timelessSummary(shared) == timelessSummary(alone));
        CHECK_FALSE(fs::exists(shared / kCheckpointName));
        CHECK_FALSE(fs::exists(shared / kSettledName));
    }
}

}  // namespace

TEST_CASE("members with one bed are as if each had settled, to the byte", "[slow]") {
    const Sandbox box;
    box.write("study.toml", kStudy);
    SECTION("in processes, told in the plan") {
        const auto dry = box.vkdose("sweep study.toml --dry-run --assume");
        CHECK_THAT(dry.out, Catch::Contains("seed 1, bed 0000") && Catch::Contains("seed 1, bed 0002") &&
                                Catch::Contains("2 beds settle once, for 4 members, which saves up to") &&
                                Catch::Contains("run time") && Catch::Contains("at an assumed"));
        const auto o = box.vkdose("sweep study.toml --backend reference --jobs 2 --out out");
        CAPTURE(o.err);
        REQUIRE(o.code == 0);
        CHECK_THAT(o.out, Catch::Contains("2 beds settle once, for 4 members"));
        CHECK(fs::exists(box / "out/beds/0000" / kSettledName));
        CHECK(fs::exists(box / "out/beds/0002" / kSettledName));
        CHECK_FALSE(fs::exists(box / "out/beds/0001"));
        checkAsIfAlone(box, "out", "--backend reference");
        // A bed serves other runs as well.
        CHECK(box.vkdose("run --from out/beds/0000 --set dose.rotate_s=0.02 --set coil.speed_rpm=60 --set "
                         "stop.max_doses=1 --quiet --out more")
                  .code == 0);
        // The wall time of the settling is the bed's alone.
        const auto member = nlohmann::json::parse(readText(box / "out/members/0001/summary.json"));
        const double made = double(member["particle_steps_per_second"]) * double(member["stepping_wall_time_s"]);
        CHECK(made < 0.9 * double(member["particle_steps"]));
    }
    SECTION("on an ensemble") {
        const auto o = box.vkdose("sweep study.toml --ensemble 3 --out out");
        CAPTURE(o.err);
        REQUIRE(o.code == 0);
        CHECK_THAT(o.out, Catch::Contains("2 beds settle once, for 4 members"));
        checkAsIfAlone(box, "out", "");
    }
}

TEST_CASE("a sweep that is interrupted while its beds settle goes on to the same tables", "[slow]") {
    const Sandbox box;
    std::string study = kStudy;
    study.insert(study.find("settle.time_s"), "checkpoint.time_s = 0.003\n");
    box.write("study.toml", study);
    REQUIRE(box.vkdose("sweep study.toml --backend reference --quiet --out whole").code == 0);
    const int signal = GENERATE(SIGKILL, SIGINT);
    const pid_t sweep = box.start({"sweep", "study.toml", "--backend", "reference", "--jobs", "2", "--out", "cut"});
    while (!fs::exists(box / "cut/beds/0000" / kCheckpointName)) {
        if (waitpid(sweep, nullptr, WNOHANG) == sweep) FAIL("the sweep ended before it could be cut short");
        std::this_thread::yield();
    }
    kill(sweep, signal);
    waitpid(sweep, nullptr, 0);
    const auto on = box.vkdose("sweep study.toml --backend reference --jobs 2 --out cut");
    CAPTURE(signal, on.err);
    CHECK(on.code == 0);
    CHECK(timeless(box / "cut") == timeless(box / "whole"));
    CHECK(readText(box / "cut/doses.csv") == readText(box / "whole/doses.csv"));
}

TEST_CASE("members settle by themselves where beds differ, where frames are kept, and where a bed fails") {
    const Sandbox box;
    const auto beds = [&](const std::string& set) {
        std::string study = kStudy;
        study.insert(study.find("settle.time_s"), set + "\n");
        box.write("study.toml", study);
        return box.vkdose("sweep study.toml --dry-run --assume").out;
    };
    CHECK_THAT(beds(""), Catch::Contains("2 beds"));
    CHECK_THAT(beds("frames.interval_s = 0.02"), !Catch::Contains("bed"));
    CHECK_THAT(beds("stop.end_time_s = 0.02"), !Catch::Contains("bed"));
    // Another adhesion while the powder settles is another bed.
    std::string study = kStudy;
    study.replace(study.find("\"contact.kc_over_k\", \"coil"), 19, "\"settle.kc_over_k\"");
    box.write("study.toml", study);
    CHECK_THAT(box.vkdose("sweep study.toml --dry-run --assume").out, !Catch::Contains("bed"));
    study = kStudy;
    study.insert(study.find("settle.time_s"), "contact.max_overlap_ratio = 1e-9\n");
    box.write("study.toml", study);
    const auto o = box.vkdose("sweep study.toml --backend reference --jobs 2");
    CHECK(o.code == 1);
    CHECK_THAT(o.out, Catch::Contains("0 done, 4 failed"));
    CHECK_THAT(o.err, Catch::Contains("member 0003") && Catch::Contains("overlap"));
}

TEST_CASE("a value of every member is replaced on the command line, and the sweep goes on with it") {
    const Sandbox box;
    box.write("study.toml", kStudy);
    const std::string arguments = "sweep study.toml --backend reference --jobs 2 --out out ";
    const auto o = box.vkdose(arguments + "--set stop.max_doses=1 --set dose.rest_s=0.005 --set settle.time_s=0.01");
    CAPTURE(o.err);
    REQUIRE(o.code == 0);
    const Table members = Table::salvage(box / "out/members.csv");
    REQUIRE(members.rows() == 4);
    for (std::size_t i = 0; i < 4; ++i) CHECK(members.text(i, "doses") == "1");
    CHECK_THAT(readText(box / "out/members/0003/case.toml"),
               Catch::Contains("max_doses = 1") && Catch::Contains("rest_s = 0.005"));
    CHECK_THAT(readText(box / "out/study.toml"), Catch::Contains("# --set stop.max_doses=1"));
    CHECK_THAT(box.vkdose(arguments).err, Catch::Contains("member"));  // other members than those that are there
    const auto varied = box.vkdose(arguments + "--set contact.friction=0.3 --set seed=4");
    CHECK(varied.code == 2);
    CHECK_THAT(varied.err, Catch::Contains("contact.friction = 0.3: is a key that the study varies") &&
                               Catch::Contains("seed = 4"));
    CHECK(box.vkdose("report out").code == 0);
}
