// domain.periodic in a case: what it means, and what is refused.

#include <functional>

#include "tests/model/case_files.h"
#include "tests/support/catch.h"

using namespace vkdose;
using namespace vkdose::test;

namespace {

/// A tube along z with a screw of three turns in it; the domain is as long as one.
const std::string kSlice = R"(boundaries = "none"
bulk_density = 800
[particles]
density = 1500
mass_g = 0.5
inside = "tube"
[particles.size]
distribution = "fixed"
radius_mm = 1
[particles.region]
low = [-0.011, -0.011, 0]
high = [0.011, 0.011, 0.02]
[contact]
k = 2000
k1_over_k = 0.2
kc_over_k = 0
plasticity_depth = 0.05
damping = 0.02
friction = 0.5
rolling_friction = 0.2
[[body]]
name = "screw"
shape = "screw"
radius_mm = 10
shaft_radius_mm = 3
thickness_mm = 1
pitch_mm = 20
length_mm = 60
at = [0, 0, -0.02]
[body.motion]
kind = "turn"
axis = [0, 0, 1]
speed_rpm = 30
[[body]]
name = "tube"
shape = "cylinder"
radius_mm = 11
length_mm = 60
at = [0, 0, -0.02]
[settle]
time_s = 1
[domain]
low = [-0.02, -0.02, 0]
high = [0.02, 0.02, 0.02]
periodic = "z"
)";

std::string with(std::string text, const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    if (at == std::string::npos) throw std::logic_error("the case has no " + from);
    return text.replace(at, from.size(), to);
}

void refused(const std::string& text, const std::string& said) {
    CAPTURE(said);
    try {
        loadText(text);
        FAIL_CHECK("accepted");
    } catch (const CaseError& e) {
        CHECK_THAT(e.what(), Catch::Contains(said));
    }
}

}  // namespace

TEST_CASE("period: a case gives the directions") {
    const Case c = loadText(kSlice);
    CHECK(c.world.period == Vec3(0, 0, 0.02));
    CHECK(c.world.repeats());
    const Case again = loadResolvedCase(c.resolved, "again.toml");
    CHECK(again.world.period == c.world.period);
    CHECK(again.resolved == c.resolved);
    CHECK_FALSE(loadText(with(kSlice, "periodic = \"z\"", "")).world.repeats());
    CHECK_FALSE(loadText(with(kSlice, "\"z\"", "\"none\"")).world.repeats());
    const std::string free = with(kSlice.substr(0, kSlice.find("[[body]]")) + kSlice.substr(kSlice.find("[settle]")),
                                  "inside = \"tube\"\n", "");
    CHECK(loadText(with(free, "\"z\"", "\"xz\"")).world.period == Vec3(0.04, 0, 0.02));
    CHECK(loadText(with(free, "\"z\"", "\"y\"")).world.period == Vec3(0, 0.04, 0));
}

