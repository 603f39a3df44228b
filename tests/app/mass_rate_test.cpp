// The mass rate of a run at the end of the program, in its files, in tables of a sweep and as a target.
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "host/app/end_table.h"
#include "host/core/csv_table.h"
#include "tests/app/sandbox.h"
#include "tests/support/catch.h"
#include "tests/support/near.h"

using namespace vkdose;
using namespace vkdose::test;

namespace {

/// One dose of half a second, a turn of the drive, in ten windows.
constexpr const char* kFeeder = R"(base = ")" VKDOSE_SOURCE_DIR R"(/cases/mini.toml"
[settle]
time_s = 0.05
[dose]
rotate_s = 0.5
rest_s = 0.0
[stop]
max_doses = 1
[sensors]
rate_window_s = 0.05
)";

/// The rate of six windows, with doses of this closed form [kg].
std::string lineOf(std::size_t doses, double closedForm, std::size_t windows = 6) {
    RunResult r;
    r.doses.resize(doses);
    for (Dose& d : r.doses) d.closedForm = closedForm;
    MassRate rate;
    rate.window = 0.5;
    rate.windows.resize(windows);
    rate.all = {2e-3, 1e-4, 0.25};
    return rateLine(r, rate);
}

}  // namespace

TEST_CASE("the end of a run tells the rate of a feeder, and not that of doses with a closed form") {
    const double none = std::nan("");
    const std::string line = "rate     2.000 g/s +- 0.100 g/s, RSD 25 % over 6 windows of 0.5 s\n";
    CHECK(lineOf(1, 3e-3) == line);
    CHECK(lineOf(4, none) == line);
    CHECK(lineOf(0, none) == line);
    CHECK(lineOf(2, 3e-3).empty());
    CHECK(lineOf(1, none, 4).empty());
}

TEST_CASE("no steady rate is told of a device that gives its powder in portions") {
    RunResult r;
    MassRate rate;
    rate.window = 0.08;
    for (int k = 0; k < 18; ++k) rate.windows.push_back({0.08 * k, 0.08 * (k + 1), 0});
    rate.all = {5.8e-3, 2.5e-3, 1.73};
    rate.steady = 2;
    rate.steadyPart = {6e-3, 2.6e-3, 1.5};
    CHECK(rateLine(r, rate) ==
          "rate     5.800 g/s +- 2.500 g/s, RSD 173 % over 18 windows of 0.08 s; the powder comes in portions, so that "
          "no rate is steady\n");
    rate.steadyPart.relative = 0.9;  // it came late, and then all the time
    CHECK_THAT(rateLine(r, rate), Catch::Contains("; steady from t = 0.16 s: 6.000 g/s +- 2.600 g/s, RSD 90 %"));
}

TEST_CASE("a device without a drive has no torque of the drive in its table") {
    RunResult r;
    r.doses.resize(1);
    r.doses[0].coilTorque = 1.5e-3;
    Case c;
    CHECK_THAT(reportText(c, r, "x"), Catch::Contains(" none            none  incomplete"));
    c.world.coil.emplace();
    CHECK_THAT(reportText(c, r, "x"), Catch::Contains(" 1.500            none  incomplete"));
}

TEST_CASE("a run of one long dose tells its mass rate, the files of a sweep too, and calibrate takes it") {
    const Sandbox box;
    box.write("feeder.toml", kFeeder);
    const auto o = box.vkdose("run feeder.toml --backend reference --out out");
    CAPTURE(o.out, o.err);
    REQUIRE(o.code == 0);
    CHECK_THAT(o.out, Catch::Contains("\nrate     ") && Catch::Contains(" over 10 windows of 0.05 s"));

    // All windows lie in the dose, and fill it: the mean is its mass over its time.
    const auto summary = nlohmann::json::parse(readText(box / "out/summary.json"));
    const auto& rate = summary.at("analysis").at("rate");
    const double mean = summary.at("doses").at(0).at("mass_kg").get<double>() / 0.5;
    REQUIRE(mean > 0);
    CHECK(rate.at("windows") == 10);
    CHECK(near(rate.at("mean_kg_s").get<double>(), mean, mean, 1e-6));

    box.write("study.toml", R"(base = "feeder.toml"
[calibrate]
method = "surrogate"
max_runs = 3
confirming_seeds = 2
[[calibrate.target]]
figure = "rate.mean_kg_s"
value = 1.0
uncertainty = 0.001
[[calibrate.parameter]]
key = "contact.friction"
low = 0.3
high = 0.6
)");
    const auto found = box.vkdose("calibrate study.toml --backend reference --out found");
    CAPTURE(found.out, found.err);
    CHECK(found.code == 1);  // a kilogram a second
    const Table members = Table::read(box / "found/members.csv");
    const auto finding = nlohmann::json::parse(readText(box / "found/calibration.json"));
    REQUIRE(members.rows() == 3);
    for (std::size_t i = 0; i < 3; ++i) {
        const double told = members.number(i, "rate_kg_s");
        CHECK(told > 0);
        CHECK(near(finding.at("points").at(i).at("values").at(0).at(0).get<double>(), told, told, 1e-6));
    }

    std::string study = readText(box / "study.toml");
    study.replace(study.find("rate.mean_kg_s"), 14, "rate.mean_kgs");
    box.write("study.toml", study);
    const auto wrong = box.vkdose("calibrate study.toml --backend reference --out other");
    CHECK(wrong.code == 2);
    CHECK_THAT(wrong.err, Catch::Contains("did you mean \"rate.mean_kg_s\""));
}

