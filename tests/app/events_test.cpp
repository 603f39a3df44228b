// `vkdose run --events`: the run as JSON lines, for other programs.

#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/app/sandbox.h"
#include "tests/support/catch.h"

using namespace vkdose::test;
using Json = nlohmann::json;

namespace {

const std::string kShort = VKDOSE_SOURCE_DIR
    "/cases/mini.toml --set settle.time_s=0.05 --set dose.rotate_s=0.1 --set dose.rest_s=0.02 --set "
    "stop.max_doses=2 --backend reference ";

std::vector<Json> eventsIn(const std::string& text, const std::string& kind = "") {
    std::vector<Json> events;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) {
        const Json event = Json::parse(line);
        if (kind.empty() || event["event"] == kind) events.push_back(event);
    }
    return events;
}

std::vector<std::string> linesOf(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
}

}  // namespace

TEST_CASE("the events of a run are its warnings, phases, samples and doses, and nothing else is printed") {
    const Sandbox box;
    const auto o = box.vkdose("run " + kShort + "--events --out run");
    REQUIRE(o.code == 0);
    CHECK(o.err.empty());
    const std::vector<Json> events = eventsIn(o.out);
    REQUIRE(events.size() > 10);
    CHECK(events.front()["event"] == "run");
    CHECK(events.front()["particles"] == 111);
    CHECK(events.front()["refills"].empty());
    CHECK(events.front()["from_s"] == 0);
    CHECK(events.back()["event"] == "end");
    CHECK(events.back()["code"] == 0);
    CHECK(events.back()["error"].is_null());
    CHECK(events.back()["stop_reason"] == "dose_count");

    std::vector<std::string> phases;
    for (const Json& e : eventsIn(o.out, "phase"))
        phases.push_back(e["phase"].get<std::string>() + std::to_string(e["dose"].get<int>()));
    CHECK(phases == std::vector<std::string>{"settle0", "rotate1", "rest1", "rotate2", "rest2"});
    CHECK_FALSE(eventsIn(o.out, "warning").empty());
    CHECK(eventsIn(o.out, "settled").size() == 1);

    // The tables of the folder say the same.
    const std::vector<Json> samples = eventsIn(o.out, "sample"), doses = eventsIn(o.out, "dose");
    CHECK(samples.size() + 1 == linesOf(readText(box / "run/timeseries.csv")).size());
    const Json summary = Json::parse(readText(box / "run/summary.json"));
    REQUIRE(doses.size() == summary["doses"].size());
    for (std::size_t i = 0; i < doses.size(); ++i)
        for (const auto& [column, value] : summary["doses"][i].items()) CHECK(doses[i][column] == value);
    CHECK(samples.back()["time_s"] == summary["simulated_time_s"]);
    const Json lastPhase = eventsIn(o.out, "phase").back();  // by which a reader tells how much is left
    CHECK(samples.back()["step"] > lastPhase["step"]);
    CHECK(samples.back()["step"] <= lastPhase["expected_steps"]);
}

TEST_CASE("a run whose events nobody reads any longer is interrupted, and resumes to the same bytes") {
    const Sandbox box;
    // A sample each millisecond: more text than a pipe and head hold, so that the run cannot end before its reader
    // goes.
    const std::string talkative = kShort + "--set sensors.interval_s=0.001 ";
    REQUIRE(box.vkdose("run " + talkative + "--quiet --out whole").code == 0);
    // The reader goes after 30 lines, of which the last are samples, so the run has made steps by then. The code is
    // that of the program, not of head.
    const std::string command = "cd '" + box.path().string() + "' && bash -c \"'" VKDOSE_BINARY_DIR "/vkdose' run " +
                                talkative +
                                "--events --force --out cut 2>/dev/null | head -n 30 >/dev/null; exit "
                                "\\${PIPESTATUS[0]}\"";
    const int status = std::system(command.c_str());
    REQUIRE(WIFEXITED(status));
    CHECK(WEXITSTATUS(status) == 130);
    CHECK(Json::parse(readText(box / "cut/summary.json"))["interrupted"] == true);
    const auto resumed = box.vkdose("resume cut --events");
    CHECK(resumed.code == 0);
    CHECK(eventsIn(resumed.out).front()["from_s"] > 0);
    for (const char* file : {"timeseries.csv", "doses.csv", "particles.csv"})
        CHECK(readText(box / "cut" / file) == readText(box / "whole" / file));
}

TEST_CASE("the events of a run that fails end with the error") {
    const Sandbox box;
    const auto o = box.vkdose("run " + kShort + "--set contact.max_overlap_ratio=0.001 --events --out run");
    CHECK(o.code == 3);
    const Json end = eventsIn(o.out).back();
    CHECK(end["event"] == "end");
    CHECK(end["code"] == 3);
    CHECK_THAT(end["error"].get<std::string>(), Catch::Contains("overlap"));
    CHECK_THAT(o.err, Catch::Contains("overlap"));
    CHECK(box.vkdose("run " + kShort + "--events --quiet").code == 2);
}

TEST_CASE("a run obeys lines on its standard input, tells what it did, and refuses what is no order") {
    const Sandbox box;
    // Read before the first dose; what is for the drive waits for it.
    box.write("orders.txt",
              "speed 150\r\ndose 0.005\n\nspeed -3\nspeed fast\nspeed 1e9\ndose 0\nfaster\nstop\nrefill more\n");
    const std::string command =
        "cd '" + box.path().string() + "' && '" + programFile() +
        "' run " VKDOSE_SOURCE_DIR
        "/cases/mini.toml --backend reference --events --orders --out run < orders.txt > out.txt 2> err.txt";
    REQUIRE(std::system(command.c_str()) == 0);
    const std::string out = readText(box / "out.txt");
    const std::vector<Json> orders = eventsIn(out, "order"), refused = eventsIn(out, "refused");
    REQUIRE(orders.size() == 2);
    CHECK(orders[0]["order"] == "speed");
    CHECK(orders[0]["speed_rpm"].get<double>() == Approx(150));
    CHECK(orders[1]["order"] == "stop");
    CHECK(orders[1]["time_s"] > orders[0]["time_s"]);
    std::vector<std::string> lines;
    for (const Json& r : refused) lines.push_back(r["order"]);
    CHECK(lines ==
          std::vector<std::string>{"speed -3", "speed fast", "speed 1e9", "dose 0", "faster", "stop", "refill more"});
    CHECK_THAT(refused[5]["why"].get<std::string>(), Catch::Contains("does not turn"));
    const std::vector<Json> doses = eventsIn(out, "dose");
    REQUIRE(doses.size() == 2);
    CHECK(doses[0]["stopped_by"] == "order");
    CHECK(doses[0]["stop_mass_kg"].get<double>() >= 5e-6);
    CHECK(doses[1]["stopped_by"] == "time");
    // A run that was ordered about says so.
    const Json summary = Json::parse(readText(box / "run/summary.json"));
    REQUIRE(summary["orders"].size() == 2);
    CHECK(summary["orders"][0]["time_s"] == orders[0]["time_s"]);
    CHECK(summary["orders"][1]["order"] == "stop");
    CHECK(box.vkdose("run " + kShort + "--orders").code == 2);  // for a program that hears what came of them
}
