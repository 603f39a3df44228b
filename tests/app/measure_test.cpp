// Element tests from a run to its summary, and as the targets of a calibration: a sphere between floor and piston,
// whose force is known.

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "host/core/csv_table.h"
#include "tests/app/sandbox.h"
#include "tests/support/catch.h"
#include "tests/support/near.h"

using namespace vkdose::test;
namespace fs = std::filesystem;
using Json = nlohmann::json;

namespace {

/// An elastic sphere of 2.5 mm on a floor. A piston comes down to this gap [mm], stays and goes up again.
void writePress(const Sandbox& box, const std::string& name, double gap) {
    box.write("one.csv", "x,y,z,r\n0,0.00125,0,0.00125\n");
    const std::string down = std::to_string((gap - 3) * 1e-3);
    box.write(name + ".csv", "time_s,y\n0,0\n0.02," + down + "\n0.04," + down + "\n0.06,0\n");
    box.write(name + ".toml", R"(boundaries = "none"
[particles]
density = 1427.0
list = "one.csv"
[contact]
k = 1000.0
k1_over_k = 1.0
kc_over_k = 0.0
damping = 0.02
friction = 0.5
[[body]]
name = "floor"
shape = "plane"
normal = [0, 1, 0]
[[body]]
name = "piston"
shape = "disc"
radius_mm = 5.0
at = [0, 0.003, 0]
rotation_axis = [1, 0, 0]
rotation_deg = -90.0
[body.motion]
kind = "table"
file = ")" + name + R"(.csv"
[settle]
time_s = 0.06
[sensors]
interval_s = 0.0005
[[measure]]
kind = "compression"
name = "press"
body = "piston"
area_mm2 = 100.0
height_mm = 3.0
[[measure]]
kind = "angle_of_repose"
)");
}

Json summaryIn(const fs::path& folder) {
    return Json::parse(readText(folder / "summary.json"));
}

}  // namespace

TEST_CASE("measures: a sphere under a piston has the stress and the work of its two springs") {
    const Sandbox box;
    writePress(box, "press", 2.4);
    const auto o = box.vkdose("run press.toml --backend reference --out out");
    CAPTURE(o.out, o.err);
    REQUIRE(o.code == 0);
    CHECK_THAT(o.out, Catch::Contains("measure  press: largest stress ") &&
                          Catch::Contains("measure  angle_of_repose: none; the powder makes no heap"));
    const Json measures = summaryIn(box / "out").at("measures");
    const Json& press = measures.at("press");
    // Floor and piston each press it in by 0.05 mm: F = k delta = 0.05 N on 100 mm2. Dashpots add 0.02 kg/s times half
    // of the piston's 0.03 m/s, 0.6 %, while it moves.
    CHECK(near(press.at("max_stress_Pa").get<double>(), 500, 500, 0.01));
    // Two springs in a row have k/2: W = k/4 (0.1 mm)^2 = 2.5 uJ. The dashpots take 1.2 % going and 1.2 % coming.
    CHECK(near(press.at("work_J").get<double>(), 2.5e-6, 2.5e-6, 0.02));
    CHECK(near(press.at("returned_work_J").get<double>(), 2.5e-6, 2.5e-6, 0.02));
    CHECK(press.at("returned_work_J") < press.at("work_J"));
    // Let go when the gap has grown by 0.1 mm, less 1 %. A line is 0.015 mm, and tells the end to half of that.
    CHECK(near(press.at("elastic_recovery").get<double>(), 0.099 / 2.4, 0.1 / 2.4, 0.075));
    CHECK(press.at("kind") == "compression");
    CHECK(measures.at("angle_of_repose").contains("none_because"));
}

TEST_CASE("measures: a piston that a force drives presses with its stress") {
    const Sandbox box;
    writePress(box, "press", 2.4);
    std::string text = readText(box / "press.toml");
    const std::string table = "kind = \"table\"\nfile = \"press.csv\"\n";
    REQUIRE(text.find(table) != std::string::npos);
    text.replace(text.find(table), table.size(),
                 "kind = \"free\"\nmass_g = 1\nalong = [0, -1, 0]\nfile = \"drive.csv\"\ndamping_kg_s = 2\n");
    box.write("drive.csv", "time_s,force_N\n0,0.05\n0.045,0.05\n0.055,-0.2\n");
    box.write("press.toml", "gravity = [0, -1e-6, 0]\n" + text);
    const auto o = box.vkdose("run press.toml --backend reference --out out");
    CAPTURE(o.out, o.err);
    REQUIRE(o.code == 0);
    const Json press = summaryIn(box / "out").at("measures").at("press");
    CHECK(near(press.at("max_stress_Pa").get<double>(), 500, 500, 0.01));  // 0.05 N on 100 mm2
    CHECK(near(press.at("work_J").get<double>(), 2.5e-6, 2.5e-6, 0.05));   // as with a prescribed way
}

