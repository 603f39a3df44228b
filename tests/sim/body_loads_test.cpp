// The loads of bodies over several calls, and what a record holds of them.

#include "host/sim/body_loads.h"
#include "tests/support/catch.h"

using namespace vkdose;

namespace {

constexpr double kStep = 0.5;

std::vector<BodyLoad> call(double force, double torque, double work) {
    std::vector<BodyLoad> loads(2);
    loads[1].force = {force, 0, 0};
    loads[1].torque = torque;
    loads[1].work = work;
    return loads;
}

}  // namespace

TEST_CASE("loads are means over the steps of all calls, and work adds up") {
    BodyLoads loads(2);
    loads.add(call(2, 4, 6), 1, false);
    loads.add(call(8, 1, 3), 2, false);
    const auto sample = loads.take(3, kStep);
    CHECK(sample[1].force.x == Approx((2 + 16) / 3.0));
    CHECK(sample[1].torque == Approx((4 + 2) / 3.0));
    CHECK(sample[1].power == Approx(9 / 1.5));
    CHECK(sample[1].work == Approx(9));
    CHECK(sample[0].work == 0);
    loads.add(call(0, 0, 1), 1, false);
    CHECK(loads.take(1, kStep)[1].work == Approx(10));
}

TEST_CASE("a record gives back the dose under way and the peaks, and must have as many bodies") {
    BodyLoads before(2);
    before.openDose();
    before.add(call(2, 4, 6), 1, true);
    before.take(1, kStep);
    Record record;
    before.save(record);

    BodyLoads now(2);
    now.restore(record);
    CHECK(now.take(1, kStep)[1].work == Approx(6));
    CHECK(now.sinceDose(kStep)[1].force.x == Approx(2));
    CHECK(now.peaks()[1].force == Approx(2));

    BodyLoads fewer(1);
    CHECK_THROWS_AS(fewer.restore(record), RecordError);
}
