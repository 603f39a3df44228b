#include "host/report/study_report.h"

#include <cmath>
#include <tuple>

#include "host/core/error.h"
#include "host/report/study_points.h"
#include "tests/report/folders.h"
#include "tests/support/catch.h"
#include "tests/support/near.h"

using namespace vkdose;
using namespace vkdose::report;
using namespace vkdose::test;

namespace {

std::vector<StudyPoint> pointsIn(const std::filesystem::path& folder) {
    const Table members = Table::read(folder / "members.csv");
    const StudyHead head = readHead(folder, members);
    return readPoints(folder, head, members);
}

}  // namespace

TEST_CASE("members that differ in the seed alone make a point") {
    const Sandbox box;
    const auto points = pointsIn(writeSweep(box));
    REQUIRE(points.size() == 4);
    CHECK(points[0].finished == 2);
    CHECK(nearRelative(points[0].beta, 4.9e-3, 1e-12));
    CHECK(nearRelative(points[0].betaError, 0.1e-3, 1e-9));  // 0.2/sqrt(2) over sqrt(2)
    CHECK(points[0].errorOverSeeds);
    CHECK(nearRelative(points[0].doses.at(0).mean, 5e-3, 1e-12));
    CHECK(nearRelative(points[0].doses.at(0).standardError, 1e-3, 1e-9));
    CHECK(nearRelative(points[0].point.cumulative.at(1), 10e-3, 1e-12));
}

TEST_CASE("points stand in the order of their numbers, and of the study where they have none") {
    const Sandbox box;
    std::filesystem::create_directories(box / "sweep");
    box.write("sweep/study.toml",
              "[[axis]]\nkey = \"canister.floor\"\nvalues = [\"trough\", \"flat\"]\n"
              "[[axis]]\nkey = \"contact.kc_over_k\"\nvalues = [0.873, 10.0, 0.0]\n");
    // As members end, which is no order of the study.
    box.write("sweep/members.csv",
              "member,seed,canister.floor,contact.kc_over_k,status,error\n"
              "3,1,flat,0.873,ok,\n1,1,trough,10.0,ok,\n0,1,trough,0.873,ok,\n2,1,trough,0.0,ok,\n");
    std::vector<std::string> order;
    for (const StudyPoint& p : pointsIn(box / "sweep")) {
        order.push_back("");
        for (const auto& place : p.point.places) order.back() += place.label + " ";
    }
    CHECK(order == std::vector<std::string>{"trough 0.0 ", "trough 0.873 ", "trough 10.0 ", "flat 0.873 "});
}

TEST_CASE("with one seed the error is the slope's own, and failed members are counted, not averaged") {
    const Sandbox box;
    const auto last = pointsIn(writeSweep(box)).at(3);
    CHECK(last.finished == 1);
    CHECK(last.failed == 1);
    CHECK(nearRelative(last.beta, 3.6e-3, 1e-12));
    CHECK(nearRelative(last.betaError, 0.1e-3, 1e-12));
    CHECK_FALSE(last.errorOverSeeds);
    CHECK(last.errors == std::vector<std::string>{"particle 3 at (0, 0, 1) \"left\" the domain"});
}

TEST_CASE("conditions of a point: column, then resolved case, and without it what the study sets, then base") {
    const Sandbox box;
    const auto folder = writeSweep(box);
    auto keys = pointsIn(folder).at(0).point.keys;
    CHECK(keys.at("contact.kc_over_k").number == 0.2);
    CHECK(keys.at("dose.rotate_s").number == 2);  // [set], not the base's 1
    CHECK(keys.at("coil.turns").number == 8);
    std::filesystem::create_directories(folder / "members/0000");
    box.write("sweep/members/0000/case.toml", "[coil]\nturns = 6\nhand = \"left\"\n[contact]\nkc_over_k = 0.9\n");
    keys = pointsIn(folder).at(0).point.keys;
    CHECK(keys.at("coil.turns").number == 6);
    CHECK(keys.at("coil.hand").text == "left");
    CHECK(keys.at("contact.kc_over_k").number == 0.2);
    CHECK_FALSE(keys.contains("dose.rotate_s"));  // the member's case has another key in its place
}

