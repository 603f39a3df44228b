// fields/ of the output folder: what stands in it, and that the outlet's field is the time series' own outlet velocity.

#include "host/output/field_files.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "host/core/csv_table.h"
#include "host/core/error.h"
#include "host/core/file.h"
#include "host/output/hdf5.h"
#include "host/output/run_folder.h"
#include "tests/app/sandbox.h"
#include "tests/sim/fake_backend.h"
#include "tests/support/catch.h"
#include "tests/support/near.h"

using namespace vkdose;
using namespace vkdose::test;
namespace fs = std::filesystem;

namespace {

using Rows = std::vector<std::vector<std::string>>;

std::size_t column(const Rows& rows, const std::string& name) {
    const auto found = std::find(rows.at(0).begin(), rows.at(0).end(), name);
    REQUIRE(found != rows.at(0).end());
    return static_cast<std::size_t>(found - rows.at(0).begin());
}

double value(const Rows& rows, std::size_t row, const std::string& name) {
    return std::stod(rows.at(row).at(column(rows, name)));
}

Case caseWith(std::array<std::uint32_t, 3> cells, FieldSensor::Preset preset, bool stress) {
    Case c = smallCase();
    c.resolved = "name = \"fake\"\n";
    FieldSensor s;
    s.name = "f";
    s.preset = preset;
    s.request.grid = {Vec3(0), Vec3(0.01, 0.02, 0.03), cells};
    s.request.width = 0.02;
    s.interval = 0.06;
    s.stress = stress;
    s.initialHeight = 0.05;
    c.fields.push_back(s);
    c.resolved = "[[field]]\nname = \"f\"\n";
    return c;
}

Rows runInto(const fs::path& out, const Case& c) {
    FakeBackend backend;
    backend.field = [](std::uint64_t step) {
        std::array<double, FieldPoint::kNumbers> numbers{};
        for (std::size_t k = 0; k < numbers.size(); ++k) numbers[k] = double(step) * double(k + 1);
        return FieldPoint::of(numbers.data());
    };
    RunFolder folder(out, true, c, "fake");
    const std::atomic<bool> stop{false};
    Insertion filled = smallFilling();
    if (!c.world.properties.empty()) filled.particles.properties.resize(filled.particles.size());
    folder.finish(c, runFilled(c, filled, {}, backend, folder, stop));
    return readCsv(out / "fields/f.csv");
}

}  // namespace

TEST_CASE("a field in one place is a line for each time, in one direction one for each point") {
    const Sandbox box;
    const Rows place = runInto(box / "out", caseWith({1, 1, 1}, FieldSensor::Preset::None, true));
    REQUIRE(place.size() == 1 + 5);
    CHECK(value(place, 1, "time_s") == Approx(0.06));
    CHECK(value(place, 2, "density_kg_m3") == 120);
    CHECK(value(place, 2, "volume_fraction") == Approx(0.12));  // of 1000 kg/m3
    CHECK(value(place, 2, "momentum_y_kg_m2_s") == 360);
    CHECK(value(place, 2, "velocity_z_m_s") == Approx(4));
    CHECK(value(place, 2, "coordination") == Approx(6.0 / 5));
    CHECK(value(place, 2, "granular_temperature_m2_s2") == Approx(8));  // (7 + 8 + 9) / 3
    CHECK(value(place, 2, "kinetic_stress_xy_Pa") == 12 * 120);
    CHECK(value(place, 2, "contact_stress_xx_Pa") == 13 * 120);
    CHECK(value(place, 2, "contact_stress_zy_Pa") == 20 * 120);

    const Rows line = runInto(box / "out", caseWith({1, 1, 3}, FieldSensor::Preset::None, false));
    REQUIRE(line.size() == 1 + 5 * 3);
    CHECK(line[0] == std::vector<std::string>{"time_s", "phase", "dose", "z_m", "density_kg_m3", "volume_fraction",
                                              "momentum_x_kg_m2_s", "momentum_y_kg_m2_s", "momentum_z_kg_m2_s",
                                              "velocity_x_m_s", "velocity_y_m_s", "velocity_z_m_s"});
    CHECK(value(line, 3, "z_m") == Approx(0.025));

    const Rows heights = runInto(box / "out", caseWith({1, 1, 3}, FieldSensor::Preset::HeightProfile, false));
    REQUIRE(heights.size() == 1 + 5);  // from step 100 on
    CHECK(value(heights, 1, "time_s") == Approx(0.1));
    CHECK(value(heights, 2, "height_m_at_z_0.015_m") == Approx(0.05 * 120 / 100));
}