TEST_CASE("windows of the rate that are shorter than the sensors can tell are refused") {
    const Sandbox box;
    box.write("feeder.toml", kFeeder);
    const auto o = box.vkdose("check feeder.toml --set sensors.rate_window_s=0.02");
    CHECK(o.code == 2);
    CHECK_THAT(o.err, Catch::Contains("sensors.rate_window_s") && Catch::Contains("5 sensor intervals"));
}

TEST_CASE("a screw and a wheel with pockets: check tells the closed form, the run the mass of each cycle") {
    const Sandbox box;
    std::string text = "base = \"" VKDOSE_SOURCE_DIR
                       "/cases/mini.toml\"\n[dose]\nrotate_s = 1.5\nrest_s = 0.0\n"
                       "[stop]\nmax_doses = 1\n";
    const std::string wheel =
        "[[body]]\nname = \"wheel\"\nshape = \"ball\"\nradius_mm = 1\nat = [0, 0.05, 0.005]\n[body.motion]\n"
        "kind = \"turn\"\nspeed_rpm = 120\npockets = 4\n";
    box.write("wheel.toml", text + wheel);
    const auto o = box.vkdose("run wheel.toml --backend reference --out out");
    CAPTURE(o.out, o.err);
    REQUIRE(o.code == 0);
    CHECK_THAT(o.out, Catch::Contains("\ncycle    ") && Catch::Contains(" over 12 cycles, each a pocket of wheel"));
    const auto summary = nlohmann::json::parse(readText(box / "out/summary.json"));
    const auto& cycle = summary.at("analysis").at("cycle");
    CHECK(cycle.at("is") == "pocket of wheel");
    const Table cycles = Table::read(box / "out/cycles.csv");
    REQUIRE(cycles.rows() == 12);
    double sum = 0;
    for (const double mass : cycles.column("mass_kg")) sum += mass;
    const double dosed = summary.at("doses").at(0).at("mass_kg").get<double>();
    CHECK(near(sum, dosed, dosed, 1e-4));  // all of the dose, but for a part of a step
    CHECK(near(cycle.at("mean_kg").get<double>(), dosed / 12, dosed, 1e-4));

    box.write("wrong.toml", text + wheel +
                                "[[body]]\nname = \"b\"\nshape = \"ball\"\nradius_mm = 1\n"
                                "at = [0, 0.06, 0.005]\n[body.motion]\nkind = \"shake\"\n"
                                "amplitude_mm = 1\nfrequency_hz = 2\npockets = 4\n");
    const auto wrong = box.vkdose("check wrong.toml");
    CHECK(wrong.code == 2);
    CHECK_THAT(wrong.err, Catch::Contains("body[1].motion.pockets") && Catch::Contains("wrong.toml:"));
    CHECK_THAT(box.vkdose("check wheel.toml --set body[0].motion.pockets=0").err,
               Catch::Contains("motion.pockets = 0"));

    const auto screw = box.vkdose("check " VKDOSE_SOURCE_DIR "/cases/auger.toml");
    CHECK_THAT(screw.out,
               Catch::Contains("rate       ") && Catch::Contains("(rho_b times pitch and free section of screw)"));
}

TEST_CASE("what goes through the end of a domain that repeats counts as delivered") {
    const Sandbox box;
    // Two spheres fly along z, one the other way, and go through the end five times and twice.
    box.write("spheres.csv", "x,y,z,r,vx,vy,vz\n0,0,0.01,0.002,0,0,0.105\n0,0.005,0.01,0.001,0,0,-0.045\n");
    box.write("endless.toml", R"(boundaries = "none"
gravity = [0, 0, 0]
bulk_density = 800
[particles]
density = 1500
list = "spheres.csv"
[contact]
k = 2000
k1_over_k = 0.2
kc_over_k = 0
plasticity_depth = 0.05
damping = 0.02
friction = 0.5
[settle]
time_s = 1
[sensors]
interval_s = 0.05
rate_window_s = 0.25
[domain]
low = [-0.02, -0.02, 0]
high = [0.02, 0.02, 0.02]
periodic = "z"
)");
    const auto o = box.vkdose("run endless.toml --backend reference --events --out out");
    CAPTURE(o.out, o.err);
    REQUIRE(o.code == 0);
    const double small = 1500 * 4.0 / 3 * kPi * 1e-9, large = 8 * small;
    const Table series = Table::read(box / "out/timeseries.csv");
    const std::size_t last = series.rows() - 1;
    CHECK(series.number(last, "through_x_kg") == 0);
    CHECK(nearRelative(series.number(last, "through_z_kg"), 5 * large - 2 * small, 1e-6));
    CHECK_THAT(o.out, Catch::Contains("\"through_z_kg\":"));
    const auto rate = nlohmann::json::parse(readText(box / "out/summary.json")).at("analysis").at("rate");
    CHECK(nearRelative(rate.at("mean_kg_s").get<double>(), 5 * large - 2 * small, 2e-2));
}
