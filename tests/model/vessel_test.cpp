// Powder that starts inside a vessel: which sites of the grid it takes, and what a case says of it.

#include <algorithm>
#include <cmath>

#include "host/model/clearance.h"
#include "host/model/free_sites.h"
#include "host/model/overlaps.h"
#include "host/model/refill.h"
#include "tests/model/body_reader.h"
#include "tests/model/case_files.h"
#include "tests/support/catch.h"

using namespace vkdose;
using namespace vkdose::test;
using Catch::Contains;

namespace {

const std::string kUpright = "rotation_axis = [1, 0, 0]\nrotation_deg = -90\n";

/// A ring of powder between two cylinders about y, 40 mm high, and a cone that narrows downwards beside it.
const std::string kVessels =
    "[[body]]\nname = \"outer\"\nshape = \"cylinder\"\nradius_mm = 16\nlength_mm = 40\n" + kUpright +
    "[[body]]\nname = \"inner\"\nshape = \"cylinder\"\nradius_mm = 6\nlength_mm = 44\nends = true\n"
    "at = [0, -0.002, 0]\n" +
    kUpright +
    "[[body]]\nname = \"bottom\"\nshape = \"plane\"\nnormal = [0, 1, 0]\n"
    "[[body]]\nname = \"hopper\"\nshape = \"cone\"\nradius_mm = 4\nend_radius_mm = 20\nlength_mm = 30\nat = [0.1, 0, "
    "0]\n" +
    kUpright;

/// `particles`: lines of [particles].
std::string caseIn(const std::string& particles, double mass) {
    return "boundaries = \"none\"\n[particles]\ndensity = 1500\nmass_g = " + std::to_string(mass) + "\n" + particles +
           "[particles.size]\ndistribution = \"fixed\"\nradius_mm = 1\n[contact]\nk = 1000\nk1_over_k = 0.2\n"
           "kc_over_k = 0\nplasticity_depth = 0.05\ndamping = 0.01\nfriction = 0.5\n[settle]\ntime_s = 0.1\n" +
           kVessels;
}

Case load(const std::string& particles, double mass) {
    return loadText(caseIn(particles, mass));
}

}  // namespace

TEST_CASE("a fill inside a ring takes sites between its walls alone, from below") {
    const Case c = load("inside = \"outer\"\n", 10);
    const Insertion filled = insertParticles(c);
    const Clearance around(c.world);
    double top = 0;
    for (const Vec3& x : filled.particles.position) {
        const double out = std::hypot(x.x, x.z);
        CHECK(out > 7e-3);
        CHECK(out < 15e-3);
        CHECK(x.y > 1e-3);
        CHECK(around.nearest(x, 1e-3).what.empty());
        top = std::max(top, x.y);
    }
    // A cubic grid fills pi/6 of the ring, less what the round walls cost.
    const double solid = double(filled.particles.size()) * 4.0 / 3 * kPi * 1e-9;
    CHECK(solid / (kPi * (16 * 16 - 6 * 6) * 1e-6 * top) > 0.25);
    CHECK(filled.mass == Approx(10e-3).epsilon(1e-3));
    const Case again = loadResolvedCase(c.resolved, "again.toml");
    CHECK(again.resolved == c.resolved);
    CHECK(insertParticles(again).particles.position == filled.particles.position);
}

TEST_CASE("a fill inside a hopper keeps out of the room under it") {
    for (const Vec3& x : insertParticles(load("inside = \"hopper\"\n", 5)).particles.position)
        CHECK(std::hypot(x.x - 0.1, x.z) < (4e-3 + 16e-3 * x.y / 30e-3) - 1e-3);
}

TEST_CASE("a region bounds the vessel") {
    const Case c = load("inside = \"outer\"\n[particles.region]\nlow = [0, 0, -1]\nhigh = [1, 1, 1]\n", 4);
    for (const Vec3& x : insertParticles(c).particles.position) CHECK(x.x > 0);
}

TEST_CASE("a vessel that cannot hold the powder, or is none, is told with a remedy") {
    const auto refused = [](const std::string& text, const auto& said) {
        CAPTURE(text);
        try {
            loadText(text);
            FAIL_CHECK("accepted");
        } catch (const CaseError& e) {
            CHECK_THAT(e.what(), said);
        }
    };
    refused(caseIn("inside = \"outer\"\n", 100),
            Contains("particles.inside") && Contains("clear sites of the grid") && Contains("give at most"));
    refused(caseIn("inside = \"hoper\"\n", 1), Contains("did you mean \"hopper\"?"));
    refused(caseIn("inside = \"\"\n", 1), Contains("names no body"));
    refused(caseIn("inside = \"bottom\"\n", 1), Contains("without an end") && Contains("add [particles.region]"));
    refused(caseIn("inside = \"inner\"\n", 100), Contains("clear sites"));
    const std::string large =
        "[[powder]]\nname = \"large\"\ndensity = 1500\nmass_g = 1\n[powder.size]\n"
        "distribution = \"fixed\"\nradius_mm = 1.1\n[powder.region]\nlow = [0.2, 0, 0]\n"
        "high = [0.3, 0.1, 0.1]\n";
    const std::string refill = "[[refill]]\nname = \"more\"\ntime_s = 0.05\n";
    refused(caseIn("inside = \"outer\"\n", 1) + large + refill + "mass_g = 1\npowder = \"large\"\n",
            Contains("refill[0].powder") && Contains("larger spheres"));
    refused(caseIn("inside = \"outer\"\n", 1) + refill + "mass_g = 100\n",
            Contains("refill[0].mass_g") && Contains("the vessel has"));
}

