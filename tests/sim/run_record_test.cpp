// The layout of a checkpoint's rows: a checkpoint that was written before must be read as it was meant.
#include "host/sim/run_record.h"

#include "tests/support/catch.h"

using namespace vkdose;
using Counts = std::vector<std::uint64_t>;
using Figures = std::vector<double>;

TEST_CASE("sensors are stored by region, then as their members stand") {
    Sensors s;
    s.count = {1, 2, 3, 4};
    s.mass = {0.1, 0.2, 0.3, 0.4};
    s.kineticEnergy = 5;
    s.rotationalEnergy = 6;
    s.through = {6.1, 6.2, 6.3};
    s.coilTorque = 7;
    s.throatMomentumZ = 8;
    s.maxOverlapRatio = 9;
    s.rebuilds = 10;
    Record record;
    put(record, "now", s);
    CHECK(record.get<std::uint64_t>("now_counts") == Counts{1, 2, 3, 4, 10});
    CHECK(record.get<double>("now_figures") == Figures{0.1, 0.2, 0.3, 0.4, 5, 6, 6.1, 6.2, 6.3, 7, 8, 9});
    Sensors back;
    get(record, "now", back);
    CHECK(back.count == s.count);
    CHECK(back.mass == s.mass);
    CHECK(back.through == s.through);
    CHECK(back.throatMomentumZ == 8);
    CHECK(back.rebuilds == 10);
}

TEST_CASE("an energy book is stored as state, springs, losses, works and momenta") {
    std::optional<EnergyLedger> ledger(EnergyLedger{});
    EnergyBook& b = ledger->sum;
    double next = 1;
    for (double* x : {&b.kinetic, &b.rotational, &b.potential, &b.elasticNormal, &b.elasticSliding, &b.elasticRolling,
                      &b.elasticTorsion, &b.plastic, &b.adhesive, &b.viscous, &b.sliding, &b.rolling, &b.torsion,
                      &b.numerical, &b.coilWork, &b.bodyWork, &b.left, &b.loaded})
        *x = next++;
    b.momentum = Vec3(19, 20, 21);
    b.angularMomentum = Vec3(22, 23, 24);
    Record record;
    put(record, "energy", ledger);
    Figures all(24);
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = double(i + 1);
    CHECK(record.get<double>("energy") == all);
    std::optional<EnergyLedger> back;
    get(record, "energy", back);
    REQUIRE(back);
    CHECK(back->sum.loaded == 18);
    CHECK(back->sum.angularMomentum == Vec3(22, 23, 24));
    put(record, "energy", std::optional<EnergyLedger>());
    get(record, "energy", back);
    CHECK_FALSE(back);
}

TEST_CASE("samples and doses are stored in the order of their columns") {
    Sample s;
    s.step = 1;
    s.time = 2;
    s.phase = Phase::Rest;
    s.dose = 4;
    s.coilAngle = 5;
    s.outletVelocity = 6;
    s.coilTorque = 7;
    s.coilPower = 8;
    Record record;
    put(record, "last", s);
    CHECK(record.get<std::uint64_t>("last_state") == Counts{1, 2, 4});
    CHECK(record.get<double>("last") == Figures{2, 5, 6, 7, 8});
    Sample back;
    get(record, "last", back);
    CHECK(back.phase == Phase::Rest);
    CHECK(back.coilPower == 8);

    Dose d;
    d.index = 1;
    d.startTime = 2;
    d.mass = 3;
    d.particles = 4;
    d.cumulative = 5;
    d.coilTorque = 6;
    d.closedForm = 7;
    d.complete = true;
    d.target = 8;
    d.stopMass = 9;
    d.rotation = 10;
    d.stoppedBy = StopCause::Mass;
    d.endTime = 11;
    put(record, "doses", std::vector<Dose>{d, d});
    CHECK(record.get<std::uint64_t>("doses_counts") == Counts{1, 4, 1, 2, 1, 4, 1, 2});
    CHECK(record.get<double>("doses_figures") == Figures{2, 3, 5, 6, 7, 8, 9, 10, 11, 2, 3, 5, 6, 7, 8, 9, 10, 11});
    std::vector<Dose> doses;
    get(record, "doses", doses);
    REQUIRE(doses.size() == 2);
    CHECK(doses[1].closedForm == 7);
    CHECK(doses[1].complete);
    CHECK(doses[1].stoppedBy == StopCause::Mass);
    CHECK(doses[1].endTime == 11);

    d.bodies = {{Vec3(1, 2, 3), 4, 5, 6}, {Vec3(7, 8, 9), 10, 11, 12}};
    put(record, "loaded", std::vector<Dose>{d, d});
    get(record, "loaded", doses);
    CHECK(numbersOf(doses.at(1).bodies) == Figures{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12});
    record.put("loaded_bodies", Figures(18));  // three bodies for two doses
    CHECK_THROWS_AS(get(record, "loaded", doses), RecordError);
    record.put("doses_figures", Figures(20));  // one figure more in each, as of another vkdose
    CHECK_THROWS_AS(get(record, "doses", doses), RecordError);
}

TEST_CASE("orders are stored with their steps, and a record of a run without any has none") {
    Record record;
    put(record, "orders", std::vector<GivenOrder>{});
    CHECK(record.arrays().empty());
    put(record, "orders", std::vector<GivenOrder>{{40, 0.4, {false, 6.5}}, {90, 0.9, {true, {}}}});
    CHECK(record.get<std::uint64_t>("orders_steps") == Counts{40, 90});
    std::vector<GivenOrder> back;
    get(record, "orders", back);
    REQUIRE(back.size() == 2);
    CHECK(back[0].order.speed == 6.5);
    CHECK_FALSE(back[0].order.stop);
    CHECK(back[1].time == 0.9);
    CHECK(back[1].order.stop);
    CHECK_FALSE(back[1].order.speed.has_value());
    get(Record{}, "orders", back);
    CHECK(back.empty());
}
