// The warnings of bodies: each slip has its own, and what is right has none.
#include <algorithm>
#include <filesystem>

#include "geometry/mesh_writer.h"
#include "geometry/shape.h"
#include "tests/advice/slips.h"
#include "tests/advice/warnings.h"
#include "tests/support/catch.h"
#include "tests/support/drum_case.h"

using namespace vkdose;
using test::shippedCase;

TEST_CASE("each slip with a body has its warning with figures and a cure") {
    const test::Folder folder;
    std::filesystem::copy_file(shippedCase("devices/spring.stl"), folder.path() / "spring.stl");
    const std::string good = test::readText(shippedCase("devices/mesh-lactose.toml"));
    for (const test::BodySlip& slip : test::kBodySlips) {
        CAPTURE(slip.name);
        CHECK(test::warningOf(test::warningsOfText(folder, good), slip.name) == nullptr);
        const std::vector<Warning> found = test::warningsOfText(folder, test::replaced(good, slip.from, slip.to));
        const Warning* warning = test::warningOf(found, slip.name);
        CAPTURE(test::namesOf(found));
        REQUIRE(warning != nullptr);
        for (const std::string& words : slip.says) CHECK_THAT(warning->line(), Catch::Contains(words));
        CHECK_FALSE(warning->cure.empty());
    }
}

TEST_CASE("bodies that move as one, or past one another, do not cross, and the coil is a body too") {
    const test::Folder folder;
    const std::string free = test::replaced(test::kFreeCase, "time_s = 0.01", "time_s = 1");
    const auto warned = [&](const std::string& bodies) {
        folder.write("two.csv", "x,y,z,r\n0.05,0.05,0.05,1e-3\n0.06,0.05,0.05,1e-3\n");
        return test::lineOf(folder, free + bodies, "body-cross");
    };
    const std::string shaft = test::part("shaft", "2, 2, 30", "0, 0, 0") + test::kOwnTurn;
    const auto arm = [](const std::string& speed) {
        return test::part("arm", "20, 1, 1", "0.001, 0, 0.005") +
               "[body.motion]\nkind = \"turn\"\nspeed_rpm = " + speed + "\n";
    };
    CHECK(warned(shaft + arm("60")).empty());
    CHECK_THAT(warned(shaft + arm("61")), Catch::Contains("\"shaft\" turns through body \"arm\""));
    const std::string swing = test::part("swing", "1, 20, 1", "0, 0, 0") +
                              "[body.motion]\nkind = \"swing\"\namplitude_deg = 20\nfrequency_hz = 3\n";
    CHECK(warned(swing + test::part("post", "1, 1, 1", "0.005, 0.009, 0")).empty());
    CHECK_THAT(warned(swing + test::part("post", "1, 1, 1", "0.003, 0.009, 0")),
               Catch::Contains("\"swing\" moves through body \"post\""));
    // A lid that turns in a round cell of its own size touches no wall of it: what remains is the error of facets.
    const std::string cell = "[[body]]\nname = \"cell\"\nshape = \"cylinder\"\nradius_mm = 20\nlength_mm = 30\n";
    const std::string lid =
        "[[body]]\nname = \"lid\"\nshape = \"disc\"\nradius_mm = 20\nat = [0, 0, 0.02]\n" + test::kOwnTurn;
    CHECK(warned(cell + lid).empty());
    CHECK_THAT(warned(cell + test::replaced(lid, "radius_mm = 20", "radius_mm = 21")),
               Catch::Contains("\"lid\" turns through"));

    const std::string mini = test::readText(shippedCase("mini.toml"));
    const auto crosses = [&](const std::string& pin) { return test::lineOf(folder, mini + pin, "body-cross"); };
    CHECK(crosses(test::part("pin", "1, 1, 1", "0, 0, 0.008")).empty());
    CHECK_THAT(crosses(test::part("pin", "1, 1, 1", "0, -0.0055, 0.008")),
               Catch::Contains("\"coil\" turns through body \"pin\""));
}

TEST_CASE("spheres that start inside of a closed mesh are told, unless it holds all of them") {
    const test::Folder folder;
    const geometry::Block block{Vec3(-0.01), Vec3(0.01)};
    folder.write("block.stl", geometry::stlBytes(geometry::tessellated(block, 1, Vec3(-1), Vec3(1)), "block", 1));
    const auto warned = [&](const std::string& spheres) {
        folder.write("two.csv", "x,y,z,r\n" + spheres);
        return test::lineOf(folder,
                            test::kFreeCase + "[[body]]\nname = \"block\"\nmesh = \"block.stl\"\nunit = \"m\"\n",
                            "body-inside");
    };
    CHECK_THAT(warned("0.003,0.001,-0.002,1e-3\n0.02,0,0,1e-3\n"),
               Catch::Contains("1 of 2 spheres start inside of body \"block\"") && Catch::Contains("(3, 1, -2) mm"));
    CHECK(warned("0.003,0.001,-0.002,1e-3\n-0.004,0,0,1e-3\n").empty());  // a vessel
    CHECK(warned("0.03,0.001,-0.002,1e-3\n0.02,0,0.003,1e-3\n").empty());
}