TEST_CASE("period: what cannot repeat is refused with its place") {
    refused(with(kSlice, "\"z\"", "\"xyz\""), "domain.periodic");
    refused(with(kSlice, "low = [-0.02, -0.02, 0]\nhigh = [0.02, 0.02, 0.02]\nperiodic", "periodic"), "domain.low");
    SECTION("a screw whose pitch does not fit") {
        refused(with(kSlice, "pitch_mm = 20", "pitch_mm = 19"), "repeats along z, but body \"screw\" does not");
    }
    SECTION("one that ends at the ends") {
        refused(with(with(kSlice, "length_mm = 60", "length_mm = 20"), "at = [0, 0, -0.02]", "at = [0, 0, 0]"),
                "repeats along z, but body \"screw\" does not");
    }
    SECTION("a tube that ends within") {
        refused(with(kSlice, "radius_mm = 11\nlength_mm = 60", "radius_mm = 11\nlength_mm = 30"), "body \"tube\"");
    }
    SECTION("a wall across") {
        refused(kSlice + "[[body]]\nname = \"end\"\nshape = \"plane\"\nnormal = [0, 0, 1]\nat = [0, 0, 0]\n",
                "body \"end\"");
    }
    SECTION("a wall of the list across") {
        refused(with(kSlice, "boundaries = \"none\"", "boundaries = \"list\"") +
                    "[[plane]]\npoint = [0, 0, 0]\nnormal = [0, 0, 1]\n",
                "but a wall does not");
    }
    SECTION("across the direction that the screw does not repeat along") {
        refused(with(with(kSlice, "\"z\"", "\"xz\""), "-0.02, -0.02, 0]\nhigh = [0.02,",
                     "-0.011, -0.02, 0]\nhigh = [0.011,"),
                "repeats along x, but body");
    }
    SECTION("too short a domain") {
        refused(
            with(with(with(with(kSlice, "0.02, 0.02, 0.02]", "0.02, 0.02, 0.004]"), "pitch_mm = 20", "pitch_mm = 4"),
                      "0.011, 0.02]", "0.011, 0.004]"),
                 "mass_g = 0.5", "mass_g = 0.05"),
            "would meet another one and its image");
    }
    SECTION("a canister") {
        refused(kGoodCase + "[domain]\nlow = [-0.1, -0.1, -0.1]\nhigh = [0.1, 0.2, 0.1]\nperiodic = \"z\"\n",
                "has no use with a canister");
    }
    SECTION("a body that goes away") {
        refused(kSlice +
                    "[[body]]\nname = \"plug\"\nshape = \"ball\"\nradius_mm = 1\nat = [0, 0.015, 0.01]\n"
                    "[body.motion]\nkind = \"slide\"\nvelocity = [0, 0, 0.01]\n",
                "moves along z");
        refused(kSlice +
                    "[[body]]\nname = \"plug\"\nshape = \"ball\"\nradius_mm = 1\nat = [0, 0.015, 0.01]\n"
                    "[body.motion]\nkind = \"free\"\nmass_g = 1\n",
                "moves along z");
    }
    SECTION("a body that swings into an end") {
        refused(kSlice +
                    "[[body]]\nname = \"plug\"\nshape = \"ball\"\nradius_mm = 1\nat = [0, 0.015, 0.01]\n"
                    "[body.motion]\nkind = \"shake\"\naxis = [0, 0, 1]\namplitude_mm = 9\nfrequency_hz = 5\n",
                "body \"plug\" does not");
    }
    SECTION("listed particles that overlap across an end") {
        const std::size_t mass = kSlice.find("mass_g"), contact = kSlice.find("[contact]");
        const std::string listed = kSlice.substr(0, mass) + "list = \"spheres.csv\"\n" + kSlice.substr(contact);
        const Folder folder;
        folder.write("spheres.csv", "x,y,z,r\n0,0.0065,0.0003,0.001\n0,0.0065,0.0190,0.001\n");
        CHECK_THAT(faultOf(folder.write("slice.toml", listed)), Catch::Contains("overlaps particle 1 by 0.7"));
    }
}

TEST_CASE("period: what stays away from the ends, and moves across, is accepted") {
    CHECK_NOTHROW(loadText(kSlice +
                           "[[body]]\nname = \"plug\"\nshape = \"ball\"\nradius_mm = 1\nat = [0, 0.015, 0.01]\n"
                           "[body.motion]\nkind = \"shake\"\naxis = [0, 0, 1]\namplitude_mm = 2\nfrequency_hz = 5\n"));
    CHECK_NOTHROW(loadText(kSlice +
                           "[[body]]\nname = \"plug\"\nshape = \"ball\"\nradius_mm = 1\nat = [0, 0.015, 0.01]\n"
                           "[body.motion]\nkind = \"free\"\nmass_g = 1\nalong = [0, 1, 0]\n"));
    // A belt is always where it was, if it runs within its plane.
    const std::string belt = kSlice +
                             "[[body]]\nname = \"belt\"\nshape = \"plane\"\nat = [0, -0.015, 0]\n"
                             "[body.motion]\nkind = \"slide\"\n";
    CHECK_NOTHROW(loadText(belt + "velocity = [0, 0, 0.01]\n"));
    CHECK_THROWS_WITH(loadText(belt + "velocity = [0, 0.01, 0.01]\n"), Catch::Contains("moves along z"));
}
