// What has come into regions and what is in them, against spheres counted by hand.

#include "host/sim/region_book.h"

#include "tests/support/catch.h"

using namespace vkdose;

namespace {

constexpr double kRadius = 1e-3;

/// A cup that turns by a right angle a second about z, and a pan that deletes below.
World cupAndPan() {
    World w;
    w.density() = 1000;
    RigidBody cup;
    cup.name = "cup";
    cup.course.motion = geometry::Turn{Vec3(0, 0, 1), Vec3(0), M_PI / 2};
    w.bodies = {cup};
    const CountRegion inCup{"in-cup", CountRegion::Kind::Box, {}, {}, Vec3(8e-3, -1e-3, -1e-3), Vec3(12e-3, 2e-3, 1e-3),
                            false,    std::size_t{0}};
    const CountRegion pan{"pan", CountRegion::Kind::Beyond, Vec3(0, -20e-3, 0), Vec3(0, -1, 0)};
    w.regions = {inCup, pan};
    return w;
}

/// The first lies in the cup as it starts, the second where it is after a second, the third in the pan.
Particles threeSpheres() {
    Particles p;
    p.add({10e-3, 1e-3, 0}, kRadius, {});
    p.add({-1e-3, 10e-3, 0}, kRadius, {});
    p.add({0, -25e-3, 0}, kRadius, {});
    p.status[2] = Status::Dosed;
    return p;
}

}  // namespace

TEST_CASE("a region that moves with a body tells what is in it, and counts each sphere once") {
    const World w = cupAndPan();
    const Particles p = threeSpheres();
    const double mass = sphereMass(1000, kRadius);
    RegionBook book(w);
    book.look(p, bodyPoses(w, 0, 0));
    CHECK(book.samples()[0].came.particles == 1);
    CHECK(book.samples()[0].content.particles == 1);
    book.openDose();
    book.look(p, bodyPoses(w, 1, 0));
    CHECK(book.samples()[0].came.particles == 2);
    CHECK(book.samples()[0].came.mass == Approx(2 * mass));
    CHECK(book.samples()[0].content.particles == 1);
    CHECK(book.samples()[0].content.mass == Approx(mass));
    CHECK(book.sinceDose()[0].particles == 1);
    // Neither is in it half a turn on. Dosed powder stays in its pan.
    book.look(p, bodyPoses(w, 2, 0));
    CHECK(book.samples()[0].came.particles == 2);
    CHECK(book.samples()[0].content.particles == 0);
    CHECK(book.samples()[1].came.particles == 1);
    CHECK(book.samples()[1].content.particles == 1);
    CHECK(book.sinceDose()[1].particles == 0);
    CHECK(book.samples()[0].most == Approx(mass));  // at any look
}

TEST_CASE("what a vessel held is dosed, and no longer in the vessel") {
    World w = cupAndPan();
    w.regions[0].body.reset();
    w.regions[1].point.y = 0.5e-3;
    w.regions[1].normal.y = 1;
    Particles p = threeSpheres();
    RegionBook book(w);
    book.look(p, {});
    CHECK(book.samples()[0].content.particles == 1);
    p.status[0] = Status::Dosed;
    book.look(p, {});
    CHECK(book.samples()[0].content.particles == 0);
    CHECK(book.samples()[0].came.particles == 1);
    CHECK(book.samples()[1].content.particles == 2);
}

TEST_CASE("the book of regions goes on from a record as if nothing had been") {
    const World w = cupAndPan();
    const Particles p = threeSpheres();
    RegionBook book(w);
    book.look(p, bodyPoses(w, 0, 0));
    book.openDose();
    Record record;
    book.save(record);
    RegionBook again(w);
    again.restore(record);
    CHECK(again.samples()[0].content.particles == 1);
    CHECK(again.samples()[0].most == book.samples()[0].most);
    CHECK(again.samples()[0].most > 0);
    for (RegionBook* b : {&book, &again}) b->look(p, bodyPoses(w, 1, 0));
    for (std::size_t r = 0; r < 2; ++r) {
        CAPTURE(r);
        CHECK(again.samples()[r].came.mass == book.samples()[r].came.mass);
        CHECK(again.samples()[r].came.particles == book.samples()[r].came.particles);
        CHECK(again.samples()[r].content.particles == book.samples()[r].content.particles);
        CHECK(again.sinceDose()[r].particles == book.sinceDose()[r].particles);
    }
    World other = w;
    other.regions.pop_back();
    RegionBook shorter(other);
    CHECK_THROWS_AS(shorter.restore(record), RecordError);
}