TEST_CASE("a body that is to move in a phase that the run lacks is told, and a table too long to start anew") {
    const test::Folder folder;
    folder.write("way.csv", "time_s,angle_deg\n0,0\n0.02,90\n0.06,0\n");
    const auto warned = [&](const std::string& motion) {
        std::string text = test::kDrum;
        const std::string turn = "kind = \"turn\"\nspeed_rpm = 60\n";
        text.replace(text.find(turn), turn.size(), motion);
        return test::lineOf(folder, text, "body-phases");
    };
    const std::string turn = "kind = \"turn\"\nspeed_rpm = 60\n", table = "kind = \"table\"\nfile = \"way.csv\"\n";
    CHECK_THAT(warned(turn + "during = \"rotate rest\"\n"),
               Catch::Contains("body \"drum\" is to move in the phase rest") && Catch::Contains("dose.rest_s"));
    CHECK_THAT(warned(turn + "during = \"reverse\"\n"), Catch::Contains("dose.reverse_turns"));
    CHECK(warned(turn + "during = \"rotate\"\n").empty());
    CHECK_THAT(warned(table + "during = \"rotate\"\nanew = true\n"),
               Catch::Contains("takes 0.06 s") && Catch::Contains("at most 0.05 s"));
    CHECK(warned(table + "during = \"rotate\"\n").empty());
    CHECK(warned(table + "during = \"settle\"\nanew = true\n").empty());
}

TEST_CASE("two bodies that meet in a seam where powder comes are told, at rest or moving as one") {
    const test::Folder folder;
    folder.write("two.csv", "x,y,z,r\n0.002,0.01,0.001,1e-3\n-0.01,0.01,0,1e-3\n");
    const auto warned = [&](const std::string& bodies) {
        return test::lineOf(folder, test::kFreeCase + bodies, "body-seam");
    };
    const auto box = [](const std::string& name, const std::string& at) {
        return "[[body]]\nname = \"" + name + "\"\nshape = \"box\"\nsize_mm = [10, 4, 10]\nat = [" + at + "]\n";
    };
    CHECK_THAT(warned(box("left", "-0.005, 0, 0") + box("right", "0.005, 0, 0")),
               Catch::Contains("body \"left\" and body \"right\" meet in a seam") &&
                   Catch::Contains("export-body CASE left right"));
    CHECK(warned(box("left", "-0.005, 0, 0") + box("right", "0.005, -0.001, 0.001")).empty());  // a step
    CHECK(warned(box("left", "-0.005, 0, 0") + box("right", "0.0055, 0, 0")).empty());          // a gap
    // A funnel and its spout: the rim is met from within, where the way grows steeper.
    const std::string funnel =
        "[[body]]\nname = \"funnel\"\nshape = \"cone\"\nradius_mm = 4\nend_radius_mm = 12\nlength_mm = 6\n"
        "rotation_axis = [1, 0, 0]\nrotation_deg = -90\n";
    const std::string spout =
        "[[body]]\nname = \"spout\"\nshape = \"cylinder\"\nradius_mm = 4\nlength_mm = 6\n"
        "rotation_axis = [1, 0, 0]\nrotation_deg = 90\n";
    CHECK_THAT(warned(funnel + spout), Catch::Contains("\"funnel\" and body \"spout\" meet in a seam"));
    // A bin on a funnel: within it is a corner, which has two contacts by right; without it no powder comes.
    const std::string bin =
        "[[body]]\nname = \"bin\"\nshape = \"cylinder\"\nradius_mm = 12\nlength_mm = 20\nat = [0, 0.006, 0]\n"
        "rotation_axis = [1, 0, 0]\nrotation_deg = -90\n";
    CHECK(warned(funnel + bin).empty());
    // Under a plate with a slit through which one sees the seam, but too narrow for a sphere, and under a wide one.
    const auto plate = [](const std::string& name, const std::string& x) {
        return "[[body]]\nname = \"" + name + "\"\nshape = \"box\"\nsize_mm = [20, 0.2, 20]\nat = [" + x +
               ", 0.005, 0]\n";
    };
    const std::string below = box("left", "-0.005, 0, 0") + box("right", "0.005, 0, 0");
    CHECK(warned(below + plate("lid-left", "-0.00953") + plate("lid-right", "0.01067")).empty());
    CHECK_THAT(warned(below + plate("lid-left", "-0.01093") + plate("lid-right", "0.01207")),
               Catch::Contains("body \"left\" and body \"right\" meet in a seam"));
    // Bodies that move as one, and two that part.
    const std::string sinks = "[body.motion]\nkind = \"slide\"\nvelocity = [0, -0.1, 0]\n";
    const std::string left = box("left", "-0.005, 0, 0") + sinks, right = box("right", "0.005, 0, 0");
    CHECK_THAT(warned(left + box("again", "-0.005, 0, 0") + sinks),
               Catch::Contains("body \"left\" and body \"again\" coincide: a sphere at"));
    CHECK_THAT(warned(left + right + sinks), Catch::Contains("meet in a seam"));
    CHECK(warned(left + right + test::replaced(sinks, "-0.1", "-0.2")).empty());
}

