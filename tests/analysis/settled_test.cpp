// Figures of the settled bed, by hand, and their way through a checkpoint.

#include <cmath>

#include "host/analysis/settled_figures.h"
#include "host/core/sphere.h"
#include "host/law/law.h"
#include "tests/analysis/beds.h"
#include "tests/support/catch.h"

using namespace vkdose;
using namespace vkdose::test;

namespace {

/// The paper's stiffnesses.
ContactParameters paperLike() {
    ContactParameters p;
    p.k1 = 4813.4;
    p.k2Max = 24067;
    p.kc = 0.873 * 24067;
    p.plasticityDepth = 0.05;
    return p;
}

Case caseWith(const ContactParameters& dosing) {
    Case c;
    c.world.density() = 1500;
    c.world.gravity = Vec3(0, -10, 0);
    c.dosingLaw.pairs.fill(dosing);
    return c;
}

Contact pairOf(std::uint32_t i, std::uint32_t j, double maxOverlap) {
    Contact c;
    c.particle = i;
    c.other = j;
    c.maxOverlap = maxOverlap;
    return c;
}

}  // namespace

TEST_CASE("settled bed: points of a distribution") {
    const Spread eleven = spreadOf({10, 0, 9, 1, 8, 2, 7, 3, 6, 4, 5});
    CHECK(eleven.low == Approx(1));
    CHECK(eleven.median == Approx(5));
    CHECK(eleven.high == Approx(9));
    const Spread two = spreadOf({3, 1});
    CHECK(two.low == Approx(1.2));
    CHECK(two.median == Approx(2));
    CHECK(two.high == Approx(2.8));
    CHECK(spreadOf({7}).low == 7);
    CHECK(spreadOf({7}).high == 7);
    CHECK(std::isnan(spreadOf({}).median));
}

TEST_CASE("settled bed: pull-off over the lighter's weight, overlaps over the smaller radius, of pairs alone") {
    const ContactParameters p = paperLike();
    Case c = caseWith(p);
    Particles three;
    three.add(Vec3(0), 1e-3);
    three.add(Vec3(2.98e-3, 0, 0), 2e-3);  // 20 um deep
    three.add(Vec3(0, 2.01e-3, 0), 1e-3);  // has just parted
    Contact wall = pairOf(0, 0, 1e-4);
    wall.kind = ContactClass::ParticleWall;
    const SettledBed bed = settledBed(c, 0.5, three, {pairOf(0, 1, 30e-6), wall, pairOf(0, 2, 1e-3)});
    REQUIRE(bed.pullOff.size() == 2);
    const double weight = 1500 * sphereVolume(1e-3) * 10;
    CHECK(bed.pullOff[0] == Approx(pullOff(p, 2 * 1e-3 * 2e-3 / 3e-3, 30e-6) / weight));
    // Beyond the plastic limit delta* the pull grows no more: k_c (k2^ - k1)/(k2^ + k_c) delta*.
    const double limit = 1.25 * 0.05 * 1e-3;
    CHECK(bed.pullOff[1] == Approx(p.kc * (p.k2Max - p.k1) / (p.k2Max + p.kc) * limit / weight).epsilon(1e-4));
    CHECK(bed.overlap[0] == Approx(0.02));
    CHECK(bed.overlap[1] == 0);
    CHECK(bed.largestOverlap[0] == Approx(0.03));
    const SettledFigures f = settledFigures(c, bed);
    CHECK(f.pairs == 2);
    CHECK(f.coordination == Approx(4.0 / 3));
    CHECK(f.overlap.median == Approx(0.01));
    CHECK_FALSE(f.bulk);  // no canister
}

TEST_CASE("settled bed: what a law remembers is told as an overlap") {
    Particles two;
    two.add(Vec3(0), 1e-3);
    two.add(Vec3(1.99e-3, 0, 0), 1e-3);
    const auto largest = [&](const ContactParameters& p) {
        return settledBed(caseWith(p), 0.5, two, {pairOf(0, 1, 30e-6)}).largestOverlap.at(0);
    };
    CHECK(largest(paperLike()) == Approx(0.03));
    ContactParameters own;
    own.law = NormalLaw::User;
    own.reach = 0.2;  // it holds on far beyond touch, and remembers overlaps all the same
    CHECK(largest(own) == Approx(0.03));
}

TEST_CASE("settled bed: the density is that of the bed in its canister") {
    Case c = caseWith(paperLike());
    c.canister = paperCanister();
    c.world.coil = paperCoil();
    const Particles bed = layers(-10e-3, 60e-3);
    const SettledFigures f = settledFigures(c, settledBed(c, 0, bed, {}));
    REQUIRE(f.bulk);
    CHECK(f.bulk->density == bedDensity(c.world, bed, *c.canister, &*c.world.coil)->density);
    CHECK(f.pairs == 0);
    CHECK(std::isnan(f.pullOff.median));
}

TEST_CASE("settled bed: a checkpoint gives it back to the last bit, and an older one without it is no error") {
    const Case c = caseWith(paperLike());
    Particles filled;
    for (int i = 0; i < 5; ++i) filled.add(Vec3(0.7e-3 * i, 1e-9, -0.1), 1e-3 / 3);
    Particles now = filled;
    now.position[2] = Vec3(0.1, 1.0 / 3, 0);
    now.status[4] = Status::Dosed;
    const SettledBed bed = settledBed(c, 1.0 / 7, now, {pairOf(0, 1, 1e-5 / 3), pairOf(1, 2, 0)});
    Record record;
    put(record, std::optional(bed));
    std::optional<SettledBed> back;
    get(record, filled, back);
    REQUIRE(back);
    CHECK(back->time == bed.time);
    CHECK(back->particles.position == now.position);
    CHECK(back->particles.status == now.status);
    CHECK(back->particles.radius == now.radius);
    CHECK(back->pullOff == bed.pullOff);
    CHECK(back->overlap == bed.overlap);
    CHECK(back->largestOverlap == bed.largestOverlap);
    get(Record(), filled, back);
    CHECK_FALSE(back);
    record.put("settled_overlap", std::vector<double>{1});
    CHECK_THROWS_AS(get(record, filled, back), RecordError);
}
