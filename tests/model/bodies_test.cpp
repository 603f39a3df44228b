// Bodies of a case: every shape and motion from its keys, the resolved case, and faults with their places.

#include <fmt/format.h>

#include "geometry/mesh_writer.h"
#include "geometry/shape.h"
#include "host/core/error.h"
#include "host/model/body_form.h"
#include "tests/model/body_reader.h"
#include "tests/support/catch.h"
#include "tests/support/near.h"

using namespace vkdose;
using namespace vkdose::test;
using Catch::Contains;

TEST_CASE("bodies: every shape comes from its keys, and the resolved case gives the same") {
    Read read;
    read.mesh();
    const std::string text = R"(
[[body]]
name = "floor"
shape = "plane"
at = [0, -0.02, 0]
[[body]]
name = "block"
mesh = "block.stl"
unit = "mm"
contact = "coil"
rotation_axis = [0, 2, 0]
rotation_deg = 90
[[body]]
name = "box"
shape = "box"
size_mm = [100, 200, 300]
inside = true
[[body]]
name = "ball"
shape = "ball"
radius_mm = 5
[[body]]
name = "drum"
shape = "cylinder"
radius_mm = 50
length_mm = 100
ends = true
at = [0, 0, -0.05]
[body.motion]
kind = "turn"
speed_rpm = 60
from_s = 0.5
to_s = 2.0
[[body]]
name = "hopper"
shape = "cone"
radius_mm = 5
end_radius_mm = 50
length_mm = 60
[[body]]
name = "lid"
shape = "disc"
radius_mm = 30
hole_radius_mm = 5
[[body]]
name = "gutter"
shape = "trough"
width_mm = 120
[[body]]
name = "wire"
shape = "wire"
radius_mm = 8
pitch_mm = 5
wire_diameter_mm = 1
length_mm = 20
hand = "left"
[[body]]
name = "screw"
shape = "screw"
radius_mm = 9
shaft_radius_mm = 3
thickness_mm = 1
pitch_mm = 8
pitch_end_mm = 12
length_mm = 40
[body.motion]
kind = "swing"
axis = [1, 0, 0]
amplitude_deg = 5
frequency_hz = 2
phase_deg = 90
)";
    const Case c = read.load(text);
    const auto& bodies = c.world.bodies;
    REQUIRE(bodies.size() == 10);
    CHECK(bodies[0].course.start.origin.y == -0.02);
    CHECK(bodies[1].material == kCoilMaterial);
    const auto mesh = std::get<std::shared_ptr<const geometry::MeshSurface>>(bodies[1].shapes.at(0));
    CHECK(mesh->mesh().vertices.size() == 8);
    CHECK(mesh->reach() >= 1.25e-3);
    CHECK(near(bodies[1].pose(0, 0).toWorld(Vec3(0, 0, 1)), Vec3(1, 0, 0), 1, 1e-12));
    CHECK(near(std::get<geometry::Block>(bodies[2].shapes.at(0)).high, Vec3(0.05, 0.1, 0.15), 0.1, 1e-12));
    CHECK(std::get<geometry::Ball>(bodies[3].shapes.at(0)).radius == Approx(5e-3));
    CHECK(bodies[4].shapes.size() == 3);
    CHECK(glm::length(bodies[4].moving(0.4, 0, 0).spin) == 0);
    CHECK(bodies[4].moving(1, 0, 0).spin.z == Approx(2 * kPi));
    CHECK(glm::length(bodies[4].moving(2.5, 0, 0).spin) == 0);
    CHECK(std::get<geometry::Cone>(bodies[5].shapes.at(0)).endRadius == Approx(0.05));
    CHECK(std::get<geometry::Cone>(bodies[6].shapes.at(0)).baseRadius == Approx(5e-3));
    CHECK(std::get<geometry::Trough>(bodies[7].shapes.at(0)).halfWidth == Approx(0.06));
    CHECK(std::get<geometry::Coil>(bodies[8].shapes.at(0)).hand == -1);
    const auto flight = std::get<geometry::Flight>(bodies[9].shapes.at(0));
    CHECK(flight.height(flight.angle) == Approx(0.04));
    CHECK(flight.angle == Approx(2 * kPi * 4));
    CHECK(bodies[9].shapes.size() == 4);  // the blade, the shaft and its ends
    const auto swing = std::get<geometry::Swing>(bodies[9].course.motion);
    CHECK(swing.amplitude == Approx(5 * kPi / 180));

    const Case again = loadResolvedCase(c.resolved, "case.toml");
    CHECK(again.resolved == c.resolved);
    REQUIRE(again.world.bodies.size() == 10);
    CHECK(again.world.bodies[4].moving(1, 0, 0).spin.z == Approx(2 * kPi));
}