TEST_CASE("a place in mm is blamed, not the speed that follows from it") {
    const test::Folder folder;
    folder.write("two.csv", "x,y,z,r\n0.002,0.01,0.001,1e-3\n-0.01,0.01,0,1e-3\n");
    const auto names = [&](const std::string& at, const std::string& through) {
        return test::namesOf(test::warningsOfText(folder, test::kFreeCase + test::part("arm", "2, 2, 2", at) +
                                                              test::kOwnTurn + "through = " + through + "\n"));
    };
    const auto has = [](const std::vector<std::string>& all, const char* name) {
        return std::find(all.begin(), all.end(), name) != all.end();
    };
    for (const auto& [at, through] :
         {std::pair("30, 0, 50", "[30, 20, 50]"), std::pair("0.03, 0, 0.05", "[3000, 0, 50]")}) {
        const auto found = names(at, through);
        CAPTURE(at, found);
        CHECK(has(found, "body-place"));
        CHECK_FALSE(has(found, "body-speed"));
    }
    const auto right = names("0.03, 0, 0.05", "[0.03, 0.02, 0.05]");
    CHECK_FALSE(has(right, "body-place"));
    CHECK_FALSE(has(right, "body-speed"));
}

TEST_CASE("a closed body is not thin, unless it holds the powder") {
    const test::Folder folder;
    const geometry::Block block{Vec3(-0.01), Vec3(0.01)};
    const auto triangles = geometry::tessellated(block, 1, Vec3(-1), Vec3(1));
    folder.write("block.stl", geometry::stlBytes(triangles, "block", 1));
    folder.write("open.stl", geometry::stlBytes({triangles.begin(), triangles.end() - 1}, "open", 1));
    const auto warned = [&](const std::string& body, const std::string& spheres = "0.03,0.001,-0.002,1e-3\n") {
        folder.write("two.csv", "x,y,z,r\n" + spheres);
        const std::string text =
            test::replaced(test::kFreeCase, "friction = 0.5\n", "friction = 0.5\nmax_overlap_ratio = 1\n");
        return test::lineOf(folder, text + "[[body]]\nname = \"it\"\n" + body, "body-thin");
    };
    const std::string inside = "0.003,0.001,-0.002,1e-3\n";
    CHECK(warned("mesh = \"block.stl\"\nunit = \"m\"\n").empty());
    CHECK_THAT(warned("mesh = \"block.stl\"\nunit = \"m\"\n", inside), Catch::Contains("the surfaces of body \"it\""));
    CHECK_THAT(warned("mesh = \"open.stl\"\nunit = \"m\"\n"), Catch::Contains("the surfaces of body \"it\""));
    const std::string cylinder = "shape = \"cylinder\"\nradius_mm = 5\nlength_mm = 8\n";
    CHECK(warned(cylinder + "ends = true\n").empty());
    CHECK_FALSE(warned(cylinder + "ends = true\n", "0,0,0.004,1e-3\n").empty());
    CHECK_FALSE(warned(cylinder).empty());
    CHECK_FALSE(warned("shape = \"disc\"\nradius_mm = 5\n").empty());
    CHECK_FALSE(warned("shape = \"cone\"\nradius_mm = 5\nend_radius_mm = 2\nlength_mm = 3\n").empty());
    CHECK(warned("shape = \"box\"\nsize_mm = [5, 5, 5]\n").empty());
}

TEST_CASE("what was mended in a mesh is told, with its number and its places") {
    const test::Folder folder;
    folder.write("two.csv", "x,y,z,r\n0.03,0.001,-0.002,1e-3\n");
    const geometry::Block block{Vec3(-10), Vec3(10)};
    auto triangles = geometry::tessellated(block, 100, Vec3(-100), Vec3(100));
    const auto line = [&] {
        folder.write("block.stl", geometry::stlBytes(triangles, "block", 1));
        return test::lineOf(folder, test::kFreeCase + "[[body]]\nname = \"it\"\nmesh = \"block.stl\"\nunit = \"mm\"\n",
                            "body-mended");
    };
    CHECK(line().empty());
    triangles.push_back(triangles.front());
    triangles.push_back({triangles[0][0], triangles[0][0], triangles[0][1]});
    CHECK_THAT(line(), Catch::Contains("body[0].mesh: ") && Catch::Contains("the mesh of body \"it\" was mended") &&
                           Catch::Contains("1 triangle without area left out (at ") &&
                           Catch::Contains("1 triangle left out that stands there twice (at ") &&
                           Catch::Contains("block.stl: byte ") && Catch::Contains("(body-mended)"));
}

TEST_CASE("a lid that fits its cell, and a piston its die, only touch it") {
    for (const char* file : {"elements/shear.toml", "elements/compression.toml"}) {
        const Case c = loadCase(shippedCase(file));
        CAPTURE(file);
        CHECK(test::warningOf(warningsOf(c, insertParticles(c)), "body-cross") == nullptr);
    }
}
