// The powders that are known, and a case with one of them.
#include <nlohmann/json.hpp>

#include "host/app/find_case.h"
#include "host/core/csv_table.h"
#include "host/model/powder_file.h"
#include "tests/app/sandbox.h"
#include "tests/support/catch.h"

using namespace vkdose;
using namespace vkdose::test;

namespace {

const std::string kPowder = R"(title = "Made up"
draws = "draws.csv"
[particles]
density = 1427.0
[particles.size]
distribution = "uniform"
radius_min_mm = 0.9
radius_max_mm = 1.3
[contact]
k = 2000.0
k1_over_k = 0.2
kc_over_k = 0.3
plasticity_depth = 0.05
damping = 0.02
friction = 0.5
)";

const std::string kShort =
    "--set settle.time_s=0.02 --set settle.until_rest=false --set dose.rotate_s=0.02 --set dose.rest_s=0.005 --set "
    "stop.max_doses=1 --set contact.max_overlap_ratio=0.95 ";

}  // namespace

TEST_CASE("every powder that comes with the program is read, makes a case, and says where its figures are from") {
    const Sandbox box;
    const auto files = powderFiles({std::filesystem::path(VKDOSE_SOURCE_DIR) / "cases"});
    REQUIRE(!files.empty());
    const auto list = box.vkdose("powders");
    REQUIRE(list.code == 0);
    for (const auto& file : files) {
        CAPTURE(file);
        const PowderFile p = readPowderFile(file);
        CHECK(!p.laboratory.empty());
        CHECK(!p.limits.empty());
        CHECK_THAT(list.out, Catch::Contains(file.stem().string()) && Catch::Contains(p.title));
        const auto told = box.vkdose("powders " + file.stem().string());
        CHECK_THAT(told.out, Catch::Contains(p.laboratory[0].source) && Catch::Contains("limits"));
        for (const PowderFile::Held& h : p.held) CHECK(std::filesystem::exists(file.parent_path() / h.test));
        const auto check = box.vkdose("check mini --assume --powder " + file.stem().string());
        CAPTURE(check.out, check.err);
        CHECK(check.code == 0);
    }
    CHECK_THAT(box.vkdose("powders glas-beads").err, Catch::Contains("did you mean glass-beads?"));
    CHECK_THAT(box.vkdose("check mini --powder glas-beads").err, Catch::Contains("did you mean glass-beads?"));
}

TEST_CASE("draws of a powder are runs of their own, with intervals of what came out") {
    const Sandbox box;
    box.write("powder.toml", kPowder);
    box.write("draws.csv", "contact.friction,contact.kc_over_k\n0.4,0.2\n0.5,0.3\n0.6,0.4\n");
    const std::string command = "run mini --powder powder.toml --draws 3 --backend reference " + kShort;
    const auto o = box.vkdose(command);
    CAPTURE(o.out, o.err);
    REQUIRE(o.code == 0);
    CHECK_THAT(o.out, Catch::Contains("Made up: 3 draws") && Catch::Contains("coil.largest_torque_Nm"));
    const auto json = nlohmann::json::parse(readText(box / "out/mini-draws/prediction.json"));
    CHECK(json["draws"] == 3);
    double sum = 0;
    for (int m = 0; m < 3; ++m)
        sum += nlohmann::json::parse(readText(box / ("out/mini-draws/members/000" + std::to_string(m)) /
                                              "summary.json"))["bodies"][0]["largest_torque_Nm"]
                   .get<double>();
    for (const auto& figure : json["figures"])
        if (figure["name"] == "coil.largest_torque_Nm")
            CHECK(figure["mean"].get<double>() == Approx(sum / 3).epsilon(1e-12));
    const Table members = Table::read(box / "out/mini-draws/members.csv");
    CHECK(members.column("seed") == std::vector<double>{1, 2, 3});
    CHECK(members.column("contact.friction") == std::vector<double>{0.4, 0.5, 0.6});
    // It goes on without a run.
    const auto again = box.vkdose(command);
    CHECK(again.code == 0);
    CHECK(again.out.substr(again.out.find("Made up")) == o.out.substr(o.out.find("Made up")));
    const auto timed = box.vkdose(command + "--out timed --for 0.001s");
    CHECK(timed.code == 6);
    CHECK_THAT(timed.err, Catch::Contains("--draws 3 --out timed --set settle.time_s=0.02"));

    CHECK_THAT(box.vkdose("run mini --draws 3").err, Catch::Contains("--powder"));
    CHECK_THAT(box.vkdose("run mini --powder powder.toml --draws 4").err, Catch::Contains("has 3 rows"));
    CHECK_THAT(box.vkdose("run mini --powder glass-beads --draws 3").err,
               Catch::Contains("draws") && Catch::Contains("no distribution"));
}
