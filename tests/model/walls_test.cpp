// Walls have names, under which their loads are told.
#include "host/model/wall.h"

#include "host/model/case.h"
#include "tests/model/case_files.h"
#include "tests/support/catch.h"

using namespace vkdose;
using namespace vkdose::test;

namespace {

std::vector<std::string> namesOf(const std::vector<Wall>& walls) {
    std::vector<std::string> names;
    for (const Wall& wall : walls) names.push_back(wall.name);
    return names;
}

}  // namespace

TEST_CASE("walls: those of a canister are called by their place") {
    const Folder folder;
    const auto file = folder.write("case.toml", kGoodCase);
    CHECK(namesOf(loadCase(file).world.walls) == std::vector<std::string>{"trough", "rear", "front"});
    CHECK(namesOf(loadCase(file, {"canister.floor=flat", "canister.lid=true"}).world.walls) ==
          std::vector<std::string>{"left", "right", "floor", "rear", "lid", "front"});
}

TEST_CASE("walls: their loads are told behind those of bodies and coil, if the case asks for them") {
    const Folder folder;
    const auto file = folder.write("case.toml", kGoodCase);
    const Case silent = loadCase(file), telling = loadCase(file, {"sensors.wall_loads=true"});
    CHECK(loadNames(silent.world) == std::vector<std::string>{"coil"});
    CHECK(loadNames(telling.world) == std::vector<std::string>{"coil", "trough", "rear", "front"});
    CHECK(telling.resolved.find("wall_loads = true") != std::string::npos);
}

TEST_CASE("walls: planes and cylinders have their numbers for names, or names of their own") {
    const Folder folder;
    const std::string walls =
        "[[plane]]\npoint = [0, -0.01, 0]\nnormal = [0, 1, 0]\n[[plane]]\nname = \"slope\"\npoint = [0, -0.02, 0]\n"
        "normal = [0, 1, 1]\n[[cylinder]]\nbase = [0, 0, 0]\naxis = [0, 1, 0]\nradius_mm = 9\n";
    folder.write("two.csv", "x,y,z,r\n0,0,0,1e-3\n0.003,0,0,1e-3\n");
    const std::string text = replaced(kFreeCase, "boundaries = \"none\"", "boundaries = \"list\"") + walls;
    const auto file = folder.write("case.toml", text);
    CHECK(namesOf(loadCase(file, {"sensors.wall_loads=true"}).world.walls) ==
          std::vector<std::string>{"plane-0", "slope", "cylinder-0"});
    const auto twice = folder.write("twice.toml", text + "name = \"slope\"\n");  // the cylinder
    CHECK_THROWS_WITH(loadCase(twice), Catch::Contains("stands there twice"));
}

TEST_CASE("walls: a name that a wall shares with a body or the coil is refused if both tell loads") {
    const Folder folder;
    const std::string ball = "[[body]]\nname = \"rear\"\nshape = \"ball\"\nradius_mm = 2\nat = [0, 0, 0.03]\n";
    const auto file = folder.write("case.toml", kGoodCase + ball);
    CHECK_NOTHROW(loadCase(file));
    CHECK_THROWS_WITH(
        loadCase(file, {"sensors.wall_loads=true"}),
        Catch::Contains("a wall and a body are both called \"rear\"") && Catch::Contains("give the body another name"));
    folder.write("two.csv", "x,y,z,r\n0,0,0,1e-3\n0.003,0,0,1e-3\n");
    const auto free = folder.write("free.toml", kFreeCase);
    CHECK_THROWS_WITH(loadCase(free, {"sensors.wall_loads=true"}), Catch::Contains("there are no walls"));
}
