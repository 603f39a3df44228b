// `vkdose test bench` as a user meets it. Nothing is judged by the clock: the figures must be there and be figures.

#include <cmath>
#include <nlohmann/json.hpp>

#include "host/app/exit_code.h"
#include "tests/app/sandbox.h"
#include "tests/support/catch.h"

using namespace vkdose;
using namespace vkdose::test;

namespace {

/// VKDOSE_TEST_DEVICE chooses the device, as in the other tests that use one.
std::string device() {
    const char* name = std::getenv("VKDOSE_TEST_DEVICE");
    return name == nullptr ? "" : " --device '" + std::string(name) + "'";
}

void requirePositive(const nlohmann::json& result, const std::string& key) {
    INFO(result.dump() << " " << key);
    REQUIRE(result.contains(key));
    const double value = result[key];
    CHECK(std::isfinite(value));
    CHECK(value > 0);
}

}  // namespace

TEST_CASE("bench measures the small workloads on the device") {
    const Sandbox box;
    const auto outcome = box.vkdose("test bench --quick --validation --repeats 2 --out found --bed '" VKDOSE_SOURCE_DIR
                                    "/tools/bench-data/bed-48g.toml'" +
                                    device());
    INFO(outcome.out << outcome.err);
    REQUIRE(outcome.code == 0);
    const auto results = nlohmann::json::parse(readText(box / "found/bench.json"))["results"];
    REQUIRE(results.size() == 8);  // four workloads, each with its plain loop
    for (const auto& result : results) {
        requirePositive(result, "particle_steps_per_s");
        CHECK(result["particle_steps_per_s_low"] <= result["particle_steps_per_s_high"]);
        if (result["workload"] != "free-fall") requirePositive(result, "touching_per_particle");
        if (result["on"].get<std::string>().find("plain") == 0) continue;
        requirePositive(result, "table_bytes_per_particle");
        requirePositive(result, "bytes_per_particle_step_estimated");
        requirePositive(result, "bandwidth_of_copy_bytes_per_s");
        requirePositive(result, "start_up_s");
        if (result.contains("pass_step_s")) requirePositive(result, "pass_step_s");
    }
    CHECK(readCsv(box / "found/bench.csv").size() == 9);
}

TEST_CASE("bench does not replace the bed that it measures") {
    const Sandbox box;
    const std::string bed = readText(VKDOSE_SOURCE_DIR "/cases/mini.toml");
    box.write("bench.csv", bed);
    const auto outcome = box.vkdose("test bench --quick --bed bench.csv --only free-fall --out ." + device());
    CHECK(outcome.code == kBadInput);
    CHECK(outcome.err.find("bench.csv is read by this command") != std::string::npos);
    CHECK(readText(box / "bench.csv") == bed);
}

TEST_CASE("bench sums processes that run side by side") {
    const Sandbox box;
    const auto outcome =
        box.vkdose("test bench --quick --repeats 2 --copies 2 --only free-fall --out found" + device());
    INFO(outcome.out << outcome.err);
    REQUIRE(outcome.code == 0);
    CHECK(outcome.out.find("free-fall x2") != std::string::npos);
    const auto results = nlohmann::json::parse(readText(box / "found/bench.json"))["results"];
    REQUIRE(results.size() == 1);
    CHECK(results[0]["copies"] == 2);
    requirePositive(results[0], "particle_steps_per_s");
}

TEST_CASE("bench runs canisters in one ensemble, and tells what their tables take") {
    const Sandbox box;
    const auto outcome =
        box.vkdose("test bench --quick --repeats 2 --members 3 --only free-fall --out found" + device());
    INFO(outcome.out << outcome.err);
    REQUIRE(outcome.code == 0);
    const auto results = nlohmann::json::parse(readText(box / "found/bench.json"))["results"];
    REQUIRE(results.size() == 1);
    CHECK(results[0]["members"] == 3);
    CHECK(results[0]["particles"] == 3 * 3375);
    requirePositive(results[0], "particle_steps_per_s");
    // A particle's own state alone, twice, is more than a hundred bytes; the tables are some ten times that.
    CHECK(results[0]["table_bytes_per_particle"] > 100);
    CHECK(results[0]["table_bytes_per_particle"] < 10000);
}

TEST_CASE("bench says what it does not know and what is not there") {
    const Sandbox box;
    const auto unknown = box.vkdose("test bench --only feather");
    CHECK(unknown.code == 2);
    CHECK(unknown.err.find("free-fall") != std::string::npos);
    CHECK(unknown.err.find("tools/bench-data/bed-48g.toml") != std::string::npos);
    CHECK(box.files().empty());
    CHECK(box.vkdose("test bench --bed nowhere.toml").code == 2);
    CHECK(box.vkdose("test bench --repeats 0").code == 2);
    const auto nodevice = box.vkdose("test bench --quick --only free-fall --device nosuch");
    CHECK(nodevice.code == 4);
    const auto copies = box.vkdose("test bench --quick --only free-fall --copies 2 --device nosuch");
    CHECK(copies.code == 4);
    CHECK(copies.err.find("nosuch") != std::string::npos);
}