TEST_CASE("bodies: a screw and a mesh have the closed form of what they carry") {
    const auto derivedOf = [](const std::string& file, const std::vector<std::string>& overrides = {}) {
        const Case c = loadCase(shippedCase(file), overrides);
        return derive(c, insertParticles(c));
    };
    // By hand: bulk density, pitch, swept section less the spring's own volume over its length; two turns.
    const double spring = 530 * 5e-3 * (kPi * 5.7e-3 * 5.7e-3 - 0.2211e-6 / 35e-3);
    CHECK(derivedOf("devices/mesh-lactose.toml").massPerTurn == Approx(spring).epsilon(0.02));
    CHECK(derivedOf("devices/mesh-lactose.toml").massPerDose == Approx(2 * spring).epsilon(0.02));
    CHECK(derivedOf("devices/mesh-lactose.toml").pushVelocity == Approx(5e-3).epsilon(0.02));
    // Pitch less blade, between shaft and rim; three turns.
    const double screw = 450 * 7e-3 * kPi * (6e-3 * 6e-3 - 2.5e-3 * 2.5e-3);
    CHECK(derivedOf("devices/auger-milk.toml").massPerDose == Approx(3 * screw).epsilon(0.05));
    const auto exact = [](const std::string& hand) {
        const Folder folder;
        const Case c = loadCase(folder.write(
            "case.toml", kGoodCase.substr(0, kGoodCase.find("[coil]")) +
                             "[[body]]\nname = \"screw\"\nshape = \"screw\"\nradius_mm = 6\nshaft_radius_mm = 2.5\n"
                             "thickness_mm = 1\npitch_mm = 8\nlength_mm = 21\nhand = \"" +
                             hand +
                             "\"\n[body.motion]\nkind = \"turn\"\nfollows = \"drive\"\n[settle]\ntime_s = 0.1\n"
                             "[dose]\nrotate_s = 0.3\nspeed_rpm = 60\n"));
        return derive(c, insertParticles(c)).massPerTurn / c.bulkDensity;
    };
    CHECK(exact("left") == Approx(screw / 450).epsilon(0.05));
    CHECK(exact("right") == 0);  // it carries powder to the rear wall
}

TEST_CASE("bodies: one that stands in the fill is refused with what would be right") {
    Read read;
    const std::string ball = "[[body]]\nname = \"pin\"\nshape = \"ball\"\nradius_mm = 2\nat = [0, 0.024, 0]\n";
    CHECK_THAT(read.fault(ball),
               Contains("overlaps body \"pin\"") && Contains("a [particles.region] that is free of it"));
    const Folder folder;
    try {
        loadCase(folder.write("case.toml", kGoodCase + replaced(ball, "0.024, 0]", "0.01, 0.008]")));
        FAIL("not refused");
    } catch (const CaseError& e) {
        CHECK_THAT(e.what(), Contains("particles.drop_mm"));
    }
}

