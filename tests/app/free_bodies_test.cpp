// A case with a body that moves freely as a user runs it: columns, summary, pictures; the same files after another
// beginning or an interruption, on both backends.

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "tests/app/killed_run.h"
#include "tests/app/sandbox.h"
#include "tests/support/catch.h"
#include "tests/support/drum_case.h"

using namespace vkdose::test;

namespace {

/// The drum with a plate that is let go over the powder while this settles.
std::string lidCase() {
    std::string text = kDrum;
    text.replace(text.find("[settle]"), 0,
                 "[[body]]\nname = \"lid\"\nshape = \"box\"\nsize_mm = [8, 1, 6]\nat = [0, 0.0115, 0.005]\n"
                 "[body.motion]\nkind = \"free\"\nmass_g = 1\nalong = [0, 1, 0]\nvelocity = [0, -0.1, 0]\n"
                 "from_s = 0.02\n");
    return text;
}

/// The drum with a flap on a hinge over the powder.
std::string flapCase() {
    std::string text = kDrum;
    text.replace(text.find("[settle]"), 0,
                 "[[body]]\nname = \"flap\"\nshape = \"box\"\nsize_mm = [12, 1, 6]\nat = [0, -0.0005, 0.005]\n"
                 "[body.motion]\nkind = \"hinge\"\nthrough = [-0.006, -0.0005, 0]\ninertia_g_mm2 = 48\nmass_g = 1\n"
                 "centre = [0, -0.0005, 0.005]\nspeed_rpm = -200\nfrom_s = 0.02\n");
    return text;
}

std::vector<double> columnOf(const std::filesystem::path& file, const std::string& name) {
    const auto table = readCsv(file);
    const auto at = std::find(table[0].begin(), table[0].end(), name) - table[0].begin();
    REQUIRE(at < std::ptrdiff_t(table[0].size()));
    std::vector<double> values;
    for (std::size_t row = 1; row < table.size(); ++row) values.push_back(std::stod(table[row][std::size_t(at)]));
    return values;
}

}  // namespace

TEST_CASE("a lid falls on the powder, and the files tell where it is") {
    for (const std::string backend : {"reference", "vulkan"}) {
        CAPTURE(backend);
        const Sandbox box;
        box.write("lid.toml", lidCase());
        const auto end = box.vkdose("run lid.toml --quiet --out run --set frames.interval_s=0.02 --backend " + backend);
        INFO(end.err);
        REQUIRE(end.code == 0);
        const auto time = columnOf(box / "run/timeseries.csv", "time_s"),
                   y = columnOf(box / "run/timeseries.csv", "lid.y_m"),
                   v = columnOf(box / "run/timeseries.csv", "lid.velocity_y_m_s"),
                   force = columnOf(box / "run/timeseries.csv", "lid.force_y_N");
        for (std::size_t i = 0; i < time.size(); ++i)
            if (time[i] < 0.0199) CHECK((y[i] == 0.0115 && v[i] == 0));
        CHECK(y.back() < 0.008);
        CHECK(*std::min_element(v.begin(), v.end()) < -0.15);
        CHECK(*std::max_element(force.begin(), force.end()) > 1e-3 * 9.81);
        const auto summary = nlohmann::json::parse(readText(box / "run/summary.json"));
        CHECK(summary["bodies"][2]["moved_y_m"].get<double>() == Approx(y.back() - 0.0115).epsilon(1e-6));
        CHECK(summary["bodies"][2]["moved_x_m"] == 0);
        CHECK(std::filesystem::exists(box / "run/frames/bodies_000001.hdf"));
        CHECK(box.vkdose("render run --size 320x240 --out end.png").code == 0);
        CHECK(box.vkdose("report run").code == 0);
        // From the settled bed the doses are the same: the lid goes on where it was.
        REQUIRE(box.vkdose("run --from run --quiet --out on").code == 0);
        for (const char* file : {"doses.csv", "particles.csv"})
            CHECK(readText(box / "on" / file) == readText(box / "run" / file));
        CHECK(columnOf(box / "on/timeseries.csv", "lid.y_m").back() == y.back());
    }
}

TEST_CASE("a flap falls on the powder, and the files tell how far it has turned") {
    for (const std::string backend : {"reference", "vulkan"}) {
        CAPTURE(backend);
        const Sandbox box;
        box.write("flap.toml", flapCase());
        const auto end =
            box.vkdose("run flap.toml --quiet --out run --set frames.interval_s=0.02 --backend " + backend);
        INFO(end.err);
        REQUIRE(end.code == 0);
        const auto angle = columnOf(box / "run/timeseries.csv", "flap.angle_rad"),
                   rate = columnOf(box / "run/timeseries.csv", "flap.rate_rad_s"),
                   x = columnOf(box / "run/timeseries.csv", "flap.x_m"),
                   y = columnOf(box / "run/timeseries.csv", "flap.y_m"),
                   torque = columnOf(box / "run/timeseries.csv", "flap.torque_Nm");
        CHECK(angle.back() < -0.1);
        CHECK(*std::min_element(rate.begin(), rate.end()) < -20);
        CHECK(*std::max_element(torque.begin(), torque.end()) > 1e-3 * 9.81 * 6e-3);  // the powder bears it
        for (std::size_t i = 0; i < angle.size(); ++i) {
            CHECK(x[i] == Approx(-0.006 + 0.006 * std::cos(angle[i])).margin(1e-7));
            CHECK(y[i] == Approx(-0.0005 + 0.006 * std::sin(angle[i])).margin(1e-7));
        }
        const auto summary = nlohmann::json::parse(readText(box / "run/summary.json"));
        CHECK(summary["bodies"][2]["turned_rad"].get<double>() == Approx(angle.back()).epsilon(1e-6));
        CHECK(box.vkdose("render run --size 320x240 --out end.png").code == 0);
        CHECK(box.vkdose("report run").code == 0);
        REQUIRE(box.vkdose("run --from run --quiet --out on").code == 0);
        for (const char* file : {"doses.csv", "particles.csv"})
            CHECK(readText(box / "on" / file) == readText(box / "run" / file));
        CHECK(columnOf(box / "on/timeseries.csv", "flap.angle_rad").back() == angle.back());
    }
}

TEST_CASE("a run with a lid that is killed leaves the same files after all") {
    for (const std::string backend : {"reference", "vulkan"}) {
        CAPTURE(backend);
        const Sandbox box;
        box.write("lid.toml", lidCase());
        runWholeAndCut(box, {"run", "lid.toml", "--quiet", "--backend", backend, "--set", "checkpoint.time_s=0.03"});
        for (const char* file : {"timeseries.csv", "particles.csv"})
            CHECK(readText(box / "cut" / file) == readText(box / "whole" / file));
    }
}
