// Where each of two powders is, and what a dose has of each.
#include "host/sim/powder_book.h"

#include <cmath>

#include "tests/support/catch.h"

using namespace vkdose;

namespace {

World twoPowders() {
    World world;
    world.materials = {{"cocoa", true, 1000}, {"wall", false, 0}, {"coil", false, 0}, {"sugar", true, 2000}};
    world.throatZ = 0.1;
    return world;
}

/// Of either powder one sphere in the canister and one in the throat; one of sugar is lost, and one waits.
Particles sixSpheres() {
    Particles p;
    for (const int material : {0, 3})
        for (const double z : {0.05, 0.12}) p.add(Vec3(0, 0, z), 1e-3, Vec3(0), Vec3(0), material);
    p.add(Vec3(0), 1e-3, Vec3(0), Vec3(0), 3);
    p.status.back() = Status::Lost;
    p.add(Vec3(0), 1e-3, Vec3(0), Vec3(0), 3);
    p.status.back() = Status::Waiting;
    return p;
}

}  // namespace

TEST_CASE("each powder's places have its own mass, and a dose what was dosed since it began") {
    const World world = twoPowders();
    const double sphere = sphereMass(1000, 1e-3);
    PowderBook book(world);
    Particles p = sixSpheres();
    book.look(p);
    REQUIRE(book.places().size() == 2);
    for (const int k : {0, 1}) {
        const PowderPlaces& of = book.places()[std::size_t(k)];
        CHECK(of.canister == Approx((k + 1.0) * sphere));
        CHECK(of.throat == Approx((k + 1.0) * sphere));
        CHECK(of.dosed == 0);
        CHECK(of.canisterCount == 1);
    }
    p.status[1] = Status::Dosed;
    book.look(p);
    book.openDose();
    for (const PowderDose& d : book.sinceDose()) CHECK(std::isnan(d.share));
    p.status[0] = p.status[3] = Status::Dosed;
    book.look(p);
    const std::vector<PowderDose> dose = book.sinceDose();
    CHECK(dose[0].mass == Approx(sphere));
    CHECK(dose[1].mass == Approx(2 * sphere));
    CHECK(dose[1].share == Approx(2.0 / 3));
    CHECK(dose[0].particles == 1);

    Record record;
    book.save(record);
    PowderBook again(world);
    again.restore(record);
    CHECK(again.places()[0].dosed == book.places()[0].dosed);
    CHECK(again.sinceDose()[1].share == dose[1].share);
}

TEST_CASE("one powder is not counted apart") {
    World world = twoPowders();
    world.materials.pop_back();
    PowderBook book(world);
    Particles p;
    p.add(Vec3(0), 1e-3);
    book.look(p);
    CHECK(book.empty());
    CHECK(book.places().empty());
    CHECK(book.sinceDose().empty());
}