TEST_CASE("bodies: two that coincide where a sphere can be are refused, by name") {
    Read read;
    read.mesh();
    const auto box = [](const char* name, const char* size, const char* at) {
        return fmt::format("[[body]]\nname = \"{}\"\nshape = \"box\"\nsize_mm = [{}]\nat = [{}]\n", name, size, at);
    };
    const std::string floor = "[[body]]\nname = \"floor\"\nshape = \"plane\"\nat = [0, 0.01, 0]\n";
    const std::string block = "[[body]]\nname = \"casting\"\nmesh = \"block.stl\"\nunit = \"mm\"\n";
    const auto sliding = [](const char* velocity) {
        return fmt::format("[body.motion]\nkind = \"slide\"\nvelocity = [{}]\n", velocity);
    };
    struct Refused {
        std::string bodies, first, second;
    };
    for (const Refused& r : {
             // One floor given twice, nearly.
             Refused{floor + replaced(floor, "floor", "again"), "again", "floor"},
             Refused{floor + replaced(replaced(floor, "floor", "again"), "0.01", "0.009995"), "again", "floor"},
             // Two boxes that reach into one another, and their tops in one plane.
             Refused{box("left", "20, 4, 20", "-0.006, 0.01, 0") + box("right", "20, 6, 20", "0.006, 0.009, 0"),
                     "right", "left"},
             // A plate that lies in a floor as if it were a part of it.
             Refused{floor + box("plate", "10, 4, 10", "0, 0.008, 0"), "plate", "floor"},
             // A mesh and a box of the same top.
             Refused{block + box("lump", "10, 4, 10", "0, 0.008, 0"), "lump", "casting"},
         }) {
        CAPTURE(r.bodies);
        CHECK_THAT(read.fault(r.bodies),
                   Contains("body \"" + r.first + "\" coincides with body \"" + r.second + "\"") && Contains("].at") &&
                       Contains("move it by more than a fiftieth"));
    }
    for (const std::string& fine : {
             // A post that stands on the floor, and one that goes through it.
             floor + box("post", "4, 10, 4", "0, 0.015, 0"),
             floor + box("post", "4, 20, 4", "0, 0.01, 0"),
             // A post through a mesh, and a block beside it on the same floor, whose common face no sphere can reach.
             block + box("post", "4, 40, 4", "0, 0, 0"),
             block + box("next", "10, 12, 10", "0.015, 0, 0"),
             // Both sides of one plate, and two floors of which one lies under the other.
             box("plate", "20, 2, 20", "0, 0.01, 0") + floor,
             floor + replaced(replaced(floor, "floor", "under"), "0.01", "0.008"),
             // Bodies that move, apart or as one.
             floor + replaced(floor, "floor", "lift") + sliding("0, -1, 0"),
             floor + sliding("0, -1, 0") + replaced(floor, "floor", "lift") + sliding("0, -1, 0"),
         }) {
        CAPTURE(fine);
        CHECK_NOTHROW(read.load(fine));
    }
    // A wall of a canister.
    const Folder folder;
    const std::string plate = "[[body]]\nname = \"plate\"\nshape = \"plane\"\nat = [0, 0, 0]\nnormal = [0, 0, 1]\n";
    CHECK_THAT(faultOf(folder.write("case.toml", kGoodCase + plate)),
               Contains("body \"plate\" coincides with canister for a sphere at"));
}

TEST_CASE("bodies: a mesh is made for the reach of contacts that hold on beyond touch") {
    Read read;
    read.mesh();
    const std::string block = "[[body]]\nname = \"casting\"\nmesh = \"block.stl\"\nunit = \"mm\"\n";
    std::string text = withBodies(block + "[time]\nstep_s = \"auto\"\nskin_mm = 0.001\n");
    const std::size_t begin = text.find("[contact]"), end = text.find("\n[", begin);
    text.replace(begin, end - begin,
                 "[contact]\nlaw = \"jkr\"\nyoungs_modulus = 1e5\npoisson_ratio = 0.25\nrestitution = 0.6\n"
                 "surface_energy = 0.5\nfriction = 0.5");
    const Case c = loadCase(read.folder.write("case.toml", text));
    const double reach = longestReach(c.world, c.dosingLaw, 1.25e-3);
    CHECK(reach > 2 * c.world.skin);
    const auto mesh = std::get<std::shared_ptr<const geometry::MeshSurface>>(c.world.bodies.at(0).shapes.at(0));
    CHECK(mesh->reach() >= 1.25e-3 + reach);
}

