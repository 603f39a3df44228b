// The motions of the bodies of a case, and what follows from them.

#include "host/model/body_form.h"
#include "tests/model/body_reader.h"
#include "tests/support/catch.h"
#include "tests/support/near.h"

using namespace vkdose;
using namespace vkdose::test;
using Catch::Contains;

TEST_CASE("bodies: one that follows the drive turns about its axis while powder is dosed, whatever the coil's hand") {
    for (const char* hand : {"right", "left"}) {
        const Folder folder;
        const std::string text =
            replaced(kGoodCase, "speed_rpm = 120.0", "speed_rpm = 120.0\nhand = \"" + std::string(hand) + "\"") +
            "[[body]]\nname = \"agitator\"\nshape = \"ball\"\nradius_mm = 1\nat = [0, 0.2, 0]\n"
            "[body.motion]\nkind = \"turn\"\nfollows = \"drive\"\nturns_per_turn = 0.5\n";
        const Case c = loadCase(folder.write("case.toml", text));
        const double rate = geometry::conveyingRate(*c.world.coil, c.schedule.coilSpeed);
        CAPTURE(hand, rate);
        CHECK(c.world.bodies.at(0).moving(0, 0, rate).spin.z == Approx(0.5 * 120 * 2 * kPi / 60));
    }
    Read read;
    const std::string driven =
        "[[body]]\nname = \"drum\"\nshape = \"cylinder\"\nradius_mm = 50\nlength_mm = 20\n"
        "[body.motion]\nkind = \"turn\"\nfollows = \"drive\"\n[stop]\nmax_doses = 1\n";
    CHECK(read.load(driven + "[dose]\nrotate_s = 1\nspeed_rpm = 30\n").schedule.coilSpeed == Approx(kPi));
    CHECK_THAT(read.fault(driven + "[dose]\nrotate_s = 1\n"), Contains("dose.speed_rpm: is missing"));
    CHECK_THAT(read.fault("[dose]\nrotate_s = 1\nspeed_rpm = 30\n[stop]\nmax_doses = 1\n"),
               Contains("follows = \"drive\""));
    CHECK_THAT(read.fault("[dose]\nspeed_rpm = 30\n"),
               Contains("dose.speed_rpm = 30: has no use, because no body follows the drive"));
    const Folder folder;
    const std::string both = replaced(kGoodCase, "rotate_s = 0.3", "rotate_s = 0.3\nspeed_rpm = 30");
    CHECK_THAT(faultOf(folder.write("case.toml", both)), Contains("dose.speed_rpm = 30: has no use beside a coil"));
}

TEST_CASE("bodies: one that moves with another has its motion, from a place of its own") {
    Read read;
    const std::string lead = "[[body]]\nname = \"front\"\nshape = \"box\"\nsize_mm = [1, 2, 3]\nat = [0, 0, 0.01]\n";
    const std::string rear = "[[body]]\nname = \"rear\"\nshape = \"box\"\nsize_mm = [1, 2, 3]\nat = [0, 0, -0.01]\n";
    const std::string with = rear + "moves_with = \"front\"\n";
    for (const char* motion :
         {"kind = \"turn\"\naxis = [0, 1, 0]\nthrough = [0.1, 0, 0]\nspeed_rpm = 60\n",
          "kind = \"shake\"\naxis = [0, 0, 1]\namplitude_mm = 3\nfrequency_hz = 2\nphase_deg = -90\nfrom_s = 0.1\n",
          "kind = \"swing\"\namplitude_deg = 20\nfrequency_hz = 2\nduring = \"settle\"\n"}) {
        const std::string moves = std::string("[body.motion]\n") + motion;
        const Case c = read.load(lead + moves + with), apart = read.load(lead + moves + rear + moves);
        const RigidBody &body = c.world.bodies.at(1), &own = apart.world.bodies.at(1);
        CHECK(body.movesAs(c.world.bodies.at(0)));
        CHECK(body.clock == own.clock);
        CHECK(body.phases == own.phases);
        for (const double t : {0.0, 0.07, 0.4}) {
            CHECK(body.pose(t, 0, t).origin == own.pose(t, 0, t).origin);
            CHECK(body.moving(t, 0, 0, t).velocity == own.moving(t, 0, 0, t).velocity);
        }
        CHECK(loadResolvedCase(c.resolved, "again.toml").resolved == c.resolved);
    }
    const std::string turn = "[body.motion]\nkind = \"turn\"\nspeed_rpm = 60\n";
    CHECK_THAT(read.fault(lead + turn + with + turn), Contains("body[1].moves_with") && Contains("another motion"));
    CHECK_THAT(read.fault(lead + turn + rear + "moves_with = \"fron\"\n"), Contains("did you mean \"front\"?"));
    CHECK_THAT(read.fault(with + lead + turn), Contains("body[0].moves_with"));  // it comes later
    CHECK_THAT(read.fault(lead + "[body.motion]\nkind = \"free\"\nmass_g = 1\n" + with),
               Contains("moves it alone") || Contains("forces move"));
}

