// [[refill]] in a case: the powder that waits, where it is put, and what is refused.

#include "host/model/refill.h"

#include <algorithm>

#include "host/core/error.h"
#include "host/model/overlaps.h"
#include "tests/model/case_files.h"
#include "tests/support/catch.h"

using namespace vkdose;
using namespace vkdose::test;

namespace {

const std::string kFilled = replaced(kFreeCase, "list = \"two.csv\"",
                                     "mass_g = 0.2\n[particles.size]\ndistribution = \"uniform\"\n"
                                     "radius_min_mm = 0.5\nradius_max_mm = 1\n"
                                     "[particles.region]\nlow = [0, 0, 0]\nhigh = [0.01, 0.02, 0.01]");
const std::string kSpoon = "[[refill]]\nname = \"spoon\"\nmass_g = 0.1\ntime_s = 0.5\n";
const std::string kHandful = "[[refill]]\nname = \"handful\"\nmass_g = 0.3\n";

Particles added(const Insertion& filled, std::size_t refill, const std::vector<Vec3>& places) {
    Particles p = filled.waiting[refill].particles;
    p.position = places;
    p.status.assign(p.size(), Status::Active);
    return p;
}

}  // namespace

TEST_CASE("the powder of refills waits behind that of the fill, which it does not change") {
    const Case plain = loadText(kFilled), c = loadText(kFilled + kSpoon + kHandful);
    const Insertion before = insertParticles(plain), filled = insertParticles(c);
    CHECK(filled.particles.radius == before.particles.radius);
    CHECK(filled.particles.position == before.particles.position);
    CHECK(filled.mass == before.mass);
    CHECK(filled.fillHeight == before.fillHeight);
    REQUIRE(filled.waiting.size() == 2);
    const double largest = sphereMass(c.world.density(), 1e-3);
    CHECK(std::abs(filled.waiting[0].mass - 0.1e-3) <= largest / 2);
    CHECK(std::abs(filled.waiting[1].mass - 0.3e-3) <= largest / 2);
    const Particles all = filled.allParticles();
    CHECK(filled.firstOf(0) == filled.particles.size());
    CHECK(filled.firstOf(1) == filled.particles.size() + filled.waiting[0].particles.size());
    CHECK(all.size() == filled.firstOf(1) + filled.waiting[1].particles.size());
    for (std::size_t i = 0; i < all.size(); ++i)
        CHECK(all.status[i] == (i < filled.firstOf(0) ? Status::Active : Status::Waiting));
    CHECK_FALSE(filled.waiting[0].particles.radius[0] == filled.particles.radius[0]);  // draws of its own
    CHECK(loadResolvedCase(c.resolved, "again.toml").resolved == c.resolved);
}

TEST_CASE("a refill stands where the fill stood, or on the powder that is there") {
    const Case c = loadText(kFilled + kSpoon + kHandful);
    const Insertion filled = insertParticles(c);
    const Clearance around(c.world);
    Particles none;
    const std::vector<Vec3> low = placeRefill(c, filled, 0, none, around);
    CHECK(low == filled.waiting[0].particles.position);

    Particles now = filled.particles;
    double top = 0;
    for (std::size_t i = 0; i < now.size(); ++i) top = std::max(top, now.position[i].y + now.radius[i]);
    now.append(added(filled, 0, placeRefill(c, filled, 0, now, around)));
    const std::vector<Vec3> onTop = placeRefill(c, filled, 1, now, around);
    for (const Vec3& x : onTop) CHECK(x.y > top);
    now.append(added(filled, 1, onTop));
    forEachOverlap(now, [](std::size_t i, std::size_t j, double ratio) { FAIL_CHECK(i << " " << j << " " << ratio); });

    // What lies beside the grid, or has been dosed, lifts nothing.
    Particles aside;
    aside.add({0.02, 0.03, 0.005}, 1e-3);
    aside.add({0.005, 0.03, 0.005}, 1e-3);
    aside.status[1] = Status::Dosed;
    CHECK(placeRefill(c, filled, 0, aside, around) == low);
    aside.status[1] = Status::Active;
    const double lowest = placeRefill(c, filled, 0, aside, around)[0].y - low[0].y;
    CHECK(lowest == Approx(0.031));
}

TEST_CASE("a refill without room says what is in its way") {
    const auto refused = [](const Case& c, const std::string& said) {
        const Insertion filled = insertParticles(c);
        const Clearance around(c.world);
        CHECK_THROWS_WITH(placeRefill(c, filled, 0, filled.particles, around),
                          Catch::Contains("refill \"spoon\"") && Catch::Contains(said));
    };
    Case c = loadText(kFilled + kSpoon);
    CHECK_NOTHROW(placeRefill(c, insertParticles(c), 0, insertParticles(c).particles, Clearance(c.world)));
    Case walled = c;
    walled.world.walls.emplace_back(geometry::Plane{{0, insertParticles(c).fillHeight + 1e-4, 0}, {0, -1, 0}});
    refused(walled, "would overlap a wall by");
    Case low = c;
    low.world.domain.high.y = insertParticles(c).fillHeight;
    refused(low, "above the domain");
    Case sink = c;
    CountRegion region;
    region.point = {0, insertParticles(c).fillHeight, 0};
    region.normal = {0, 1, 0};
    sink.world.regions.push_back(region);
    refused(sink, "where powder is dosed");
}

