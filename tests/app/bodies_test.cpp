// Cases with bodies as a user runs them: the columns of their loads, the same files after an interruption, on both
// backends; and what a device does not do.

#include <algorithm>
#include <nlohmann/json.hpp>
#include <numbers>

#include "geometry/mesh_file.h"
#include "tests/app/killed_run.h"
#include "tests/app/sandbox.h"
#include "tests/support/catch.h"
#include "tests/support/drum_case.h"

using namespace vkdose::test;
using Catch::Contains;

namespace {

std::size_t column(const std::vector<std::vector<std::string>>& table, const std::string& name) {
    const auto at = std::find(table[0].begin(), table[0].end(), name);
    REQUIRE(at != table[0].end());
    return std::size_t(at - table[0].begin());
}

}  // namespace

TEST_CASE("the torque of the drive is that of the bodies that follow it, and can end a dose") {
    std::string driven = kDrum;
    const std::string clock = "speed_rpm = 60\n";
    driven.replace(driven.find(clock), clock.size(), "follows = \"drive\"\nturns_per_turn = 2\n");
    for (const std::string backend : {"reference", "vulkan"}) {
        CAPTURE(backend);
        const Sandbox box;
        box.write("drum.toml", driven);
        REQUIRE(box.vkdose("run drum.toml --quiet --out run --backend " + backend).code == 0);
        const auto table = readCsv(box / "run/timeseries.csv");
        const auto at = [&](std::size_t row, const std::string& name) {
            return std::stod(table[row][column(table, name)]);
        };
        double largest = 0, held = 0;
        for (std::size_t row = 1; row < table.size(); ++row) {
            if (table[row][column(table, "phase")] != "rotate") {  // the drive bears the load while it is still, too
                CHECK(at(row, "coil_torque_Nm") == Approx(-2 * at(row, "drum.torque_Nm")).epsilon(1e-7));
                held = std::max(held, std::abs(at(row, "coil_torque_Nm")));
                continue;
            }
            // Of the drum alone, which turns twice as fast as the drive; the post is not touched. Nine digits are
            // written.
            const double power = at(row, "drum.power_W"), speed = 30 * 2 * std::numbers::pi / 60;
            CHECK(at(row, "coil_power_W") == Approx(power).epsilon(1e-7));
            CHECK(at(row, "coil_torque_Nm") == Approx(power / speed).epsilon(1e-7));
            CHECK(at(row, "coil_torque_Nm") == Approx(-2 * at(row, "drum.torque_Nm")).epsilon(1e-3));
            largest = std::max(largest, at(row, "coil_torque_Nm"));
        }
        REQUIRE(largest > 0);
        REQUIRE(held > 0);
        REQUIRE(box.vkdose("run drum.toml --quiet --out cut --backend " + backend +
                           " --set dose.max_torque_mNm=" + std::to_string(largest * 1e3 / 2))
                    .code == 0);
        CHECK_THAT(readText(box / "cut/doses.csv"), Contains("torque"));
        CHECK_THAT(readText(box / "run/doses.csv"), !Contains(",torque,"));
    }
}