TEST_CASE("bodies: the form tells which way a turning body conveys, and how far") {
    Read read;
    const auto formOf = [&](const std::string& shape) {
        const RigidBody body = read.load("[[body]]\nname = \"it\"\n" + shape).world.bodies.at(0);
        return trianglesOf(body);
    };
    const Vec3 z(0, 0, 1), origin(0);
    for (const auto& [hand, sign] : {std::pair("right", -1.0), std::pair("left", 1.0)}) {
        const std::string turned = std::string("hand = \"") + hand + "\"\n";
        const auto screw = formOf(
            "shape = \"screw\"\nradius_mm = 6\nshaft_radius_mm = 2.5\nthickness_mm = 1\n"
            "pitch_mm = 8\nlength_mm = 40\n" +
            turned);
        CHECK(advancePerTurn(screw, z, origin) == Approx(sign * 8e-3).epsilon(0.03));
        CHECK(advancePerTurn(screw, -z, origin) == Approx(sign * 8e-3).epsilon(0.03));
        const auto wire =
            formOf("shape = \"wire\"\nradius_mm = 6\nwire_diameter_mm = 1\npitch_mm = 5\nlength_mm = 20\n" + turned);
        CHECK(advancePerTurn(wire, z, origin) == Approx(sign * 5e-3).epsilon(0.03));
        CHECK(reachOf(wire, z, origin).radius == Approx(6.5e-3).epsilon(0.01));
    }
    // A paddle, and a rod that turns within itself.
    CHECK(advancePerTurn(formOf("shape = \"box\"\nsize_mm = [10, 1, 30]\n"), z, origin) == Approx(0).margin(1e-9));
    CHECK(advancePerTurn(formOf("shape = \"cylinder\"\nradius_mm = 3\nlength_mm = 9\nends = true\n"), z, origin) ==
          Approx(0).margin(1e-9));
    CHECK(highestOfTurn(formOf("shape = \"ball\"\nradius_mm = 1\nat = [0.003, -0.004, 0.01]\n"), z, Vec3(0, 0.01, 0)) ==
          Approx(0.01 + std::hypot(3e-3, 14e-3) + 1e-3).epsilon(0.01));
    CHECK(trianglesOf(read.load("[[body]]\nname = \"p\"\nshape = \"plane\"\n").world.bodies.at(0)).empty());
}

TEST_CASE("bodies: the fill of a canister starts above what the drive turns") {
    const Folder folder;
    const std::string coilless = kGoodCase.substr(0, kGoodCase.find("[coil]"));
    const auto load = [&](const std::string& radius) {
        return loadCase(folder.write("case.toml",
                                     coilless + "[[body]]\nname = \"screw\"\nshape = \"screw\"\nradius_mm = " + radius +
                                         "\nshaft_radius_mm = 2\nthickness_mm = 1\npitch_mm = 7\nlength_mm = 21\nhand "
                                         "= \"left\"\n[body.motion]\n"
                                         "kind = \"turn\"\nfollows = \"drive\"\n[settle]\ntime_s = "
                                         "0.1\n[dose]\nrotate_s = 0.3\nspeed_rpm = 60\n"));
    };
    for (const auto& [text, radius] : {std::pair("6", 6e-3), std::pair("4", 4e-3)}) {
        const Case c = load(text);
        CHECK(c.filling.region.low.y == Approx(radius).epsilon(0.01));
        for (const Vec3& x : insertParticles(c).particles.position) CHECK(x.y > radius);
    }
}

