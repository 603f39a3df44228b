// [[refill]] on the command line: what is told, what a run leaves, and what goes on from there.

#include <nlohmann/json.hpp>

#include "host/output/checkpoint.h"
#include "tests/app/sandbox.h"
#include "tests/support/catch.h"

using namespace vkdose;
using namespace vkdose::test;
namespace fs = std::filesystem;

namespace {

/// cases/mini.toml with two short doses and a refill that comes when `when` says.
void writeCase(const Sandbox& box, const std::string& when) {
    const std::string base = "base = \"" VKDOSE_SOURCE_DIR "/cases/mini.toml\"\nname = \"top\"\n";
    box.write("top.toml", base + R"(
[coil]
speed_rpm = 400
[settle]
time_s = 0.05
[dose]
rotate_s = 0.06
rest_s = 0.02
[stop]
max_doses = 2
[sensors]
interval_s = 0.003
[frames]
interval_s = 0.03
[[refill]]
name = "spoon"
mass_g = 0.4
)" + when);
}

nlohmann::json refillOf(const fs::path& folder) {
    return nlohmann::json::parse(readText(folder / "summary.json"))["refills"][0];
}

}  // namespace

TEST_CASE("a refill is told before, during and after the run, and is there for the run that goes on from its bed") {
    const Sandbox box;
    writeCase(box, "before_dose = 2\n");
    CHECK_THAT(box.vkdose("check top.toml --assume").out,
               Catch::Contains("refill     spoon: 51, 0.4021 g, before dose 2"));
    const auto run = box.vkdose("run top.toml --out a");
    CAPTURE(run.err);
    REQUIRE(run.code == 0);
    CHECK_THAT(run.err, Catch::Contains("refill spoon: 0.402 g in 51 spheres, at t = 0.129993 s"));
    CHECK_THAT(run.out, Catch::Contains("refill   spoon: 0.402 g in 51 spheres, at t = 0.129993 s"));
    CHECK(refillOf(box / "a")["particles"] == 51);
    CHECK(refillOf(box / "a")["time_s"].get<double>() == Approx(0.13).margin(1e-4));
    CHECK(readText(box / "a/particles.csv").find("waiting") == std::string::npos);
    REQUIRE(box.vkdose("run --from a --quiet --out b").code == 0);
    CHECK(readText(box / "a/doses.csv") == readText(box / "b/doses.csv"));
    CHECK(readText(box / "a/particles.csv") == readText(box / "b/particles.csv"));
    // From the end of this run its powder goes on, with the refill in it.
    const auto on = box.vkdose("run --from a --at end --quiet --out c");
    CAPTURE(on.err);
    CHECK(on.code == 0);
}

TEST_CASE("an inlet of many refills is told in one line, and the speed of its few first spheres with a caveat") {
    const Sandbox box;
    writeCase(box, "time_s = 0.06\nevery_s = 0.01\ntimes = 5\n");
    const std::string many = box.vkdose("check top.toml --assume").out;
    CHECK_THAT(many, Catch::Contains("refill     spoon-1 to spoon-5: ") &&
                         Catch::Contains(" g in all, from t = 0.06 s to 0.1 s\n"));
    CHECK_THAT(many, !Catch::Contains("spoon-2"));
    const auto run = box.vkdose("run top.toml --out many");
    CAPTURE(run.err);
    REQUIRE(run.code == 0);
    CHECK_THAT(run.err, Catch::Contains("refill spoon-1: ") && Catch::Contains(" at t = 0.06") &&
                            Catch::Contains("; the end of the run tells all 5 together\n") &&
                            !Catch::Contains("spoon-2"));
    CHECK_THAT(run.out, Catch::Contains("refill   spoon-1 to spoon-5: ") &&
                            Catch::Contains(" spheres, from t = 0.06") && !Catch::Contains("spoon-2"));
    CHECK(nlohmann::json::parse(readText(box / "many/summary.json"))["refills"].size() == 5);
    REQUIRE(box.vkdose("report many").code == 0);
    CHECK_THAT(readText(box / "many/report.html"),
               Catch::Contains("\"refill spoon-1 to spoon-5\"") && !Catch::Contains("\"refill spoon-2\""));
    const std::string caveat = " particles of the fill; refills make them ";
    CHECK_THAT(many, !Catch::Contains(caveat));  // nothing was measured
    const std::string few = " --set particles.mass_g=0.02 --backend reference";
    CHECK_THAT(box.vkdose("check top.toml" + few).out, Catch::Contains(caveat));
    writeCase(box, "before_dose = 2\n");
    CHECK_THAT(box.vkdose("check top.toml --backend reference").out, !Catch::Contains(caveat));
}

TEST_CASE("a hopper is topped up at its mark, and an inlet brings powder at a rate") {
    const Sandbox box;
    writeCase(box, R"(below_g = 0.87
region = "hopper"
times = 2
[[refill]]
name = "inlet"
mass_g = 0.05
time_s = 0.06
every_s = 0.02
times = 3
[[region]]
name = "hopper"
kind = "box"
low = [-0.007, -0.007, 0.0]
high = [0.007, 0.05, 0.016]
deletes = false
)");
    const auto check = box.vkdose("check top.toml --assume");
    CHECK_THAT(check.out, Catch::Contains("refill     spoon-2: 48, 0.395 g, when hopper holds less than 0.87 g"));
    const auto run = box.vkdose("run top.toml --out a");
    CAPTURE(run.err);
    REQUIRE(run.code == 0);
    const auto summary = nlohmann::json::parse(readText(box / "a/summary.json"));
    REQUIRE(summary["refills"].size() == 5);
    CHECK(summary["refills"][0]["time_s"].get<double>() > 0.05);
    for (std::size_t k = 0; k < 3; ++k) {
        const auto& inlet = summary["refills"][k + 2];
        CHECK(inlet["name"] == "inlet-" + std::to_string(k + 1));
        CHECK(inlet["time_s"].get<double>() == Approx(0.06 + 0.02 * double(k)).margin(0.0031));
    }
    // It goes on from the settled bed with the same bits.
    REQUIRE(box.vkdose("run --from a --quiet --out b").code == 0);
    CHECK(readText(box / "a/doses.csv") == readText(box / "b/doses.csv"));
    CHECK(readText(box / "a/particles.csv") == readText(box / "b/particles.csv"));
}

TEST_CASE("powder that was not added shows nowhere") {
    const Sandbox box;
    writeCase(box, "");
    REQUIRE(box.vkdose("run top.toml --quiet --out never").code == 0);
    CHECK(refillOf(box / "never")["time_s"].is_null());
    const std::string end = readText(box / "never/particles.csv");
    CHECK(std::count(end.begin(), end.end(), 'w') >= 51);
    CHECK_THAT(end, Catch::Contains(",waiting\n"));
    REQUIRE(box.vkdose("run top.toml --quiet --set refill=[] --out without").code == 0);
    for (const char* name : {"timeseries.csv", "doses.csv"})
        CHECK(readText(box / "never" / name) == readText(box / "without" / name));
    CHECK(box.vkdose("report never").code == 0);
    CHECK(box.vkdose("render never --size 320x240 --out never.png").code == 0);
}
