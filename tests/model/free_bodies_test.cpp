// Bodies that move freely, as a case gives them.

#include "tests/model/body_reader.h"
#include "tests/support/catch.h"
#include "tests/support/near.h"

using namespace vkdose;
using namespace vkdose::test;
using Catch::Contains;

namespace {

const std::string kBall =
    "[[body]]\nname = \"ball\"\nshape = \"ball\"\nradius_mm = 10\nat = [0, 0.1, 0]\n[body.motion]\n";

const geometry::Free& freeOf(const RigidBody& body) {
    return std::get<geometry::Free>(body.course.motion);
}

}  // namespace

TEST_CASE("free bodies: a case gives mass, velocity, line and time") {
    Read read;
    const RigidBody plain = read.load(kBall + "kind = \"free\"\nmass_g = 30.2\n").world.bodies.at(0);
    CHECK(plain.movesFreely());
    CHECK(freeOf(plain).mass == Approx(0.0302));
    CHECK(freeOf(plain).velocity == Vec3(0));
    CHECK_FALSE(freeOf(plain).line.has_value());
    CHECK(plain.kickOf(0, 1e-5) == 0.5e-5);
    CHECK(plain.kickOf(1, 1e-5) == 1e-5);
    CHECK(near(plain.pose(9, 9, Moved(Vec3(0, -0.02, 0))).origin, Vec3(0, 0.08, 0), 0.1, 1e-15));

    const Case guided = read.load(kBall +
                                  "kind = \"free\"\nmass_g = 30.2\nvelocity = [0, -5, 0]\nalong = [0, 2, 0]\n"
                                  "from_s = 0.5\n");
    const RigidBody& body = guided.world.bodies.at(0);
    CHECK(freeOf(body).velocity == Vec3(0, -5, 0));
    CHECK(freeOf(body).line == Vec3(0, 1, 0));
    CHECK(body.firstFreeStep(1e-3) == 500);
    CHECK(body.kickOf(499, 1e-3) == 0);
    CHECK(body.kickOf(500, 1e-3) == 0.5e-3);
    CHECK(body.kickOf(501, 1e-3) == 1e-3);
    // What the resolved case says is the same body.
    const Case again = loadResolvedCase(guided.resolved, read.folder.write("again.toml", guided.resolved));
    CHECK(again.world.bodies.at(0).firstFreeStep(1e-3) == 500);
    CHECK(freeOf(again.world.bodies.at(0)).line == Vec3(0, 1, 0));
}

TEST_CASE("free bodies: a case gives force, turn, damping and stops") {
    Read read;
    read.folder.write("drive.csv", "time_s,force_N,angle_deg\n0,-2,0\n1,-4,90\n");
    const std::string guided = kBall + "kind = \"free\"\nmass_g = 30\nalong = [0, -2, 0]\n";
    const Case c = read.load(guided + "force_N = 3\nlowest_mm = -2\nhighest_mm = 40\ndamping_kg_s = 0.5\n");
    const RigidBody& pressed = c.world.bodies.at(0);
    CHECK(pressed.driveOf(7) == 3);
    CHECK(freeOf(pressed).damping == 0.5);
    CHECK(freeOf(pressed).low == Approx(-2e-3));
    CHECK(freeOf(pressed).high == Approx(40e-3));
    CHECK(glm::length(pressed.moving(7, 0, 0).spin) == 0);
    const Case again = loadResolvedCase(c.resolved, read.folder.write("again.toml", c.resolved));
    CHECK(freeOf(again.world.bodies.at(0)) == freeOf(pressed));

    const Case turned = read.load(guided + "file = \"drive.csv\"\nfrom_s = 2\n");
    const RigidBody& lid = turned.world.bodies.at(0);
    CHECK(lid.driveOf(1) == 0);
    CHECK(lid.driveOf(2.5) == Approx(-3));
    CHECK(near(lid.moving(2.5, 0, 0).spin, Vec3(0, -kPi / 2, 0), 1, 1e-12));
    // About its own place, a quarter of a turn by its end.
    CHECK(near(lid.pose(9, 0).origin, Vec3(0, 0.1, 0), 0.1, 1e-12));
    CHECK(near(lid.pose(9, 0).directionToWorld(Vec3(1, 0, 0)), Vec3(0, 0, 1), 1, 1e-12));
    CHECK(lid.axis() == Vec3(0, -1, 0));
    CHECK(read.load(guided + "file = \"drive.csv\"\nduring = \"rotate\"\n").world.bodies.at(0).driveOf(9, 0.5) ==
          Approx(-3));
    CHECK(read.load(guided + "force_N = 1\nduring = \"rotate\"\n").world.bodies.at(0).driveOf(9) == 0);
}

