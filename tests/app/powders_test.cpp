// Two powders from a case file to the files of its run.

#include <nlohmann/json.hpp>

#include "host/core/csv_table.h"
#include "host/model/case.h"
#include "host/model/particle_list.h"
#include "tests/app/cut_runs.h"
#include "tests/support/catch.h"

using namespace vkdose;
using namespace vkdose::test;

namespace {

/// cases/mini.toml with a second powder on the first, that is dosed in two short doses.
void writeCase(const Sandbox& box) {
    box.write("two.toml", "base = \"" VKDOSE_SOURCE_DIR R"(/cases/mini.toml"
name = "two"
[particles]
material = "cocoa"
mass_g = 0.5
mixed = true
[[powder]]
name = "sugar"
density = 1590.0
mass_g = 0.4
[powder.size]
distribution = "fixed"
radius_mm = 1.0
[contact.sugar-sugar]
friction = 0.3
[contact.cocoa-sugar]
restitution = 0.6
[coil]
speed_rpm = 400
[settle]
time_s = 0.1
[dose]
rotate_s = 0.1
rest_s = 0.02
[stop]
max_doses = 2
[sensors]
interval_s = 0.003
[frames]
interval_s = 0.05
[[field]]
name = "sugar-alone"
powder = "sugar"
stress = true
cells = [1, 1, 4]
low = [-0.007, -0.007, 0]
high = [0.007, 0.06, 0.021]
[[field]]
name = "both"
stress = true
cells = [1, 1, 4]
low = [-0.007, -0.007, 0]
high = [0.007, 0.06, 0.021]
)");
}

const std::vector<std::string> kTables{"timeseries.csv", "doses.csv", "particles.csv"};

double lastOf(const Table& table, const std::string& column) {
    return table.number(table.rows() - 1, column);
}

}  // namespace

TEST_CASE("what a run tells of its powders adds up to what it tells of all") {
    const Sandbox box;
    writeCase(box);
    const auto checked = box.vkdose("check two.toml --assume");
    CAPTURE(checked.err);
    CHECK_THAT(checked.out, Catch::Contains("powder     sugar: 60, 0.3996 g (target 0.4 g), 1590 kg/m3"));
    CHECK_THAT(checked.out, Catch::Contains("contact.sugar-wall: as contact.wall"));
    const auto run = box.vkdose("run two.toml --out out");
    CAPTURE(run.err);
    REQUIRE(run.code == 0);
    const Table series = Table::read(box / "out/timeseries.csv"), doses = Table::read(box / "out/doses.csv");
    const double filled = 0.9e-3;
    for (std::size_t i = 0; i < series.rows(); ++i)
        for (const char* place : {"canister", "throat", "dosed"}) {
            const std::string mass = std::string(place) + "_mass_kg", count = std::string(place) + "_count";
            CAPTURE(i, place);
            CHECK(std::abs(series.number(i, "cocoa." + mass) + series.number(i, "sugar." + mass) -
                           series.number(i, mass)) < 1e-6 * filled);
            CHECK(series.number(i, "cocoa." + count) + series.number(i, "sugar." + count) == series.number(i, count));
        }
    REQUIRE(doses.rows() == 2);
    double sugar = 0;
    for (std::size_t i = 0; i < 2; ++i) {
        const double of = doses.number(i, "sugar.dose_mass_kg");
        sugar += of;
        CHECK(std::abs(of + doses.number(i, "cocoa.dose_mass_kg") - doses.number(i, "mass_kg")) < 1e-6 * filled);
        CHECK(doses.number(i, "sugar.dose_share") == Approx(of / doses.number(i, "mass_kg")).epsilon(1e-4));
    }
    CHECK(sugar > 0);
    CHECK(lastOf(series, "cocoa.dosed_mass_kg") > 0);

    // particles.csv names the powder of each, and is read back.
    std::vector<Diagnostic> faults;
    const Particles end = readParticleList(box / "out/particles.csv", faults, {{"cocoa", kFirstPowder}, {"sugar", 3}});
    CHECK(faults.empty());
    const auto ofSugar = static_cast<double>(std::count(end.material.begin(), end.material.end(), 3));
    CHECK(ofSugar == lastOf(series, "sugar.canister_count") + lastOf(series, "sugar.throat_count"));

    // The field of one powder holds its mass, and bears a part of the stress.
    const Table alone = Table::read(box / "out/fields/sugar-alone.csv"),
                both = Table::read(box / "out/fields/both.csv");
    double mass = 0, borne = 0, borneByBoth = 0;
    for (std::size_t i = alone.rows() - 4; i < alone.rows(); ++i) {
        CHECK(alone.number(i, "density_kg_m3") <= both.number(i, "density_kg_m3") * (1 + 1e-5));
        mass += alone.number(i, "density_kg_m3") * 0.014 * 0.067 * 0.021 / 4;
        borne += alone.number(i, "contact_stress_yy_Pa");
        borneByBoth += both.number(i, "contact_stress_yy_Pa");
    }
    CHECK(borne > 0);
    CHECK(borne < borneByBoth);
    const double inside = lastOf(series, "sugar.canister_mass_kg") + lastOf(series, "sugar.throat_mass_kg");
    CHECK(mass == Approx(inside).epsilon(1e-4));

    const auto summary = nlohmann::json::parse(readText(box / "out/summary.json"));
    CHECK(summary["powders"][1]["name"] == "sugar");
    CHECK(summary["powders"][1]["dosed_mass_kg"].get<double>() == Approx(lastOf(series, "sugar.dosed_mass_kg")));
    CHECK(box.vkdose("render out --color powder --size 320x240 --out p.png").code == 0);
    CHECK(box.vkdose("report out").code == 0);
}

TEST_CASE("a run of two powders that is killed and resumed, or begun from its bed, ends with the same bits", "[slow]") {
    const std::string backend = GENERATE(std::string("reference"), std::string("vulkan"));
    CAPTURE(backend);
    const Sandbox box;
    writeCase(box);
    const std::vector<std::string> options{(box / "two.toml").string(), "--quiet", "--set", "checkpoint.time_s=0.005"};
    REQUIRE(box.vkdose("run " + words(options) + "--out whole --backend " + backend).code == 0);
    CHECK(killedUntilItEnds(box, options, backend, 3) >= 1);
    REQUIRE(box.vkdose("run --from whole --quiet --out again").code == 0);
    for (const std::string& name : kTables) {
        CAPTURE(name);
        CHECK(readText(box / "whole" / name) == readText(box / "cut" / name));
        // The time series of a run from a settled bed begins there.
        if (name != "timeseries.csv") CHECK(readText(box / "whole" / name) == readText(box / "again" / name));
    }
}

TEST_CASE("a sweep varies what two powders have with each other") {
    const Sandbox box;
    writeCase(box);
    box.write("study.toml",
              "base = \"two.toml\"\n[set]\nstop.max_doses = 1\n[[axis]]\nkey = \"contact.cocoa-sugar.friction\"\n"
              "values = [0.1, 0.9]\n");
    const auto swept = box.vkdose("sweep study.toml --out s --quiet");
    CAPTURE(swept.err);
    REQUIRE(swept.code == 0);
    const auto member = [&](const char* number) { return box / "s" / "members" / number; };
    CHECK_THAT(readText(member("0000") / "case.toml"), Catch::Contains("friction = 0.1"));
    CHECK(readText(member("0000") / "particles.csv") != readText(member("0001") / "particles.csv"));
}