TEST_CASE("measures: a piston that never reaches the powder compresses nothing, and the run says so") {
    const Sandbox box;
    writePress(box, "above", 2.6);
    const auto o = box.vkdose("run above.toml --backend reference --out out");
    CAPTURE(o.out, o.err);
    REQUIRE(o.code == 0);
    CHECK_THAT(o.out, Catch::Contains("measure  press: none; the powder never pressed against the piston"));
    CHECK(summaryIn(box / "out").at("measures").at("press").contains("none_because"));
}

TEST_CASE("measures: spheres that fall through a plane one after another discharge at their mass and pace") {
    const Sandbox box;
    // One each 5 ms: 5 mm apart at 1 m/s, nearly without gravity, which only says what is up.
    std::string list = "x,y,z,r,vx,vy,vz\n";
    for (int i = 1; i <= 20; ++i) list += "0," + std::to_string(5e-3 * i) + ",0,0.001,0,-1,0\n";
    box.write("column.csv", list);
    box.write("column.toml", R"(boundaries = "none"
gravity = [0, -1e-6, 0]
bulk_density = 800
[particles]
density = 1427.0
list = "column.csv"
[contact]
k = 1000.0
k1_over_k = 1.0
kc_over_k = 0.0
damping = 0.02
friction = 0.5
[settle]
time_s = 0.1
[sensors]
interval_s = 0.001
[[region]]
name = "pan"
kind = "beyond"
point = [0, 0, 0]
normal = [0, -1, 0]
[[measure]]
kind = "discharge"
region = "pan"
hole_mm = 10.0
from_s = 0.0
[[region]]
name = "window"
kind = "box"
deletes = false
low = [-0.01, 0.0195, -0.01]
high = [0.01, 0.0445, 0.01]
[[measure]]
kind = "content"
region = "window"
from_s = 0.0095
to_s = 0.0505
)");
    const auto o = box.vkdose("run column.toml --backend reference --out out");
    CAPTURE(o.out, o.err);
    REQUIRE(o.code == 0);
    CHECK_THAT(o.out, Catch::Contains("measure  discharge: rate of discharge 1.") && Catch::Contains(" g/s"));
    const Json d = summaryIn(box / "out").at("measures").at("discharge");
    const double rate = 1427 * 4.0 / 3 * 3.14159265358979 * 1e-9 / 5e-3;
    // The line through a staircase of twenty steps is out by less than one of them in twenty.
    CHECK(near(d.at("rate_kg_s").get<double>(), rate, rate, 0.02));
    // Five spheres at a time are in 25 mm of the column.
    const Json content = summaryIn(box / "out").at("measures").at("content");
    const double five = 5 * 1427 * 4.0 / 3 * 3.14159265358979 * 1e-9;
    CHECK(near(content.at("mass_kg").get<double>(), five, five, 1e-6));
    CHECK(content.at("mass_deviation_kg").get<double>() < 1e-6 * five);
    CHECK(content.at("lines") == 41);
    // C = W / (rho sqrt(g) (D - 1.5 d)^5/2), d = 2 mm
    CHECK(near(d.at("beverloo_constant").get<double>(), rate / (800 * 1e-3 * std::pow(7e-3, 2.5)),
               rate / (800 * 1e-3 * std::pow(7e-3, 2.5)), 0.02));
}