TEST_CASE("bodies: a file of a hundred thousand triangles loads, beside a floor and a box") {
    Read read;
    const geometry::Ball ball{Vec3(0), 20};
    const auto triangles = geometry::tessellated(ball, 0.3, Vec3(-100), Vec3(100));
    REQUIRE(triangles.size() > 100'000);
    read.folder.write("ball.stl", geometry::stlBytes(triangles, "ball", 1));
    const Case c = read.load(
        "[[body]]\nname = \"ball\"\nmesh = \"ball.stl\"\nunit = \"mm\"\n"
        "[[body]]\nname = \"floor\"\nshape = \"plane\"\nat = [0, 0.003, 0]\n"
        "[[body]]\nname = \"box\"\nshape = \"box\"\nsize_mm = [4, 4, 60]\nat = [0.018, 0, 0]\n");
    const auto& mesh = std::get<std::shared_ptr<const geometry::MeshSurface>>(c.world.bodies.at(0).shapes.at(0));
    CHECK(mesh->mesh().triangles.size() == triangles.size());
    CHECK(mesh->mesh().vertices.size() == triangles.size() / 2 + 2);  // Euler, of a closed mesh without holes
}

TEST_CASE("a canister takes more of a powder that does not stick, because its bed is denser") {
    const auto fits = [](double grams, const std::string& adhesion) {
        const Folder folder;
        const std::string text = replaced(replaced(kGoodCase, "mass_g = 0.9", "mass_g = " + std::to_string(grams)),
                                          "kc_over_k = 0.5", adhesion);
        try {
            loadCase(folder.write("case.toml", text));
            return true;
        } catch (const CaseError& e) {
            CHECK_THAT(e.what(), Contains("the fill does not fit"));
            return false;
        }
    };
    // 13.1 cm3, of which spheres of 1427 kg/m3 may fill 0.35 or 0.5.
    CHECK(fits(6.4, "kc_over_k = 0.5"));
    CHECK_FALSE(fits(6.7, "kc_over_k = 0.5"));
    CHECK(fits(9.2, "kc_over_k = 0"));
    CHECK_FALSE(fits(9.5, "kc_over_k = 0"));
}

TEST_CASE("bodies: faults name the key, the value and what would be right") {
    Read read;
    read.mesh();
    const auto body = [](const std::string& keys) { return "[[body]]\nname = \"thing\"\n" + keys; };
    struct Fault {
        std::string keys, said;
    };
    const std::string mesh = "mesh = \"block.stl\"\nunit = \"mm\"\n";
    for (const Fault& f : {
             Fault{"shape = \"blob\"\n", "body[0].shape"},
             Fault{"mesh = \"block.stl\"\n", "body[0].unit: is missing"},
             Fault{"mesh = \"block.stl\"\nunit = \"ft\"\n", "give one of m, cm, mm"},
             Fault{"mesh = \"block.stl\"\nunit = \"m\"\n", "give the unit that it was drawn in (it would be "},
             Fault{"mesh = \"gone.stl\"\nunit = \"mm\"\n", "there is no file"},
             Fault{"shape = \"ball\"\nradius_mm = 0\n", "is zero"},
             Fault{"shape = \"ball\"\nradius_mm = 3\nlength_mm = 3\n", "unknown key"},
             Fault{"shape = \"box\"\nsize_mm = [1, 2, 0]\n", "a side that is not positive"},
             Fault{"shape = \"disc\"\nradius_mm = 3\nhole_radius_mm = 4\n", "give less than radius_mm"},
             Fault{"shape = \"wire\"\nradius_mm = 3\nlength_mm = 9\nwire_diameter_mm = 2\npitch_mm = 1\n",
                   "lets the turns overlap"},
             Fault{"shape = \"screw\"\nradius_mm = 3\nshaft_radius_mm = 4\nlength_mm = 9\nthickness_mm = 1\npitch_mm = "
                   "6\n",
                   "is no larger than the shaft's"},
             Fault{mesh + "rotation_axis = [0, 0, 0]\n", "has no direction"},
             Fault{mesh + "[body.motion]\nkind = \"slide\"\nvelocity = [0, 0, 1]\nfollows = \"drive\"\n",
                   "only a turn can follow the drive"},
             Fault{mesh + "[body.motion]\nkind = \"turn\"\nspeed_rpm = 3\nfrom_s = 2\nto_s = 1\n",
                   "is not later than from_s"},
             Fault{mesh + "at = [0, 0.0135, 0]\n", "overlaps body \"thing\""},
             Fault{mesh + "[[body]]\nname = \"thing\"\nshape = \"plane\"\n", "body[1].name"},
         }) {
        CAPTURE(f.keys);
        CHECK_THAT(read.fault(body(f.keys)), Contains(f.said));
    }
    const std::string coil = "[coil]\nturns = 3\nlength_mm = 20\nwire_diameter_mm = 1\nradius_mm = 5\nspeed_rpm = 9\n";
    const std::string namesake = "[[body]]\nname = \"coil\"\nshape = \"plane\"\nat = [0, -1, 0]\n";
    CHECK(read.fault(namesake) == "no fault");
    CHECK_THAT(read.fault(coil + namesake), Contains("body[0].name = \"coil\": is the name of [coil]"));
    CHECK_THAT(read.fault("[[body]]\nname = \"a b\"\nshape = \"plane\"\n"), Contains("is no name of a body"));
    std::string many;
    for (int i = 0; i < 17; ++i)
        many += "[[body]]\nname = \"b" + std::to_string(i) + "\"\nshape = \"plane\"\nat = [0, -1, 0]\n";
    CHECK_THAT(read.fault(many), Contains("give at most 16"));
    read.folder.write("block.stl", "solid cut\nfacet normal 0 0 1\n");
    CHECK_THAT(read.fault(body(mesh)), Contains("body[0].mesh") && Contains("block.stl:"));
}
