// The result as programs read it.

#include "host/bench/results_table.h"

#include <nlohmann/json.hpp>

#include "tests/support/catch.h"

using namespace vkdose::bench;

namespace {

Row bed() {
    Row row;
    row.workload = "bed";
    row.on = "vulkan: a \"card\", by name";
    row.driver = "card: 1.2";
    row.particles = 7;
    row.repeats = 3;
    row.speed.steps = 100;
    row.speed.particleSteps = {2e6, 1e6, 3e6};
    row.stepBytes = 500;
    row.passes = {{"step", 1e-3}};
    return row;
}

Row refused() {
    Row row;
    row.workload = "too-large";
    row.on = "vulkan";
    row.refused = "it needs 9 bytes, of which there are 8";
    return row;
}

}  // namespace

TEST_CASE("JSON holds what was measured and nothing else") {
    Row copies = bed();
    copies.copies = 2;
    const auto results = nlohmann::json::parse(jsonTable({bed(), refused(), copies}))["results"];
    REQUIRE(results.size() == 3);
    CHECK(results[0]["particle_steps_per_s"] == 2e6);
    CHECK(results[0]["particle_steps_per_s_low"] == 1e6);
    CHECK(results[0]["bandwidth_estimated_bytes_per_s"] == 1e9);
    CHECK(results[0]["pass_step_s"] == 1e-3);
    CHECK(results[0]["driver"] == "card: 1.2");
    CHECK_FALSE(results[1].contains("driver"));
    CHECK(results[1]["refused"] == refused().refused);
    CHECK_FALSE(results[1].contains("particle_steps_per_s"));
    CHECK(results[2]["copies"] == 2);
    CHECK_FALSE(results[2].contains("cores_busy"));
}

TEST_CASE("the machine is told as far as it is known") {
    Row row = bed();
    CHECK(machineLines(row) == "on vulkan: a \"card\", by name\ndriver card: 1.2");
    row.driver = "";
    row.processor = "a processor, AVX2";
    CHECK(machineLines(row) == "on vulkan: a \"card\", by name\nprocessor a processor, AVX2");
}

TEST_CASE("every line of the CSV has the columns of all") {
    const std::string csv = csvTable({refused(), bed()});
    CHECK(csv.find("\"vulkan: a \"\"card\"\", by name\"") != std::string::npos);
    std::vector<int> fields;
    bool quoted = false;
    int commas = 0;
    for (const char c : csv) {
        if (c == '"') quoted = !quoted;
        if (c == ',' && !quoted) ++commas;
        if (c != '\n') continue;
        fields.push_back(commas);
        commas = 0;
    }
    REQUIRE(fields.size() == 3);
    CHECK(fields[0] > 10);
    CHECK(fields[1] == fields[0]);
    CHECK(fields[2] == fields[0]);
}

TEST_CASE("a refusal is told in the line of the table") {
    CHECK(tableLine(refused()).find(refused().refused) != std::string::npos);
    CHECK(detailLines(refused()).empty());
    CHECK(tableLine(bed()).find("2.000") != std::string::npos);
}

TEST_CASE("a workload is compared with the one that it names") {
    Row bed, mesh, plain;
    bed.workload = "bed";
    bed.speed.particleSteps.median = 6e6;
    mesh.workload = "mesh";
    mesh.speed.particleSteps.median = 2.5e6;
    plain.workload = "mesh";
    plain.plain = true;
    plain.speed.particleSteps.median = 1e9;
    CHECK(ratioLine({bed, plain, mesh}, "mesh", "bed") ==
          "mesh: a step of a sphere takes 2.40 times as long as in bed");
    CHECK(ratioLine({bed, plain}, "mesh", "bed").empty());
    CHECK(ratioLine({bed, mesh}, "mesh", "").empty());
    mesh.refused = "too large";
    CHECK(ratioLine({bed, mesh}, "mesh", "bed").empty());
}