TEST_CASE("bodies: a ball is as flat as a wall, or counts its radius") {
    Read read;
    const std::string ball = kBall.substr(0, kBall.find("[body.motion]"));
    CHECK(read.load(ball).world.bodies.at(0).curvature == 0);
    CHECK(read.load(ball + "curvature = true\n").world.bodies.at(0).curvature == Approx(10e-3));
    CHECK_THAT(read.fault("[[body]]\nname = \"b\"\nshape = \"box\"\nsize_mm = [1, 1, 1]\ncurvature = true\n"),
               Contains("curvature"));
}

TEST_CASE("free bodies: what cannot be is told with its key and a remedy") {
    Read read;
    const auto fault = [&](const std::string& motion) { return read.fault(kBall + "kind = \"free\"\n" + motion); };
    CHECK_THAT(fault(""), Contains("motion.mass_g: is missing"));
    CHECK_THAT(fault("mass_g = 0\n"), Contains("motion.mass_g") && Contains("0"));
    CHECK_THAT(fault("mass_g = 1\nalong = [0, 0, 0]\n"), Contains("motion.along"));
    CHECK_THAT(fault("mass_g = 1\nalong = [0, 1, 0]\nvelocity = [0, 1, 0.1]\n"),
               Contains("motion.velocity") && Contains("leads off the line of along"));
    CHECK_THAT(fault("mass_g = 1\nfollows = \"drive\"\n"), Contains("motion.follows") && Contains("leave it out"));
    CHECK_THAT(fault("mass_g = 1\nduring = \"rotate\"\n"), Contains("stands beside neither force_N nor file"));
    for (const char* key : {"force_N = 1\n", "file = \"drive.csv\"\n", "lowest_mm = -1\n", "highest_mm = 1\n"})
        CHECK_THAT(fault("mass_g = 1\n" + std::string(key)), Contains("needs a line") && Contains("add along"));
    const std::string guided = "mass_g = 1\nalong = [0, 1, 0]\n";
    CHECK_THAT(fault(guided + "lowest_mm = 1\n"), Contains("begins beyond its stops"));
    CHECK_THAT(fault(guided + "damping_kg_s = -1\n"), Contains("motion.damping_kg_s"));
    read.folder.write("drive.csv", "time_s,force\n0,1\n1,2\n");
    CHECK_THAT(fault(guided + "file = \"drive.csv\"\n"),
               Contains("has a column \"force\"") && Contains("time_s, force_N, angle_deg"));
    read.folder.write("drive.csv", "time_s,force_N\n1,1\n1,2\n");
    CHECK_THAT(fault(guided + "file = \"drive.csv\"\n"), Contains("row 2 of the table is not later"));
    CHECK_THAT(fault(guided + "file = \"drive.csv\"\nforce_N = 2\n"), Contains("stands beside file"));
    for (const char* key : {"to_s = 3\n", "anew = true\n"})
        CHECK_THAT(fault("mass_g = 1\n" + std::string(key)), Contains("from_s says when it is free"));
    CHECK_THAT(fault("mass_g = 1\naxis = [0, 0, 1]\n"), Contains("axis"));
    CHECK_THAT(read.fault("[[body]]\nname = \"lid\"\nshape = \"plane\"\n[body.motion]\nkind = \"free\"\nmass_g = 1\n"),
               Contains("not for a plane"));
    CHECK_THAT(read.fault(kBall + "kind = \"slide\"\nvelocity = [0, 1, 0]\nmass_g = 1\n"), Contains("mass_g"));
    CHECK_THAT(read.fault(kBall + "kind = \"slide\"\n"), Contains("motion.velocity: is missing"));
}