TEST_CASE("powder that is added to a vessel takes the first sites of its grid that are clear") {
    const Case c = loadText(caseIn("inside = \"outer\"\n", 5) +
                            "[[refill]]\nname = \"more\"\nmass_g = 3\n[[refill]]\nname = \"last\"\nmass_g = 3\n");
    const Insertion filled = insertParticles(c);
    const Clearance around(c.world);
    Particles now = filled.particles;
    for (const std::size_t refill : {0, 1}) {
        const std::vector<Vec3> places = placeRefill(c, filled, refill, now, around);
        Particles added = filled.waiting[refill].particles;
        REQUIRE(places.size() == added.size());
        added.position = places;
        added.status.assign(added.size(), Status::Active);
        for (std::size_t i = 0; i < places.size(); ++i) {
            CHECK(around.nearest(places[i], added.radius[i]).what.empty());
            const double out = std::hypot(places[i].x, places[i].z);
            CHECK((out > 7e-3 && out < 15e-3));
        }
        now.append(added);
        forEachOverlap(now, [](std::size_t, std::size_t, double) { FAIL_CHECK("two spheres overlap"); });
    }
    // It begins as low as there is room: a sphere that was taken away leaves the lowest site.
    Particles gap = filled.particles;
    gap.status[0] = Status::Dosed;
    const Vec3 first = placeRefill(c, filled, 0, gap, around).front();
    CHECK(glm::distance(first, gap.position[0]) < 0.1e-3);
    CHECK(loadResolvedCase(c.resolved, "again.toml").resolved == c.resolved);

    const Case full = loadText(caseIn("inside = \"outer\"\n", 10) + "[[refill]]\nname = \"more\"\nmass_g = 10\n");
    const Insertion both = insertParticles(full);
    CHECK_THROWS_WITH(placeRefill(full, both, 0, both.particles, Clearance(full.world)),
                      Contains("no room") && Contains("\"more\"") && Contains("are clear"));
}

TEST_CASE("a vessel is filled to a height with what its room holds at the bulk density") {
    const auto massOf = [](const std::string& vessel, double height) {
        const Case c =
            loadText("bulk_density = 300\n" + replaced(caseIn("inside = \"" + vessel + "\"\n", 1), "mass_g = 1.000000",
                                                       "fill_height_mm = " + std::to_string(height)));
        REQUIRE(c.derivations.size() == 1);
        CHECK_THAT(c.derivations[0], Contains("fill_height_mm"));
        const Case again = loadResolvedCase(c.resolved, "again.toml");
        CHECK(again.resolved == c.resolved);
        CHECK(again.filling.mass == Approx(c.filling.mass));
        CHECK(insertParticles(again).particles.position == insertParticles(c).particles.position);
        return c.filling.mass;
    };
    for (const double height : {10.0, 20.0, 33.0})
        CHECK(massOf("outer", height) == Approx(300 * kPi * (16 * 16 - 6 * 6) * height * 1e-9).epsilon(0.02));
    // From 4 to 4 + 16/30 h.
    for (const double height : {15.0, 30.0}) {
        const double a = 4, b = 4 + 16 * height / 30;
        CHECK(massOf("hopper", height) ==
              Approx(300 * kPi * height / 3 * (a * a + a * b + b * b) * 1e-9).epsilon(0.03));
    }
}

TEST_CASE("a height that says nothing about a mass is refused") {
    const auto refused = [](const std::string& particles, double mass, const auto& said) {
        try {
            loadText(mass > 0 ? caseIn(particles, mass) : replaced(caseIn(particles, 1), "mass_g = 1.000000\n", ""));
            FAIL_CHECK("accepted");
        } catch (const CaseError& e) {
            CHECK_THAT(e.what(), said);
        }
    };
    const std::string inside = "inside = \"outer\"\n";
    refused(inside + "fill_height_mm = 10\n", 1, Contains("mass_g is given too"));
    refused(inside + "fill_height_mm = 41\n", 0, Contains("reaches over the vessel, which is 40 mm high"));
    refused(inside + "fill_height_mm = 0.5\n", 0, Contains("leaves no room"));
    refused("fill_height_mm = 10\n[particles.region]\nlow = [0, 0, 0]\nhigh = [1, 1, 1]\n", 0,
            Contains("no vessel is given"));
}