TEST_CASE("beta is taken from the doses where the table has none") {
    const Sandbox box;
    const auto folder = writeSweep(box);
    std::string rows = readText(folder / "members.csv");
    for (const char* given : {",0.0048,0.0001,", ",0.005,0.0001,"})
        rows.replace(rows.find(given), std::string(given).size(), ",,,");
    box.write("sweep/members.csv", rows);
    const StudyPoint first = pointsIn(folder).at(0);
    CHECK(nearRelative(first.beta, 5e-3, 1e-12));  // both members: 5 g from the first to the second dose
}

TEST_CASE("where no slope is known, the window of the doses is that of the run: less than 80 % of the fill") {
    const Sandbox box;
    std::filesystem::create_directories(box / "sweep");
    box.write("sweep/members.csv",
              "member,seed,contact.friction,status,error,filled_mass_kg,beta_kg_per_dose\n0,1,0.5,ok,,0.013,\n");
    box.write("sweep/doses.csv", dosesTable("0,1,0.5,1,2,0.005,0.005,300,0.01,0.0042,1\n"
                                            "0,1,0.5,2,4.5,0.004,0.009,300,0.01,0.0042,1\n"
                                            "0,1,0.5,3,7,0.003,0.012,300,0.01,0.0042,1\n",
                                            "member,seed,contact.friction,"));
    const StudyPoint only = pointsIn(box / "sweep").at(0);
    CHECK(nearRelative(only.beta, 4e-3, 1e-12));
    CHECK(std::isnan(only.betaError));  // two doses are below 10.4 g
}

TEST_CASE("a seed that never emptied the canister leaves no mean of the doses to 99 %") {
    const Sandbox box;
    std::filesystem::create_directories(box / "sweep");
    const std::string head = "member,seed,contact.friction,status,error,doses_to_99_percent,overshoot_kg\n";
    box.write("sweep/members.csv", head + "0,1,0.5,ok,,16,0.001\n1,2,0.5,ok,,,0.003\n");
    auto outputs = pointsIn(box / "sweep").at(0).point.outputs;
    CHECK_FALSE(outputs.contains("doses_to_99_percent"));
    CHECK(nearRelative(outputs.at("overshoot_kg").mean, 2e-3, 1e-12));  // every column can be judged
    box.write("sweep/members.csv", head + "0,1,0.5,ok,,16,\n1,2,0.5,ok,,18,\n");
    CHECK(pointsIn(box / "sweep").at(0).point.outputs.at("doses_to_99_percent").mean == 17);
}

TEST_CASE("a seed that dosed nothing leaves no mean RSD") {
    const Sandbox box;
    std::filesystem::create_directories(box / "sweep");
    const std::string head = "member,seed,contact.friction,status,error,rsd,beta_kg_per_dose\n";
    box.write("sweep/members.csv", head + "0,1,0.5,ok,,0.1,0.001\n1,2,0.5,ok,,,0\n");
    CHECK_FALSE(pointsIn(box / "sweep").at(0).point.outputs.contains("rsd"));
    box.write("sweep/members.csv", head + "0,1,0.5,ok,,0.1,0.001\n1,2,0.5,ok,,0.2,0.002\n");
    CHECK(nearRelative(pointsIn(box / "sweep").at(0).point.outputs.at("rsd").mean, 0.15, 1e-12));
}

TEST_CASE("doses of a point: complete ones, and its mean curves end with the shortest member") {
    const Sandbox box;
    const auto folder = writeSweep(box);
    std::string doses = readText(folder / "doses.csv");
    doses +=
        dosesRows("0,1,0.2,0.3,3,7,0.004,0.013,300,0.01,0.0042,1\n1,2,0.2,0.3,3,7,0.001,0.012,300,0.01,0.0042,0\n");
    box.write("sweep/doses.csv", doses);
    const StudyPoint first = pointsIn(folder).at(0);
    CHECK(first.doses.size() == 2);  // only one of its two seeds has a whole third dose
    CHECK(first.point.cumulative.size() == 2);
}

