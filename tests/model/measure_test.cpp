// The tables [[measure]] of a case: every kind from its keys, the resolved case, and faults with their places.

#include "host/core/error.h"
#include "tests/model/case_files.h"
#include "tests/support/catch.h"
#include "tests/support/near.h"

using namespace vkdose;
using namespace vkdose::test;
using Catch::Contains;

namespace {

/// A case with a plate, a drum and a piston, and these measures.
std::string withMeasures(const std::string& measures, const std::string& frames = "[frames]\ninterval_s = 0.01\n") {
    return withBodies(R"([[region]]
name = "pan"
kind = "beyond"
point = [0, -0.02, 0]
normal = [0, -1, 0]
[[body]]
name = "plate"
shape = "plane"
[[body]]
name = "drum"
shape = "cylinder"
radius_mm = 100.0
length_mm = 20.0
[body.motion]
kind = "turn"
axis = [0, 0, 1]
speed_rpm = 30.0
[[body]]
name = "piston"
shape = "disc"
radius_mm = 5.0
at = [0, 0.08, 0]
[body.motion]
kind = "slide"
velocity = [0, -0.01, 0]
[[body]]
name = "vane"
shape = "disc"
radius_mm = 5.0
at = [0, 0.01, 0]
[body.motion]
kind = "turn"
axis = [0, 0, 1]
speed_rpm = 30.0
)" + frames + measures);
}

struct Read {
    Folder folder;
    Case load(const std::string& measures) const { return loadCase(folder.write("case.toml", withMeasures(measures))); }
    std::string fault(const std::string& text) const { return faultOf(folder.write("case.toml", text)); }
};

const std::string kAll = R"([[measure]]
kind = "angle_of_repose"
at = [0.01, 0.002, -0.01]
[[measure]]
kind = "bulk_density"
name = "poured"
radius_mm = 14.0
time_s = 0.05
[[measure]]
kind = "drum_angle"
body = "drum"
from_s = 0.04
[[measure]]
kind = "compression"
body = "piston"
area_mm2 = 78.5
height_mm = 80.0
axis = [0, 2, 0]
[[measure]]
kind = "shear"
body = "drum vane"
radius_mm = 16.0
inner_radius_mm = 8.0
from_s = [0.02, 0.05]
to_s = [0.04, 0.08]
pre_shear_from_s = [0.01, 0.045]
pre_shear_to_s = [0.02, 0.05]
[[measure]]
kind = "discharge"
region = "pan"
hole_mm = 7.5
from_s = 0.03
[[measure]]
kind = "content"
region = "pan"
from_s = 0.03
to_s = 0.05
[[measure]]
kind = "drum_angle"
name = "photographed"
body = "drum"
view = "front"
window_mm = 21.0
from_s = 0.04
[[measure]]
kind = "angle_of_repose"
name = "outline"
view = "side"
)";

}  // namespace

TEST_CASE("measures: every kind comes from its keys, and the resolved case gives the same") {
    Read read;
    const Case first = read.load(kAll);
    const Case again = loadCase(read.folder.write("resolved.toml", first.resolved));
    for (const Case* c : {&first, &again}) {
        const std::vector<ElementTest>& m = c->measures;
        REQUIRE(m.size() == 9);
        CHECK(m[0].kind == ElementTest::Kind::AngleOfRepose);
        CHECK(m[0].name == "angle_of_repose");
        CHECK(near(m[0].at, Vec3(0.01, 0.002, -0.01), 1, 1e-15));
        CHECK_FALSE(m[0].time);
        CHECK(m[1].name == "poured");
        CHECK(m[1].radius == 14e-3);
        CHECK(m[1].time == 0.05);
        CHECK(m[2].bodies == std::vector<std::size_t>{1});
        REQUIRE(m[2].windows.size() == 1);
        CHECK(m[2].windows[0].from == 0.04);
        CHECK(m[2].windows[0].to > 1e9);
        CHECK(nearRelative(m[3].area, 78.5e-6, 1e-12));
        CHECK(m[3].height == 80e-3);
        CHECK(m[3].axis == Vec3(0, 1, 0));
        CHECK(m[4].bodies == std::vector<std::size_t>{1, 3});
        CHECK(m[4].innerRadius == 8e-3);
        REQUIRE(m[4].windows.size() == 2);
        CHECK(m[4].windows[1].from == 0.05);
        CHECK(m[4].windows[1].to == 0.08);
        REQUIRE(m[4].preShears.size() == 2);
        CHECK(m[4].preShears[1].from == 0.045);
        CHECK(c->world.regions.at(m[5].region).name == "pan");
        CHECK(m[5].hole == 7.5e-3);
        REQUIRE(m[5].windows.size() == 1);
        CHECK(m[5].windows[0].from == 0.03);
        CHECK(m[6].kind == ElementTest::Kind::Content);
        CHECK(m[6].region == m[5].region);
        REQUIRE(m[6].windows.size() == 1);
        CHECK(m[6].windows[0].to == 0.05);
        CHECK(m[2].view == ElementTest::View::Bulk);
        CHECK(m[7].view == ElementTest::View::Front);
        CHECK(nearRelative(m[7].halfWidth, 21e-3, 1e-12));
        CHECK(m[0].view == ElementTest::View::Bulk);
        CHECK(m[8].view == ElementTest::View::Side);
    }
    CHECK(again.resolved == first.resolved);
}