TEST_CASE("the loads of bodies stand in the doses and the summary: means over the rotation, work of the dose, peaks") {
    for (const std::string backend : {"reference", "vulkan"}) {
        CAPTURE(backend);
        const Sandbox box;
        std::string two = kDrum;
        two.replace(two.find("max_doses = 1"), 13, "max_doses = 2");
        two.replace(two.find("rotate_s = 0.05"), 15, "rotate_s = 0.05\nrest_s = 0.02");
        box.write("drum.toml", two);
        REQUIRE(box.vkdose("run drum.toml --quiet --out run --backend " + backend).code == 0);
        const auto series = readCsv(box / "run/timeseries.csv"), doses = readCsv(box / "run/doses.csv");
        const auto summary = nlohmann::json::parse(readText(box / "run/summary.json"));
        REQUIRE(doses.size() == 3);
        double largestTorque = 0, largestForce = 0, largestPower = 0;
        for (std::size_t dose = 1; dose <= 2; ++dose) {
            // From the time series: the drum turns at all times, so that its work goes on while the drive rests.
            double torque = 0, power = 0, force = 0, time = 0, first = 0, last = 0, before = 0, rest = 0;
            for (std::size_t row = 1; row < series.size(); ++row) {
                const auto at = [&](const char* name) { return std::stod(series[row][column(series, name)]); };
                const double span = at("time_s") - before;
                before = at("time_s");
                const bool within = at("dose") == double(dose);
                if (!within && last == 0) first = at("drum.work_J");
                if (!within) continue;
                rest += at("drum.work_J") - (last == 0 ? first : last);
                last = at("drum.work_J");
                if (series[row][column(series, "phase")] != "rotate") continue;
                rest = 0;
                time += span;
                torque += span * at("drum.torque_Nm");
                power += span * at("drum.power_W");
                force += span * at("drum.force_y_N");
            }
            const auto in = [&](const char* name) { return std::stod(doses[dose][column(doses, name)]); };
            CHECK(time == Approx(0.05).epsilon(1e-4));  // whole steps
            CHECK(in("drum.torque_Nm") == Approx(torque / time).epsilon(1e-6));
            CHECK(in("drum.power_W") == Approx(power / time).epsilon(1e-6));
            CHECK(in("drum.force_y_N") == Approx(force / time).epsilon(1e-6));
            CHECK(in("drum.work_J") == Approx(last - first).epsilon(1e-6));
            CHECK(rest != 0);  // so the work of the dose is more than that of its rotation
            const auto& bodies = summary["doses"][dose - 1]["bodies"];
            CHECK(bodies["drum"]["torque_Nm"].get<double>() == Approx(in("drum.torque_Nm")).epsilon(1e-6));
            CHECK(bodies["post"].size() == 6);
        }
        for (std::size_t row = 1; row < series.size(); ++row) {
            const auto at = [&](const char* name) { return std::stod(series[row][column(series, name)]); };
            largestTorque = std::max(largestTorque, std::abs(at("drum.torque_Nm")));
            largestPower = std::max(largestPower, std::abs(at("drum.power_W")));
            largestForce =
                std::max(largestForce, std::hypot(at("drum.force_x_N"), at("drum.force_y_N"), at("drum.force_z_N")));
        }
        const auto& drum = summary["bodies"][0];
        CHECK(drum["largest_torque_Nm"].get<double>() == Approx(largestTorque).epsilon(1e-6));
        CHECK(drum["largest_power_W"].get<double>() == Approx(largestPower).epsilon(1e-6));
        CHECK(drum["largest_force_N"].get<double>() == Approx(largestForce).epsilon(1e-6));
    }
}

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

namespace {

/// The drum turns while its powder settles. The post, which lies in the way of the powder, turns only while it is
/// dosed.
std::string phasedDrum() {
    std::string text = kDrum;
    const auto put = [&text](const std::string& from, const std::string& to) {
        text.replace(text.find(from), from.size(), to);
    };
    put("speed_rpm = 60\n", "speed_rpm = 60\nduring = \"settle\"\n");
    put("at = [0.0105, -0.002, 0]", "at = [0.004, -0.0115, 0]");
    put("follows = \"drive\"\nturns_per_turn = 2\n", "speed_rpm = 10\nduring = \"rotate\"\n");
    put("[settle]",
        "[[body]]\nname = \"driven\"\nshape = \"ball\"\nradius_mm = 0.5\nat = [0, 0.012, 0.005]\n"
        "[body.motion]\nkind = \"turn\"\nfollows = \"drive\"\n[settle]");
    return text;
}

}  // namespace