TEST_CASE("bodies: a table of motion comes from its file") {
    Read read;
    read.folder.write("way.csv", "time_s,angle_deg,y\n0,0,0\n1,90,0.01\n2,90,0.03\n");
    const std::string body =
        "[[body]]\nname = \"flap\"\nshape = \"disc\"\nradius_mm = 5\n[body.motion]\n"
        "kind = \"table\"\nfile = \"way.csv\"\n";
    const RigidBody flap = read.load(body).world.bodies.at(0);
    CHECK(near(flap.pose(1.5, 0).origin, Vec3(0, 0.02, 0), 0.01, 1e-12));
    CHECK(near(flap.pose(0.5, 0).directionToWorld(Vec3(1, 0, 0)), Vec3(std::sqrt(0.5), std::sqrt(0.5), 0), 1, 1e-12));
    read.folder.write("way.csv", "time_s,angle\n0,0\n1,1\n");
    CHECK_THAT(read.fault(body), Contains("has a column \"angle\"") && Contains("time_s, angle_deg, x, y, z"));
    read.folder.write("way.csv", "time_s\n0\n1\n");
    CHECK_THAT(read.fault(body),
               Contains("has no column but the time") && Contains("name the columns time_s, angle_deg"));
    read.folder.write("way.csv", "time_s,angle_deg\n1,0\n1,1\n");
    CHECK_THAT(read.fault(body), Contains("row 2 of the table is not later"));
    CHECK_THAT(read.fault(replaced(body, "way.csv", "gone.csv")), Contains("there is no file"));
}

TEST_CASE("bodies: a motion goes on in the phases that it names") {
    Read read;
    read.folder.write("way.csv", "time_s,angle_deg\n0,0\n1,90\n2,360\n");
    const std::string ball = "[[body]]\nname = \"thing\"\nshape = \"ball\"\nradius_mm = 1\n[body.motion]\n";
    const std::string turn = ball + "kind = \"turn\"\nspeed_rpm = 60\n",
                      table = ball + "kind = \"table\"\nfile = \"way.csv\"\n";
    const Case c = read.load(turn + "during = \"rest rotate\"\n");
    const RigidBody& body = c.world.bodies.at(0);
    CHECK(body.clock == Clock::Phases);
    CHECK(body.phases == std::vector{Phase::Rest, Phase::Rotate});
    // A quarter of a second on its own clock, whatever the time.
    CHECK(near(body.pose(7, 3, 0.25).directionToWorld(Vec3(1, 0, 0)), Vec3(0, 1, 0), 1, 1e-12));
    CHECK(body.moving(7, 3, 1, 0.25).spin.z == Approx(2 * kPi));
    CHECK(glm::length(body.moving(7, 3, 1).spin) == 0);
    const Case again = loadResolvedCase(c.resolved, "case.toml");
    CHECK(again.resolved == c.resolved);
    CHECK(again.world.bodies.at(0).phases == body.phases);

    CHECK_FALSE(read.load(table + "during = \"rotate\"\n").world.bodies.at(0).anew);
    CHECK(read.load(table + "during = \"rotate\"\nanew = true\n").world.bodies.at(0).anew);
    read.folder.write("open.csv", "time_s,angle_deg\n0,0\n1,90\n");
    CHECK_THAT(read.fault(replaced(table, "way.csv", "open.csv") + "during = \"rotate\"\nanew = true\n"),
               Contains("body[0].motion.anew") && Contains("ends in another place than it begins"));

    CHECK_THAT(read.fault(turn + "during = \"rotat\"\n"), Contains("case.toml:") &&
                                                              Contains("body[0].motion.during = \"rotat\"") &&
                                                              Contains("did you mean \"rotate\"?"));
    CHECK_THAT(read.fault(turn + "during = \"dosing\"\n"),
               Contains("there is no phase \"dosing\"") && Contains("settle, rotate, reverse, rest"));
    CHECK_THAT(read.fault(turn + "during = \"\"\n"), Contains("names no phase"));
    CHECK_THAT(read.fault(turn + "during = [\"rotate\"]\n"), Contains("not a string"));
    CHECK_THAT(read.fault(turn + "during = \"rest rest\"\n"), Contains("names rest twice"));
    CHECK_THAT(read.fault(turn + "during = \"rest\"\nfrom_s = 1\n"), Contains("from_s") && Contains("one of the two"));
    CHECK_THAT(read.fault(turn + "during = \"rest\"\nanew = true\n"), Contains("unknown key"));
    CHECK_THAT(read.fault(table + "anew = true\n"), Contains("goes with during"));
    CHECK_THAT(read.fault(ball + "kind = \"turn\"\nfollows = \"drive\"\nduring = \"rest\"\n"),
               Contains("does not go with follows = \"drive\""));
}