TEST_CASE("keys that move together are one axis") {
    const Sandbox box;
    std::filesystem::create_directories(box / "sweep");
    box.write("sweep/study.toml",
              "name = \"pairs\"\n[[axis]]\nkeys = [\"coil.turns\", \"coil.speed_rpm\"]\nvalues = [[8, 90], [4, 45]]\n");
    box.write("sweep/members.csv",
              "member,seed,coil.turns,coil.speed_rpm,status,error,beta_kg_per_dose\n"
              "0,1,8,90,ok,,0.004\n1,1,4,45,ok,,0.005\n");
    const Json study = studyJson(box / "sweep", {});
    CHECK(study["axes"] == Json::parse(R"([["coil.turns", "coil.speed_rpm"]])"));
    CHECK(study["points"][0]["at"] == Json::parse(R"(["4, 45"])"));
    CHECK(study["points"][0]["along"] == Json::parse("[4.0]"));
    CHECK(study["points"][0]["beta_kg_per_dose"] == 0.005);
    CHECK(study["points"][1]["at"] == Json::parse(R"(["8, 90"])"));
    CHECK(study["verdicts"].is_null());
}

TEST_CASE("a sweep that has just begun, and one without study.toml") {
    const Sandbox box;
    std::filesystem::create_directories(box / "fresh");
    box.write("fresh/members.csv", kMembersHeader);
    CHECK(isSweep(box / "fresh"));
    CHECK_FALSE(isSweep(box.path()));
    const Json study = studyJson(box / "fresh", {});
    CHECK(study["points"].empty());
    CHECK(study["axes"] == Json::parse(R"([["contact.kc_over_k"], ["contact.friction"]])"));
}

TEST_CASE("what the search of a calibration found is in the data, and that one goes on") {
    const Sandbox box;
    const auto folder = writeSweep(box);
    Json study = studyJson(folder, {});
    CHECK(study["searches"] == false);
    CHECK(study["calibration"].is_null());
    CHECK(study["draws"].empty());
    writeSearch(box);
    study = studyJson(folder, {});
    CHECK(study["searches"] == true);
    const Json& found = study["calibration"];
    CHECK(found["targets"][0]["name"] == "heap.angle_deg");
    CHECK(found["parameters"][0]["change_in_uncertainties"] == Json({-36.0, 8.0}));
    CHECK(found["parameters"][0]["interval_95"] == Json({0.25, 0.375}));
    CHECK(found["parameters"][1]["constrained"] == false);
    CHECK(found["targets"][1]["leave_one_out"]["verdict"] == "overconfident");
    CHECK(found["fit"]["figures"][1]["reached"] == false);
    CHECK(study["draws"] == Json::parse("[[0.3, 0.75], [0.31, 0.5], [0.32, 0.25]]"));
    CHECK(found["points"][0]["values"][1][1].is_null());
    forgetFinding(folder);
    study = studyJson(folder, {});
    CHECK(study["searches"] == true);
    CHECK(study["calibration"].is_null());
    box.write("sweep/calibration.json", "{}");
    CHECK_THROWS_AS(studyJson(folder, {}), CaseError);
}

TEST_CASE("the front of a design is in the data") {
    const Sandbox box;
    const auto folder = writeSweep(box);
    CHECK(studyJson(folder, {})["designs"] == false);
    box.write("sweep/study.toml", "base = \"a.toml\"\n[design]\nmax_runs = 3\n");
    Json study = studyJson(folder, {});
    CHECK(study["designs"] == true);
    CHECK(study["searches"] == true);
    CHECK(study["design"].is_null());
    const std::string finding = R"({"goals": [{"name": "dose.rsd", "base": "a.toml", "wish": "smallest",
        "at_least": null, "at_most": 0.2}], "parameters": [{"key": "coil.speed_rpm", "low": 1, "high": 2}],
        "points": [{"at": [1.5], "values": [[0.1, null]]}],
        "front": [{"point": 0, "at": [1.5], "figures": [[0.1, 0.02]], "verdict": "on the front"}],
        "confirming_seeds": [3, 4]})";
    box.write("sweep/design.json", finding);
    study = studyJson(folder, {});
    CHECK(study["design"]["front"][0]["figures"][0][1] == 0.02);
    for (const auto& [part, with] :
         {std::pair("[[0.1, 0.02]]", "[]"), std::pair("[3, 4]", "3"), std::pair("\"dose.rsd\"", "7"),
          std::pair("\"at\": [1.5], \"v", "\"at\": [], \"v")}) {
        std::string damaged = finding;
        damaged.replace(damaged.find(part), std::string(part).size(), with);
        CAPTURE(damaged);
        box.write("sweep/design.json", damaged);
        CHECK_THROWS_AS(studyJson(folder, {}), CaseError);
    }
}