TEST_CASE("the coil tells the loads that the same wire tells as a body") {
    std::string asBody = readText(VKDOSE_SOURCE_DIR "/cases/mini.toml");
    const std::size_t coil = asBody.find("[coil]"), settle = asBody.find("[settle]");
    REQUIRE(settle > coil);
    asBody.replace(coil, settle - coil, R"([[body]]
name = "coil"
shape = "wire"
contact = "coil"
length_mm = 21.0
pitch_mm = 7.0
wire_diameter_mm = 1.6
radius_mm = 5.9
[body.motion]
kind = "turn"
follows = "drive"
turns_per_turn = -1

)");
    const std::size_t dose = asBody.find("[dose]\n");
    asBody.insert(dose + 7, "speed_rpm = 120.0\n");
    for (const std::string backend : {"reference", "vulkan"}) {
        CAPTURE(backend);
        const Sandbox box;
        box.write("body.toml", asBody);
        box.write("coil.toml", readText(VKDOSE_SOURCE_DIR "/cases/mini.toml"));
        for (const std::string run : {"body", "coil"}) {
            const auto end = box.vkdose("run " + run + ".toml --quiet --out out/" + run +
                                        " --set stop.max_doses=1 --set settle.time_s=0.06 --set dose.rotate_s=0.1" +
                                        " --set dose.rest_s=0.02 --backend " + backend);
            INFO(end.err);
            REQUIRE(end.code == 0);
        }
        const auto of = [&](const std::string& run) { return readCsv(box / ("out/" + run + "/doses.csv")); };
        const auto body = of("body"), wire = of("coil");
        REQUIRE(body.size() == 2);
        REQUIRE(body[0] == wire[0]);
        for (std::size_t at = 0; at < body[1].size(); ++at) {
            CAPTURE(body[0][at]);
            // The drive's torque is gathered in another order.
            if (body[0][at] == "coil_torque_Nm")
                CHECK(std::stod(body[1][at]) == Approx(std::stod(wire[1][at])).epsilon(1e-6));
            else
                CHECK(body[1][at] == wire[1][at]);
        }
        CHECK(std::stod(wire[1][column(wire, "coil.force_z_N")]) != 0);
        const auto summary = nlohmann::json::parse(readText(box / "out/coil/summary.json"));
        REQUIRE(summary["bodies"].size() == 1);
        CHECK(summary["bodies"][0]["name"] == "coil");
        CHECK(summary["bodies"][0]["largest_force_N"].get<double>() > 0);
    }
}

TEST_CASE("bodies move in the phases that the case names, and stand in the others") {
    for (const std::string backend : {"reference", "vulkan"}) {
        CAPTURE(backend);
        const Sandbox box;
        box.write("drum.toml", phasedDrum());
        const auto end =
            box.vkdose("run drum.toml --quiet --out run --set frames.interval_s=0.01 --backend " + backend);
        INFO(end.err);
        REQUIRE(end.code == 0);
        const auto series = readCsv(box / "run/timeseries.csv");
        double settling = 0, dosing = 0;
        for (std::size_t row = 1; row < series.size(); ++row) {
            const bool settles = series[row][column(series, "phase")] == "settle";
            const double drum = std::stod(series[row][column(series, "drum.power_W")]);
            const double post = std::stod(series[row][column(series, "post.power_W")]);
            if (settles) CHECK(post == 0);
            settling += settles ? std::abs(drum) : 0;
            dosing += settles ? 0 : std::abs(post);
            if (!settles) CHECK(drum == 0);
        }
        CHECK(settling > 0);
        CHECK(dosing > 0);
        const auto summary = nlohmann::json::parse(readText(box / "run/summary.json"));
        CHECK(summary["bodies"][0]["moved_s"].get<double>() == Approx(0.06).epsilon(1e-4));
        CHECK(summary["bodies"][1]["moved_s"].get<double>() == Approx(0.05).epsilon(1e-4));
        CHECK(box.vkdose("render run --size 320x240 --out end.png").code == 0);
        CHECK(box.vkdose("report run").code == 0);
    }
}

TEST_CASE("a run with bodies that is killed leaves the same files after all") {
    for (const auto& [backend, text] : {std::pair("reference", kDrum), std::pair("vulkan", kDrum),
                                        std::pair("reference", phasedDrum()), std::pair("vulkan", phasedDrum())}) {
        CAPTURE(backend, text);
        const Sandbox box;
        box.write("drum.toml", text);
        runWholeAndCut(box, {"run", "drum.toml", "--quiet", "--backend", backend, "--set", "checkpoint.time_s=0.004"});
        for (const char* file : {"timeseries.csv", "doses.csv", "particles.csv"})
            CHECK(readText(box / "cut" / file) == readText(box / "whole" / file));
        const auto part = [&](const char* out, const char* key) {
            return nlohmann::json::parse(readText(box / out / "summary.json"))[key];
        };
        CHECK(part("cut", "bodies") == part("whole", "bodies"));
        CHECK(part("cut", "bodies").size() >= 2);
        CHECK(part("cut", "doses") == part("whole", "doses"));
    }
}