TEST_CASE("a table that adds powder more than once gives as many refills") {
    const std::string inlet = kSpoon + "every_s = 0.25\ntimes = 3\n";
    const Case c = loadText(kFilled + inlet + kHandful);
    REQUIRE(c.refills.size() == 4);
    for (std::size_t k = 0; k < 3; ++k) {
        CHECK(c.refills[k].name == "spoon-" + std::to_string(k + 1));
        CHECK(c.refills[k].table == 0);
        CHECK(c.refills[k].again == (k > 0));
        CHECK(c.refills[k].time.value() == Approx(0.5 + 0.25 * double(k)));
    }
    CHECK(c.refills[3].name == "handful");
    CHECK(c.refills[3].table == 1);
    CHECK(insertParticles(c).waiting.size() == 4);
    CHECK(loadResolvedCase(c.resolved, "again.toml").resolved == c.resolved);

    const std::string region =
        "[[region]]\nname = \"hopper\"\nkind = \"box\"\nlow = [0, 0, 0]\n"
        "high = [0.01, 0.01, 0.01]\ndeletes = false\n";
    const std::string mark = replaced(kSpoon, "time_s = 0.5", "below_g = 0.15\nregion = \"hopper\"\ntimes = 2");
    const Case marked = loadText(kFilled + region + mark);
    REQUIRE(marked.refills.size() == 2);
    CHECK(marked.refills[1].below.value() == Approx(0.15e-3));
    CHECK(marked.refills[1].watched == std::size_t{0});
    CHECK_FALSE(marked.refills[1].time);
    // The domain has room for both portions of an inlet, and for one that waits for a mark.
    const Case twice = loadText(kFilled + replaced(inlet, "times = 3", "times = 2"));
    const double height = insertParticles(twice).waiting[0].height;
    const double one = marked.world.domain.high.y, two = twice.world.domain.high.y;
    CHECK(two - one == Approx(height).epsilon(0.5));
    CHECK(two - one > 0);
}

TEST_CASE("refills that cannot be are refused by name") {
    const auto refused = [](const std::string& text, const std::string& said) {
        CAPTURE(text);
        CHECK_THROWS_WITH(loadText(text), Catch::Contains(said));
    };
    refused(kFilled + kSpoon + kSpoon, "refill[1].name = \"spoon\": stands there twice");
    refused(kFilled + replaced(kSpoon, "\"spoon\"", "\"a spoon\""), "is no name of a refill");
    refused(kFilled + replaced(kSpoon, "0.1", "-1"), "mass_g");
    refused(kFilled + replaced(kSpoon, "0.1", "1e-6"),
            "refill[0].mass_g = 1e-6: is less than half of the first particle");
    refused(kFilled + replaced(kSpoon, "0.1", "1e7"), "refill[0].mass_g = 1e7: takes about");
    refused(replaced(kFilled, "mass_g = 0.2", "mass_g = 1e7") + kSpoon, "particles.mass_g = 1e7: takes about");
    refused(kFilled + kSpoon + "before_dose = 2\n", "give one of the two");
    refused(kFilled + replaced(kSpoon, "time_s = 0.5", "before_dose = 2"), "there are no doses");
    refused(kFreeCase + kSpoon, "the powder is a list");
    refused(replaced(kFilled, "[0, 0, 0]", "[0, 0, -9.81]") + kSpoon,
            "gravity = [0, 0, -9.81]: does not point along -y");
    refused(replaced(kFilled, "[0, 0, 0]", "[0, 9.81, 0]") + kSpoon, "would not fall onto it");
    CHECK_NOTHROW(loadText(replaced(kFilled, "[0, 0, 0]", "[3, -9.3, 0]") + kSpoon));

    const std::string mark = replaced(kSpoon, "time_s = 0.5", "below_g = 0.15");
    refused(kFilled + mark + "time_s = 2\n", "refill[0].below_g = 0.15: time_s is given too");
    refused(kFilled + mark + "region = \"hopper\"\n", "there is no region \"hopper\"");
    refused(kFilled + mark + "every_s = 2\ntimes = 2\n", "counts from time_s, which is missing");
    refused(kFilled + replaced(mark, "0.15", "-1"), "refill[0].below_g = -1");
    const std::string pan = "[[region]]\nname = \"pan\"\nkind = \"beyond\"\npoint = [0, -1, 0]\nnormal = [0, -1, 0]\n";
    refused(kFilled + pan + mark + "region = \"pan\"\n", "takes the powder away");
    refused(kFilled + pan + kSpoon + "region = \"pan\"\n", "is watched for below_g, which is missing");
    refused(kFilled + kSpoon + "every_s = 0.1\n", "does not say how often");
    refused(kFilled + kSpoon + "times = 2\n", "does not say when the others come");
    refused(kFilled + kHandful + "times = 2\n", "does not say when the others come");
    refused(kFilled + mark + "times = 2\n" + replaced(kSpoon, "spoon", "spoon-2"), "stands there twice");
    refused(kFilled + replaced(kSpoon, "spoon", "spoon-2") + mark + "times = 2\n",
            "gives a refill \"spoon-2\", and another has that name");
}