TEST_CASE("measures: a fault names file, line, key, value and remedy") {
    Read read;
    const auto says = [&](const std::string& measure) { return read.fault(withMeasures("[[measure]]\n" + measure)); };
    CHECK_THAT(says("kind = \"angle_of_rest\"\n"),
               Contains("case.toml") && Contains("measure[0].kind") && Contains("did you mean \"angle_of_repose\""));
    CHECK_THAT(says("kind = \"bulk_density\"\n"), Contains("radius_mm") && Contains("is missing"));
    CHECK_THAT(says("kind = \"bulk_density\"\nradius_mm = 5\nbody = \"drum\"\n"), Contains("unknown key"));
    CHECK_THAT(says("kind = \"drum_angle\"\nbody = \"drun\"\nfrom_s = 0\n"),
               Contains("there is no body \"drun\"") && Contains("did you mean \"drum\""));
    CHECK_THAT(says("kind = \"drum_angle\"\nbody = \"drum plate\"\nfrom_s = 0\n"), Contains("names 2 bodies"));
    CHECK_THAT(says("kind = \"drum_angle\"\nbody = \"piston\"\nfrom_s = 0\n"), Contains("does not turn"));
    CHECK_THAT(says("kind = \"drum_angle\"\nbody = \"drum\"\nfrom_s = \"late\"\n"), Contains("is no time"));
    const std::string turned = "kind = \"drum_angle\"\nbody = \"drum\"\nfrom_s = 0\n";
    CHECK_THAT(says(turned + "view = \"frond\"\n"), Contains("measure[0].view") && Contains("did you mean \"front\""));
    CHECK_THAT(says(turned + "view = \"side\"\n"), Contains("measure[0].view = \"side\": is no view of this kind") &&
                                                       Contains("give \"front\", or \"bulk\""));
    CHECK_THAT(says(turned + "view = \"front\"\n"),
               Contains("measure[0].window_mm: is missing") && Contains("half of the drum's radius"));
    CHECK_THAT(
        says(turned + "view = \"front\"\nwindow_mm = 100\n"),
        Contains("window_mm = 100: reaches beyond the drum, whose radius is 100 mm") && Contains("to either side"));
    CHECK_THAT(says(turned + "view = \"front\"\nwindow_mm = -5\n"), Contains("window_mm"));
    CHECK_THAT(says(turned + "window_mm = 21\n"),
               Contains("window_mm = 21: belongs to a view through the glass") && Contains("add view = \"front\""));
    CHECK_THAT(says("kind = \"angle_of_repose\"\nview = \"front\"\n"), Contains("give \"side\", or \"bulk\""));
    CHECK_THAT(says("kind = \"bulk_density\"\nradius_mm = 5\nview = \"side\"\n"), Contains("unknown key"));
    CHECK_THAT(says("kind = \"compression\"\nbody = \"plate\"\narea_mm2 = 1\nheight_mm = 1\n"),
               Contains("does not move"));
    const std::string press = "[[measure]]\nkind = \"compression\"\nbody = \"piston\"\narea_mm2 = 1\nheight_mm = 1\n";
    const std::string byPhase = replaced(withMeasures(press), "-0.01, 0]\n", "-0.01, 0]\nduring = \"settle\"\n");
    CHECK_THAT(read.fault(byPhase),
               Contains("measure[0].body = \"piston\": does not move by time") && Contains("or freely under a force"));
    CHECK_THAT(says("kind = \"shear\"\nbody = \"drum\"\nradius_mm = 5\nfrom_s = 0.1\n"),
               Contains("measure[0].to_s") && Contains("is missing"));
    CHECK_THAT(says("kind = \"shear\"\nbody = \"drum\"\nradius_mm = 5\nfrom_s = [0, 1]\nto_s = [1]\n"),
               Contains("give each window"));
    CHECK_THAT(says("kind = \"shear\"\nbody = \"drum\"\nradius_mm = 5\nfrom_s = 1\nto_s = 0.5\n"),
               Contains("is not later"));
    CHECK_THAT(says("kind = \"shear\"\nbody = \"drum\"\nradius_mm = 5\ninner_radius_mm = 6\nfrom_s = 0\nto_s = 1\n"),
               Contains("inner_radius_mm") && Contains("is no smaller"));
    const std::string sheared = "kind = \"shear\"\nbody = \"drum\"\nradius_mm = 5\nfrom_s = [1, 3]\nto_s = [2, 4]\n";
    CHECK_THAT(says(sheared + "pre_shear_from_s = 0.5\npre_shear_to_s = 0.9\n"),
               Contains("pre_shear_from_s") && Contains("give each point a pre-shear"));
    CHECK_THAT(says(sheared + "pre_shear_from_s = [0.5, 2.5]\n"), Contains("pre_shear_to_s") && Contains("is missing"));
    CHECK_THAT(says(sheared + "pre_shear_from_s = [0.5, 2.5]\npre_shear_to_s = [0.4, 2.9]\n"),
               Contains("is not later than pre_shear_from_s"));
    CHECK_THAT(says("kind = \"shear\"\nbody = \"drum plate\"\nradius_mm = 5\nfrom_s = 0\nto_s = 1\n"),
               Contains("has no axis") && Contains("let the lid turn"));
    for (const std::string kind :
         {"drum_angle\"\nbody = \"drum\"\n", "discharge\"\nregion = \"pan\"\n", "content\"\nregion = \"pan\"\n"}) {
        CHECK_THAT(says("kind = \"" + kind + "from_s = [0.1, 0.2]\n"),
                   Contains("from_s") && Contains("has 2 times, and this measure has one window"));
        CHECK_THAT(says("kind = \"" + kind + "from_s = 0.1\nto_s = [0.2, 0.3]\n"), Contains("to_s"));
    }
    CHECK_THAT(says("kind = \"discharge\"\nregion = \"pam\"\nfrom_s = 0\n"),
               Contains("there is no region \"pam\"") && Contains("did you mean \"pan\""));
    CHECK_THAT(says("kind = \"discharge\"\nregion = \"pan\"\n"), Contains("from_s") && Contains("is missing"));
    CHECK_THAT(says("kind = \"angle_of_repose\"\n[[measure]]\nkind = \"angle_of_repose\"\n"),
               Contains("\"angle_of_repose\" stands there twice"));
    CHECK_THAT(says("kind = \"angle_of_repose\"\nname = \"a b\"\n"), Contains("is no name of a measure"));
    const std::string early = "[[measure]]\nkind = \"angle_of_repose\"\ntime_s = 0.05\n";
    CHECK_THAT(read.fault(withMeasures(early, "")), Contains("keeps none") && Contains("add [frames]"));
    CHECK_THAT(read.fault("gravity = [0, 0, 0]\n" + withMeasures("[[measure]]\nkind = \"angle_of_repose\"\n")),
               Contains("no direction is upright"));
}

TEST_CASE("measures: every shipped element test loads and measures something") {
    int cases = 0;
    for (const auto& entry : std::filesystem::directory_iterator(shippedCase("elements"))) {
        if (entry.path().extension() != ".toml") continue;
        CAPTURE(entry.path().string());
        CHECK_FALSE(loadCase(entry.path()).measures.empty());
        ++cases;
    }
    CHECK(cases == 9);
}
