// A case with a body that moves freely as a user runs it: columns, summary, pictures; the same files after another
// beginning or an interruption, on both backends.

#include <algorithm>
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