TEST_CASE("a prediction and the sizes of spheres are in the data") {
    const Sandbox box;
    const auto folder = writeSweep(box);
    CHECK(studyJson(folder, {})["prediction"].is_null());
    CHECK(studyJson(folder, {})["scale"].is_null());
    const std::string prediction = R"({"draws": 16, "failed": 1, "chance": 0.95, "figures": [{"name": "dose.rsd",
        "draws": 15, "mean": 0.1, "deviation": 0.02, "low": 0.05, "high": null}]})";
    const std::string scale = R"({"within": 0.05, "sizes": [{"factor": 1, "widths_in_diameters": {"outlet": 7}}],
        "figures": [{"name": "dose.rsd", "at": [{"mean": 0.1, "error": null, "verdict": "holds"}],
        "holds_to_factor": 1}]})";
    box.write("sweep/prediction.json", prediction);
    box.write("sweep/scale.json", scale);
    const Json study = studyJson(folder, {});
    CHECK(study["prediction"]["figures"][0]["mean"] == 0.1);
    CHECK(study["scale"]["sizes"][0]["widths_in_diameters"]["outlet"] == 7);
    for (const auto& [file, text, part, with] :
         {std::tuple("sweep/prediction.json", prediction, "\"dose.rsd\"", "7"),
          std::tuple("sweep/prediction.json", prediction, "\"draws\": 16", "\"draw\": 16"),
          std::tuple("sweep/scale.json", scale, "\"factor\": 1,", ""),
          std::tuple("sweep/scale.json", scale, "{\"mean\": 0.1, \"error\": null, \"verdict\": \"holds\"}", "")}) {
        std::string damaged = text;
        damaged.replace(damaged.find(part), std::string(part).size(), with);
        CAPTURE(damaged);
        box.write(file, damaged);
        CHECK_THROWS_AS(studyJson(folder, {}), CaseError);
        box.write(file, text);
    }
}

TEST_CASE("name, reason, target and failures are in the data") {
    const Sandbox box;
    const Json study = studyJson(writeSweep(box), {});
    CHECK(study["name"] == "k_c against friction");
    CHECK(study["reason"] == "which of them decides?");
    CHECK(nearRelative(study["target_kg_per_dose"].get<double>(), 3.7e-3, 1e-12));
    CHECK(study["points"][3]["failed"] == 1);
    CHECK(study["members"] == 8);
}

TEST_CASE("turns of the coil in a dose follow from speed and time") {
    const Sandbox box;
    const auto folder = writeSweep(box);
    CHECK(
        nearRelative(studyJson(folder, {})["points"][0]["turns_per_dose"].get<double>(), 3.0, 1e-12));  // 2 s at 90 rpm
    // An axis of speeds, and one that says nothing of the time.
    const std::string head = "member,seed,coil.speed_rpm,status,error,beta_kg_per_dose\n";
    box.write("sweep/members.csv", head + "0,1,60,ok,,0.001\n1,1,15,ok,,0.002\n");
    box.write("sweep/study.toml", "name = \"s\"\n[[axis]]\nkey = \"coil.speed_rpm\"\nvalues = [60, 15]\n");
    const Json points = studyJson(folder, {})["points"];
    CHECK(nearRelative(points[1]["turns_per_dose"].get<double>(), 1.0, 1e-12));  // the base's 1 s
    CHECK(nearRelative(points[0]["turns_per_dose"].get<double>(), 0.25, 1e-12));
    box.write("sweep/base.toml", "[coil]\nturns = 8\n");
    CHECK(studyJson(folder, {})["points"][0]["turns_per_dose"].is_null());
}
