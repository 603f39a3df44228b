// Cases with bodies as a user runs them: the columns of their loads, the same files after an interruption, on both
// backends; and what a device does not do.

#include <algorithm>
#include <csignal>
#include <nlohmann/json.hpp>
#include <thread>

#include "tests/app/sandbox.h"
#include "tests/support/catch.h"

using namespace vkdose::test;
using Catch::Contains;

namespace {

const std::string kDrum = R"(boundaries = "none"
[particles]
density = 1427.0
mass_g = 0.5
[particles.size]
distribution = "fixed"
radius_mm = 1.25
[particles.region]
low = [-0.008, -0.01, 0.001]
high = [0.008, 0.008, 0.009]
[contact]
k = 8000.0
k1_over_k = 0.2
kc_over_k = 0.0
plasticity_depth = 0.05
damping = 0.03
friction = 0.5
[[body]]
name = "drum"
shape = "cylinder"
radius_mm = 15
length_mm = 10
ends = true
[body.motion]
kind = "turn"
speed_rpm = 60
[[body]]
name = "post"
shape = "cylinder"
radius_mm = 1.2
length_mm = 10
at = [0.0105, -0.002, 0]
[body.motion]
kind = "turn"
follows = "drive"
turns_per_turn = 2
[settle]
time_s = 0.06
[dose]
rotate_s = 0.05
speed_rpm = 30
[stop]
rule = "none"
max_doses = 1
)";

std::size_t column(const std::vector<std::vector<std::string>>& table, const std::string& name) {
    const auto at = std::find(table[0].begin(), table[0].end(), name);
    REQUIRE(at != table[0].end());
    return std::size_t(at - table[0].begin());
}

}  // namespace

TEST_CASE("the loads of bodies stand in the time series, and their work in the summary") {
    for (const std::string backend : {"reference", "vulkan"}) {
        CAPTURE(backend);
        const Sandbox box;
        box.write("drum.toml", kDrum);
        const auto end = box.vkdose("run drum.toml --quiet --backend " + backend);
        INFO(end.err);
        REQUIRE(end.code == 0);
        const auto series = readCsv(box / "out/drum/timeseries.csv");
        const auto summary = nlohmann::json::parse(readText(box / "out/drum/summary.json"));
        REQUIRE(summary["bodies"].size() == 2);
        double worst = 0;
        for (const std::string body : {"drum", "post"}) {
            const std::size_t b = body == "drum" ? 0 : 1;
            CHECK(summary["bodies"][b]["name"] == body);
            const double work = std::stod(series.back()[column(series, body + ".work_J")]);
            CHECK(summary["bodies"][b]["work_J"].get<double>() == Approx(work).epsilon(1e-6));
            double sum = 0, before = 0;
            for (std::size_t row = 1; row < series.size(); ++row) {
                const double now = std::stod(series[row][column(series, "time_s")]);
                const double power = std::stod(series[row][column(series, body + ".power_W")]);
                const double torque = std::stod(series[row][column(series, body + ".torque_Nm")]);
                sum += power * (now - before);
                before = now;
                if (body == "drum") worst = std::max(worst, std::abs(power + torque * 2 * 3.14159265358979));
                if (body == "post" && series[row][column(series, "phase")] == "settle") CHECK(power == 0);
            }
            CHECK(sum == Approx(work).epsilon(1e-6));
        }
        const double work = summary["bodies"][0]["work_J"].get<double>();
        CHECK(std::abs(work) > 1e-9);
        CHECK(worst < 0.02 * std::abs(work) / 0.11);  // power is torque by rate
    }
}

TEST_CASE("a run with bodies that is killed leaves the same files after all") {
    for (const std::string backend : {"reference", "vulkan"}) {
        CAPTURE(backend);
        const Sandbox box;
        box.write("drum.toml", kDrum);
        const std::vector<std::string> words{
            "run", "drum.toml", "--quiet", "--backend", backend, "--set", "checkpoint.time_s=0.004", "--out"};
        const auto with = [&](const char* out) {
            auto all = words;
            all.emplace_back(out);
            return all;
        };
        int status = 0;
        waitpid(box.start(with("whole")), &status, 0);
        REQUIRE(status == 0);
        const pid_t child = box.start(with("cut"));
        while (!std::filesystem::exists(box / "cut/checkpoint.h5")) {
            REQUIRE(waitpid(child, &status, WNOHANG) == 0);  // it must not end before
            std::this_thread::yield();
        }
        kill(child, SIGKILL);
        waitpid(child, &status, 0);
        REQUIRE(std::filesystem::exists(box / "cut/checkpoint.h5"));
        REQUIRE(box.vkdose("resume cut --quiet").code == 0);
        for (const char* file : {"timeseries.csv", "doses.csv", "particles.csv"})
            CHECK(readText(box / "cut" / file) == readText(box / "whole" / file));
        const auto bodies = [&](const char* out) {
            return nlohmann::json::parse(readText(box / out / "summary.json"))["bodies"];
        };
        CHECK(bodies("cut") == bodies("whole"));
        CHECK(bodies("cut").size() == 2);
    }
}

TEST_CASE("what a device does not do with bodies is refused by name") {
    const Sandbox box;
    box.write("drum.toml", kDrum);
    const auto energy = box.vkdose("run drum.toml --quiet --backend vulkan --set sensors.energy=true");
    CHECK(energy.code == 3);
    CHECK_THAT(energy.err + energy.out, Contains("energy book") && Contains("--backend reference"));
}