TEST_CASE("a map is a file for each time, which the field's own file lists, a new run removes them") {
    const Sandbox box;
    const Rows list = runInto(box / "out", caseWith({1, 2, 3}, FieldSensor::Preset::None, false));
    REQUIRE(list.size() == 1 + 5);
    CHECK(list[2].at(column(list, "file")) == "f_000001.csv");
    const Rows map = readCsv(box / "out/fields/f_000001.csv");
    REQUIRE(map.size() == 1 + 6);
    CHECK(map[0][0] == "y_m");
    CHECK(value(map, 2, "y_m") == Approx(0.015));
    CHECK(value(map, 2, "z_m") == Approx(0.005));
    CHECK(value(map, 6, "z_m") == Approx(0.025));
    CHECK(value(map, 6, "density_kg_m3") == 120);
    CHECK(fs::exists(box / "out/fields/f_000004.csv"));

    const Rows volumes = runInto(box / "out", caseWith({2, 2, 3}, FieldSensor::Preset::None, true));
    CHECK(volumes[2].at(column(volumes, "file")) == "f_000001.hdf");
    CHECK_FALSE(fs::exists(box / "out/fields/f_000001.csv"));
    const hdf5::Reader volume{readText(box / "out/fields/f_000001.hdf")};
    const auto momentum = volume.array<double>("/VTKHDF/PointData/momentum");
    REQUIRE(momentum.size() == 36);
    CHECK(momentum[4] == 3 * 120);
    const auto stress = volume.array<double>("/VTKHDF/PointData/contact_stress");
    REQUIRE(stress.size() == 108);
    CHECK(stress[9 + 7] == 20 * 120);  // zy
    const auto series = nlohmann::json::parse(readText(box / "out/fields/f.hdf.series")).at("files");
    REQUIRE(series.size() == 5);
    CHECK(series[1].at("name") == "f_000001.hdf");
    CHECK(series[1].at("time").get<double>() == value(volumes, 2, "time_s"));

    Case without = smallCase();
    without.resolved = "name = \"fake\"\n";
    RunFolder folder(box / "out", true, without, "fake");
    CHECK_FALSE(fs::exists(box / "out/fields"));
}

TEST_CASE("a name of a map is no formula to a spreadsheet") {
    const Sandbox box;
    Case c = caseWith({1, 2, 3}, FieldSensor::Preset::None, false);
    c.fields[0].name = "-f";
    FakeBackend backend;
    backend.field = [](std::uint64_t) { return FieldPoint(); };
    RunFolder folder(box / "out", true, c, "fake");
    const std::atomic<bool> stop{false};
    folder.finish(c, runFilled(c, smallFilling(), {}, backend, folder, stop));
    CHECK_THAT(readText(box / "out/fields/-f.csv"), Catch::Contains(",'-f_000000.csv\n"));
    CHECK(Table::read(box / "out/fields/-f.csv").text(0, "file") == "-f_000000.csv");
}

TEST_CASE("a list of maps that somebody has damaged is told with its line") {
    const Sandbox box;
    const Case c = caseWith({2, 2, 3}, FieldSensor::Preset::None, false);
    runInto(box / "out", c);
    std::string list = readText(box / "out/fields/f.csv");
    list.at(list.find("f_000001.hdf")) = '\xff';
    box.write("out/fields/f.csv", list);
    FieldFiles files(box / "out", c, std::vector<CsvMark>{{list.size()}});
    CHECK_THROWS_AS(files.store(), OutputError);
    CHECK_THROWS_WITH(files.store(), Catch::Contains("f.csv:3: file = \\xff_000001.hdf: is no text in UTF-8"));
}

TEST_CASE("the outlet's field has the outlet velocity and the throat's mass of the time series") {
    const Sandbox box;
    REQUIRE(box.vkdose("run '" VKDOSE_SOURCE_DIR "/cases/mini.toml' --quiet --backend reference --out out "
                       "--set settle.time_s=0.05 --set dose.rotate_s=0.1 --set dose.rest_s=0 --set stop.max_doses=1 "
                       "--set 'field=[{preset=\"outlet\"}]'")
                .code == 0);
    const Rows series = readCsv(box / "out/timeseries.csv"), outlet = readCsv(box / "out/fields/outlet.csv");
    REQUIRE(outlet.size() > 20);
    const double volume = 14e-3 * 14e-3 * 5e-3;  // of the box around the throat
    std::size_t filled = 0;
    for (std::size_t row = 1, at = 1; row < outlet.size(); ++row) {
        while (series.at(at)[0] != outlet[row][0]) ++at;  // ends of phases are in the series only
        const double mass = value(series, at, "throat_mass_kg");
        CHECK(near(value(outlet, row, "density_kg_m3") * volume, mass, 1e-3, 1e-8));
        if (mass == 0) {
            CHECK(std::isnan(value(outlet, row, "velocity_z_m_s")));
            continue;
        }
        ++filled;
        CHECK(near(value(outlet, row, "velocity_z_m_s"), value(series, at, "outlet_velocity_m_s"), 0.1, 1e-8));
    }
    CHECK(filled > 5);
}

TEST_CASE("a field has the properties of a user's law behind its other columns, as means over the mass") {
    const Sandbox box;
    Case c = caseWith({1, 1, 1}, FieldSensor::Preset::None, true);
    c.world.properties = {"heat", "charge"};
    const Rows place = runInto(box / "out", c);
    CHECK(column(place, "heat") == place[0].size() - 2);
    CHECK(value(place, 2, "heat") == Approx(22));
    CHECK(value(place, 2, "charge") == Approx(23));
    c.fields[0].request.grid.cells = {2, 3, 4};
    const Rows maps = runInto(box / "map", c);
    const hdf5::Reader map(fileContent(box / "map/fields" / maps[1].at(column(maps, "file"))).value());
    CHECK(map.array<double>("/VTKHDF/PointData/charge") == std::vector<double>(24, 23));
}
