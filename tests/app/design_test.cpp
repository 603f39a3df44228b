// vkdose design on the command line.
#include <nlohmann/json.hpp>

#include "host/core/csv_table.h"
#include "tests/app/sandbox.h"
#include "tests/support/catch.h"

using namespace vkdose;
using namespace vkdose::test;

namespace {

const std::string kDesignStudy = "base = \"" VKDOSE_SOURCE_DIR "/cases/mini.toml\"\n" + std::string(R"([set]
"settle.time_s" = 0.02
"settle.until_rest" = false
"dose.rotate_s" = 0.02
"dose.rest_s" = 0.005
"stop.max_doses" = 1
"contact.max_overlap_ratio" = 0.95
[design]
max_runs = 4
confirming_seeds = 2
[[design.goal]]
figure = "coil.largest_torque_Nm"
wish = "smallest"
[[design.goal]]
figure = "dose.left_kg"
wish = "largest"
at_least = 1e-4
[[design.parameter]]
key = "coil.speed_rpm"
low = 100
high = 400
)");

std::string withPart(std::string text, const std::string& part, const std::string& by) {
    REQUIRE(text.find(part) != std::string::npos);
    return text.replace(text.find(part), part.size(), by);
}

}  // namespace

TEST_CASE("a design tries points, confirms its front, and leaves a case for each point of it") {
    const Sandbox box;
    box.write("study.toml", kDesignStudy);
    const auto dry = box.vkdose("design study.toml --dry-run --assume");
    CHECK(dry.code == 0);
    // Three points first, one more, and eight that are confirmed with two seeds.
    CHECK_THAT(dry.out, Catch::Contains("up to 17 more members at 1 more point and in confirming runs of 8 points"));

    const auto o = box.vkdose("design study.toml --backend reference --out found");
    CAPTURE(o.out, o.err);
    REQUIRE(o.code == 0);
    const auto finding = nlohmann::json::parse(readText(box / "found/design.json"));
    CHECK(Table::read(box / "found/members.csv").rows() == finding["points"].size());
    CHECK(finding["goals"][1]["at_least"] == 1e-4);
    CHECK(finding["confirming_seeds"] == nlohmann::json({2, 3}));
    REQUIRE(!finding["front"].empty());
    CHECK_THAT(o.out, Catch::Contains("goal     coil.largest_torque_Nm smallest, by") &&
                          Catch::Contains("goal     dose.left_kg largest, at least 0.0001, by") &&
                          Catch::Contains("front, by 2 runs with new seeds (2, 3):") &&
                          Catch::Contains(": on the front\n        found/design-1.toml"));
    // The figures are those of the confirming runs.
    const auto& first = finding["front"][0];
    double sum = 0;
    for (int seed = 0; seed < 2; ++seed) {
        const auto summary = nlohmann::json::parse(
            readText(box / ("found/confirm/members/000" + std::to_string(seed)) / "summary.json"));
        sum += summary["bodies"][0]["largest_torque_Nm"].get<double>();
    }
    CHECK(first["figures"][0][0].get<double>() == Approx(sum / 2).epsilon(1e-12));
    CHECK(box.vkdose("check found/design-1.toml --assume").code == 0);
    CHECK_THAT(readText(box / "found/design-1.toml"), Catch::Contains("Designed by study: 2 runs with new seeds give"));

    // It goes on without a run, and says the same.
    const auto again = box.vkdose("design study.toml --backend reference --out found");
    CHECK(again.code == 0);
    const auto findingIn = [](const std::string& out) { return out.substr(out.find("goal     ")); };
    CHECK(findingIn(again.out) == findingIn(o.out));
    CHECK_THAT(again.out, !Catch::Contains("member 0000"));
    CHECK(box.vkdose("report found").code == 0);
}