TEST_CASE("measures: a bed in a drum has its slope in all of the powder, and that of the glass from the front") {
    const Sandbox box;
    // Spheres that hardly fall, 30 degrees steep where x < 0; where x > 0 the half of them that is nearer to the glass
    // stands at 40. Layers are shifted, so that they fill each other's gaps in a photograph.
    std::ostringstream list;
    list << "x,y,z,r\n";
    for (int layer = 0; layer < 8; ++layer)
        for (int i = -12; i <= 12; ++i)
            for (int j = 0; j < 4; ++j) {
                const double x = 2.02e-3 * (i + layer % 4 / 4.0);
                const double slope = std::tan((layer > 3 && x > 0 ? 40 : 30) * 0.0174532925);
                list << x << "," << slope * x - 2.02e-3 * (j + 1) << "," << 1e-3 + 2.02e-3 * layer << ",0.001\n";
            }
    box.write("bed.csv", list.str());
    // Turning about -z the drum carries its lowest point towards -x: then this bed leans the wrong way.
    for (const char* speed : {"1", "-1"}) {
        box.write("drum.toml", R"(boundaries = "none"
gravity = [0, -1e-6, 0]
[particles]
density = 1427.0
list = "bed.csv"
[contact]
k = 1000.0
k1_over_k = 1.0
kc_over_k = 0.0
damping = 0.02
friction = 0.5
[[body]]
name = "shell"
shape = "cylinder"
radius_mm = 40.0
length_mm = 17.0
[body.motion]
kind = "turn"
axis = [0, 0, 1]
speed_rpm = )" + std::string(speed) +
                                   R"(
[settle]
time_s = 0.01
[sensors]
interval_s = 0.001
[frames]
interval_s = 0.001
[[measure]]
kind = "drum_angle"
name = "bulk"
body = "shell"
from_s = 0
[[measure]]
kind = "drum_angle"
name = "front"
body = "shell"
view = "front"
window_mm = 20.0
from_s = 0
[[measure]]
kind = "drum_angle"
name = "wide"
body = "shell"
view = "front"
window_mm = 39.0
from_s = 0
)");
        const auto o = box.vkdose("run drum.toml --backend reference --force --out out");
        CAPTURE(o.out, o.err);
        REQUIRE(o.code == 0);
        CHECK_THAT(o.out, Catch::Contains("measure  front: angle of the surface ") &&
                              Catch::Contains("measure  wide: none; the bed does not reach from -39 to 39 mm: "));
        const Json measures = summaryIn(box / "out").at("measures");
        const Json& front = measures.at("front");
        const double sense = speed[0] == '-' ? -1 : 1;
        // Half lines of 30 and 40 degrees have the mean slope; in all of the powder they are at 30 and at that of both
        // halves. Spheres ripple by a tenth of a radius on 40 mm.
        CHECK(near(sense * front.at("angle_deg").get<double>(), 35.3, 1, 0.4));
        CHECK(near(sense * measures.at("bulk").at("angle_deg").get<double>(), 32.7, 1, 0.6));
        CHECK(front.at("frames") == 11);
        CHECK(near(front.at("angle_error_deg").get<double>(), 0, 1, 1e-3));  // nothing moves
        CHECK(measures.at("wide").contains("none_because"));
    }
}

TEST_CASE("calibrate meets figures of two element tests at once, and says what each constrains") {
    const Sandbox box;
    writePress(box, "press", 2.4);
    writePress(box, "less", 2.45);
    const auto study = [](const std::string& figure) {
        return R"(base = "press.toml"
[calibrate]
method = "surrogate"
max_runs = 12
[[calibrate.target]]
figure = ")" + figure +
               R"("
value = 650.0
uncertainty = 5.0
[[calibrate.target]]
figure = "press.max_stress_Pa"
value = 325.0
uncertainty = 5.0
base = "less.toml"
[[calibrate.parameter]]
key = "contact.k"
low = 800.0
high = 2000.0
[[calibrate.parameter]]
key = "contact.friction"
low = 0.1
high = 0.5
)";
    };
    box.write("study.toml", study("press.max_stress_Pa"));
    const auto o = box.vkdose("calibrate study.toml --backend reference --out out");
    CAPTURE(o.out, o.err);
    REQUIRE(o.code == 0);
    CHECK_THAT(o.out, Catch::Contains("the targets are met") && Catch::Contains("misfit"));
    CHECK_THAT(o.out, Catch::Contains("contact.k: press.max_stress_Pa of press.toml +") &&
                          Catch::Contains("mostly by") && Catch::Contains("the targets do not constrain it"));
    // The stress is in proportion to k: 500 Pa at 1000 N/m.
    const std::string found = readText(box / "out/calibrated.toml");
    const double k = std::stod(found.substr(found.find("\nk = ") + 5));
    CHECK(near(k, 1300, 1300, 0.02));
    const std::string members = readText(box / "out/members.csv");
    CHECK_THAT(members, Catch::Contains("contact.k,contact.friction,base,status") && Catch::Contains(",less.toml,ok"));

    // The report says the same as the text.
    const Json finding = Json::parse(readText(box / "out/calibration.json"));
    CHECK(finding.at("met") == true);
    CHECK(finding.at("confirming_seeds") == Json({2, 3, 4}));
    const Json& confirmed = finding.at("confirmations").back().at("figures");
    CHECK(confirmed.at(0).at("runs") == 3);
    CHECK(confirmed.at(0).at("verdict") == "met");
    CHECK(near(confirmed.at(0).at("mean").get<double>(), 650, 650, 0.01));
    CHECK(finding.at("parameters").at(0).at("constrained") == true);
    CHECK(finding.at("parameters").at(1).at("constrained") == false);
    CHECK(near(finding.at("parameters").at(0).at("chosen").get<double>(), 1300, 1300, 0.02));
    // Both targets know k to their uncertainty over their slope, 10 Pa over 0.5 Pa and 5 over 0.25: 14 N/m together,
    // and 2 x 1.96 of them are an interval of 55. What the surrogates do not know comes to it.
    const Json& fits = finding.at("parameters").at(0).at("interval_95");
    const double low = fits.at(0).get<double>(), high = fits.at(1).get<double>();
    CHECK(near((low + high) / 2, 1300, 1300, 0.03));
    CHECK(high - low > 45);
    CHECK(high - low < 150);
    CHECK_THAT(o.out, Catch::Contains("each point predicted from the others") && Catch::Contains(" points off by ") &&
                          Catch::Contains("95 % from ") &&
                          Catch::Contains("correlation of contact.k and contact.friction ") &&
                          Catch::Contains("draws      out/powder-draws.csv, 200 of the points that fit"));
    const vkdose::Table draws = vkdose::Table::read(box / "out/powder-draws.csv");
    CHECK(draws.names() == vkdose::Row{"contact.k", "contact.friction"});
    CHECK(draws.rows() == 200);
    REQUIRE(box.vkdose("report out").code == 0);
    CHECK_THAT(readText(box / "out/report.html"), Catch::Contains("\"name\":\"press.max_stress_Pa of less.toml\""));

    box.write("study.toml", study("press.max_stres_Pa"));
    const auto wrong = box.vkdose("calibrate study.toml --backend reference --out other");
    CHECK(wrong.code == 2);
    CHECK_THAT(wrong.err, Catch::Contains("study.toml:6") && Catch::Contains("has no such figure") &&
                              Catch::Contains("did you mean \"press.max_stress_Pa\""));
}