TEST_CASE("export-body writes bodies where their motion has brought them, in the unit asked for") {
    const Sandbox box;
    box.write("drum.toml", kDrum);
    // The post turns twice for each turn of the drive: an eighth of one brings it from +x, -2 mm to a quarter farther.
    const auto o = box.vkdose("export-body drum.toml post --angle 45 --unit cm --out post.stl");
    INFO(o.out << o.err);
    REQUIRE(o.code == 0);
    const vkdose::geometry::TriangleSoup soup = vkdose::geometry::readMeshFile(box / "post.stl", 1e-2);
    vkdose::Vec3 low(1), high(-1);
    for (const vkdose::Vec3& x : soup.points) {
        low = glm::min(low, x);
        high = glm::max(high, x);
    }
    // Single precision; 64 corners to a turn leave out 0.0012 of the radius at most.
    const vkdose::Vec3 expectedLow(0.002 - 1.2e-3, 0.0105 - 1.2e-3, 0),
        expectedHigh(0.002 + 1.2e-3, 0.0105 + 1.2e-3, 0.01);
    CHECK(glm::length(low - expectedLow) < 3e-6);
    CHECK(glm::length(high - expectedHigh) < 3e-6);
    const auto all = box.vkdose("export-body drum.toml --out all.stl");
    CHECK_THAT(all.out, Contains("drum, post: "));
    const auto none = box.vkdose("export-body drum.toml coil");
    CHECK(none.code == 2);
    CHECK_THAT(none.err, Contains("no \"coil\"; give one of: drum, post"));
}

TEST_CASE("what comes into a region is in the time series, the doses and the summary") {
    for (const std::string backend : {"reference", "vulkan"}) {
        CAPTURE(backend);
        const Sandbox box;
        // The drum is open and a little aslant: what comes low in it counts, and what has passed its ends is dosed.
        std::string text = "gravity = [0, -8, 5]\n" + kDrum;
        text.replace(text.find("ends = true"), 11, "ends = false");
        box.write("drum.toml", text +
                                   "[[region]]\nname = \"low\"\nkind = \"box\"\nlow = [-0.02, -0.02, -0.1]\n"
                                   "high = [0.02, -0.01, 0.1]\ndeletes = false\n"
                                   "[[region]]\nname = \"rear\"\nkind = \"beyond\"\npoint = [0, 0, -0.001]\n"
                                   "normal = [0, 0, -1]\n"
                                   "[[region]]\nname = \"front\"\nkind = \"beyond\"\npoint = [0, 0, 0.011]\n"
                                   "normal = [0, 0, 1]\n");
        const auto o = box.vkdose("run drum.toml --quiet --out run --backend " + backend);
        INFO(o.out << o.err);
        REQUIRE(o.code == 0);
        const auto series = readCsv(box / "run/timeseries.csv"), doses = readCsv(box / "run/doses.csv");
        const auto last = [&](const char* name) { return std::stod(series.back()[column(series, name)]); };
        CHECK(last("low.count") > 0);
        // It slides through and out again.
        double most = 0, heaviest = 0;
        for (std::size_t i = 1; i < series.size(); ++i) {
            most = std::max(most, std::stod(series[i][column(series, "low.content_count")]));
            heaviest = std::max(heaviest, std::stod(series[i][column(series, "low.content_kg")]));
        }
        CHECK(most > 0);
        CHECK(last("low.content_count") < most);
        CHECK(last("rear.content_kg") == last("rear.mass_kg"));
        CHECK(last("rear.mass_kg") + last("front.mass_kg") == Approx(last("dosed_mass_kg")).epsilon(1e-6));
        CHECK(last("dosed_count") > 0);
        const double inDose = std::stod(doses.back()[column(doses, "rear.mass_kg")]) +
                              std::stod(doses.back()[column(doses, "front.mass_kg")]);
        CHECK(inDose == Approx(std::stod(doses.back()[column(doses, "mass_kg")])).epsilon(1e-6));
        const auto summary = nlohmann::json::parse(readText(box / "run/summary.json"));
        REQUIRE(summary["regions"].size() == 3);
        CHECK(summary["regions"][0]["name"] == "low");
        CHECK(summary["regions"][0]["particles"] == last("low.count"));
        CHECK(summary["regions"][0]["content_kg"].get<double>() == Approx(last("low.content_kg")));
        CHECK(summary["regions"][0]["largest_content_kg"].get<double>() == Approx(heaviest));
    }
}