TEST_CASE("a design without a point within its bounds says so, and writes no case") {
    const Sandbox box;
    box.write("study.toml",
              withPart(withPart(kDesignStudy, "at_least = 1e-4", "at_least = 1"), "max_runs = 4", "max_runs = 3"));
    const auto o = box.vkdose("design study.toml --backend reference --out found");
    CHECK(o.code == 1);
    CHECK_THAT(o.err, Catch::Contains("no point keeps the bounds of its goals"));
    CHECK(nlohmann::json::parse(readText(box / "found/design.json"))["front"].empty());
    CHECK_FALSE(std::filesystem::exists(box / "found/design-1.toml"));
}

TEST_CASE("each kind of study is refused by the other commands, which name the right one") {
    const Sandbox box;
    box.write("study.toml", kDesignStudy);
    const auto sweep = box.vkdose("sweep study.toml");
    CHECK(sweep.code == 2);
    CHECK_THAT(sweep.err, Catch::Contains("use `vkdose design study.toml`"));
    CHECK_THAT(box.vkdose("calibrate study.toml").err, Catch::Contains("calibrate: the table is missing"));
    CHECK_THAT(box.vkdose("run study.toml").err, Catch::Contains("this is a study, not a case"));
    box.write("plain.toml", "base = \"" VKDOSE_SOURCE_DIR "/cases/mini.toml\"\nseeds = 2\n");
    CHECK_THAT(box.vkdose("design plain.toml").err, Catch::Contains("design: the table is missing"));
    box.write("study.toml", withPart(kDesignStudy, "dose.left_kg", "dose.left"));
    const auto wrong = box.vkdose("design study.toml");
    CHECK(wrong.code == 2);
    CHECK_THAT(wrong.err, Catch::Contains("did you mean \"dose.left_kg\"") && Catch::Contains("design.goal.figure"));
}

TEST_CASE("scale runs a case with larger spheres and judges its figures by the smallest") {
    const Sandbox box;
    const std::string command = "scale " VKDOSE_SOURCE_DIR
                                "/cases/mini.toml --set settle.time_s=0.02 --set settle.until_rest=false --set "
                                "dose.rotate_s=0.02 --set dose.rest_s=0.005 --set stop.max_doses=1 --set "
                                "contact.max_overlap_ratio=0.95 --sizes 1,1.2 --seeds 2 ";
    const auto dry = box.vkdose(command + "--dry-run --assume");
    CAPTURE(dry.err);
    CHECK(dry.code == 0);
    CHECK_THAT(dry.out, Catch::Contains("particles.size.scale_up 1.2, seed 2") && Catch::Contains("4 members"));
    const auto o = box.vkdose(command + "--backend reference");
    CAPTURE(o.out, o.err);
    REQUIRE(o.code == 0);
    CHECK_THAT(o.out,
               Catch::Contains("1.2x") && Catch::Contains("coil.largest_torque_Nm") && Catch::Contains("outlet"));
    const auto finding = nlohmann::json::parse(readText(box / "out/mini-scale/scale.json"));
    CHECK(finding["sizes"][1]["factor"] == 1.2);
    CHECK(finding["within"] == 0.05);
    CHECK(!finding["figures"].empty());
    CHECK(Table::read(box / "out/mini-scale/members.csv").rows() == 4);
    // It goes on without a run, and says the same.
    const auto again = box.vkdose(command + "--backend reference");
    CHECK(again.code == 0);
    CHECK(again.out.substr(again.out.find("spheres ")) == o.out.substr(o.out.find("spheres ")));
    // Without time it tells the command that goes on, with all that was given.
    const auto timed = box.vkdose(command + "--backend reference --out timed --for 0.001s");
    CHECK(timed.code == 6);
    CHECK_THAT(timed.err, Catch::Contains("--sizes 1,1.2 --seeds 2 --within 5 --out timed --set settle.time_s=0.02"));

    CHECK_THAT(box.vkdose("scale mini --sizes 2,1").err, Catch::Contains("each larger than the one before"));
    CHECK_THAT(box.vkdose("scale mini --sizes 1").err, Catch::Contains("two factors or more"));
}