TEST_CASE("bulk_density = measure: the closed form of the doses has the density of the run's own settled bed") {
    const Sandbox box;
    const std::string common = R"(base = ")" VKDOSE_SOURCE_DIR R"(/cases/mini.toml"
bulk_density = "measure"
[settle]
time_s = 0.1
[dose]
rotate_s = 0.02
rest_s = 0.01
[stop]
max_doses = 1
[checkpoint]
time_s = 0.105
)";
    box.write("full.toml", common + "[particles]\nmass_g = 5.0\n");
    const auto o = box.vkdose("run full.toml --backend reference --out out");
    CAPTURE(o.out, o.err);
    REQUIRE(o.code == 0);
    CHECK_THAT(o.out, Catch::Contains("kg/m3 in the closed form, measured in the settled bed"));
    const Json full = summaryIn(box / "out");
    const Json& form = full.at("closed_form");
    const double density = form.at("bulk_density_kg_m3").get<double>();
    CHECK(form.at("bulk_density_is") == "measured");
    CHECK(near(density, full.at("settled").at("bulk_density_kg_m3").get<double>(), density, 1e-8));  // its digits
    CHECK(near(density, 0.46 * 1427, 0.46 * 1427, 0.4));
    // rho p pi r^2 n of mini's coil: 21 mm in 3 turns, 5.9 mm, 0.02 s at 120 rpm.
    const double volume = 7e-3 * 3.14159265358979 * 5.9e-3 * 5.9e-3 * 0.04;
    CHECK(
        near(full.at("doses").at(0).at("closed_form_mass_kg").get<double>(), density * volume, density * volume, 1e-6));
    const std::string resolved = readText(box / "out/case.toml");
    CHECK_THAT(resolved, Catch::Contains("bulk_density = \"measure\"") &&
                             Catch::Contains("derived = \"bulk_density = 656.4 kg/m3, 0.46 of the particles' density"));

    // A bed of a hundred spheres is too small; then the estimate stands, and is told.
    box.write("small.toml", common);
    const auto few = box.vkdose("run small.toml --backend reference --out few");
    CHECK(few.code == 0);
    CHECK_THAT(few.out, Catch::Contains("assumed: the bed has not settled, or is too small"));
    CHECK(summaryIn(box / "few").at("closed_form").at("bulk_density_is") == "assumed");

    box.write("never.toml", common + "");
    const auto never = box.vkdose("check never.toml --set settle.time_s=0");
    CHECK(never.code == 2);
    CHECK_THAT(never.err, Catch::Contains("bulk_density") && Catch::Contains("it does not settle"));
    CHECK_THAT(box.vkdose("check never.toml --set bulk_density=\"measur\"").err, Catch::Contains("did you mean"));
    // A number in its place takes it and its words away.
    CHECK(box.vkdose("check out/case.toml --set bulk_density=500").code == 0);
}
