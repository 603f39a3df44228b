// Bodies on hinges, as a case gives them.

#include "tests/model/body_reader.h"
#include "tests/support/catch.h"
#include "tests/support/near.h"

using namespace vkdose;
using namespace vkdose::test;
using Catch::Contains;

namespace {

const std::string kFlap =
    "[[body]]\nname = \"flap\"\nshape = \"box\"\nsize_mm = [20, 1, 10]\nat = [0.01, 0.1, 0]\n[body.motion]\n"
    "kind = \"hinge\"\n";
const std::string kHung = kFlap + "axis = [0, 0, 2]\nthrough = [0, 0.1, 0]\ninertia_g_mm2 = 500\n";

const geometry::Hinge& hingeOf(const Case& c) {
    return std::get<geometry::Hinge>(c.world.bodies.at(0).course.motion);
}

}  // namespace

TEST_CASE("hinges: a case gives axis, inertia, weight, torque, damping and stops") {
    Read read;
    const Case plain = read.load(kHung);
    CHECK(plain.world.bodies.at(0).movesFreely());
    CHECK(hingeOf(plain).axis == Vec3(0, 0, 1));
    CHECK(hingeOf(plain).through == Vec3(0, 0.1, 0));
    CHECK(hingeOf(plain).inertia == Approx(5e-7));
    CHECK(hingeOf(plain).mass == 0);
    CHECK(hingeOf(plain).rate == 0);
    CHECK(hingeOf(plain).rows.empty());

    const Case c = read.load(kHung +
                             "mass_g = 5\ncentre = [0.01, 0.1, 0]\nspeed_rpm = 60\ntorque_mNm = -0.5\n"
                             "damping_mNm_s = 0.01\nlowest_deg = -90\nhighest_deg = 0\nfrom_s = 0.25\n");
    const geometry::Hinge& hinge = hingeOf(c);
    CHECK(hinge.mass == Approx(5e-3));
    CHECK(hinge.centre == Vec3(0.01, 0.1, 0));
    CHECK(hinge.rate == Approx(2 * kPi));
    CHECK(c.world.bodies.at(0).driveOf(3) == Approx(-5e-4));
    CHECK(c.world.bodies.at(0).driveOf(0.2) == 0);
    CHECK(hinge.damping == Approx(1e-5));
    CHECK(hinge.low == Approx(-kPi / 2));
    CHECK(hinge.high == 0);
    CHECK(c.world.bodies.at(0).firstFreeStep(1e-3) == 250);
    // Level, its weight turns it down; upright it does not.
    CHECK(near(hinge.weight(Vec3(0, -10, 0)).x, -5e-3 * 10 * 0.01, 1e-4, 1e-9));
    CHECK(near(hinge.weight(Vec3(0, -10, 0)).y, 0, 1e-4, 1e-9));
    const Case again = loadResolvedCase(c.resolved, read.folder.write("again.toml", c.resolved));
    CHECK(hingeOf(again) == hinge);

    read.folder.write("drive.csv", "time_s,torque_mNm\n0,0\n1,4\n");
    const Case driven = read.load(kHung + "file = \"drive.csv\"\nduring = \"rotate\"\n");
    CHECK(driven.world.bodies.at(0).driveOf(9, 0.5) == Approx(2e-3));
    CHECK(driven.world.bodies.at(0).driveOf(9) == 0);
}

TEST_CASE("hinges: what cannot be is told with its key and a remedy") {
    Read read;
    const auto fault = [&](const std::string& more) { return read.fault(kHung + more); };
    CHECK_THAT(read.fault(kFlap), Contains("motion.inertia_g_mm2: is missing"));
    CHECK_THAT(fault("mass_g = 5\n"), Contains("motion.centre: is missing"));
    CHECK_THAT(fault("centre = [0, 0, 0]\n"), Contains("motion.centre") && Contains("is of no mass; add mass_g"));
    CHECK_THAT(fault("lowest_deg = 10\n"), Contains("begins beyond its stops"));
    CHECK_THAT(fault("damping_mNm_s = -1\n"), Contains("motion.damping_mNm_s"));
    CHECK_THAT(fault("follows = \"drive\"\n"), Contains("motion.follows") && Contains("leave it out"));
    CHECK_THAT(fault("during = \"rotate\"\n"), Contains("stands beside neither torque_mNm nor file"));
    CHECK_THAT(fault("force_N = 1\n"), Contains("force_N"));
    for (const char* key : {"to_s = 3\n", "anew = true\n"})
        CHECK_THAT(fault(key), Contains("kind = \"hinge\"") && Contains("from_s says when it is free"));
    read.folder.write("drive.csv", "time_s,force_N\n0,1\n1,2\n");
    CHECK_THAT(fault("file = \"drive.csv\"\n"), Contains("has a column \"force_N\"") && Contains("time_s, torque_mNm"));
    CHECK_THAT(fault("file = \"drive.csv\"\ntorque_mNm = 2\n"), Contains("stands beside file"));
    CHECK_THAT(read.fault("[[body]]\nname = \"lid\"\nshape = \"plane\"\n[body.motion]\nkind = \"hinge\"\n"
                          "inertia_g_mm2 = 1\n"),
               Contains("not for a plane"));
    CHECK_THAT(read.fault(kFlap + "axis = [0, 0, 0]\ninertia_g_mm2 = 1\n"), Contains("motion.axis"));
}
