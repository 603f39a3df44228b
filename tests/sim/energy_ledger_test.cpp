#include "host/sim/energy_ledger.h"

#include <cmath>

#include "host/backend/reference/reference.h"
#include "tests/sim/fake_backend.h"
#include "tests/support/catch.h"
#include "tests/support/near.h"

using namespace vkdose;
using namespace vkdose::test;

namespace {

/// A book in which every term is another power of two, so that no sum can hide a missing one.
EnergyBook powersOfTwo() {
    EnergyBook b;
    double next = 1;
    for (double EnergyBook::*term :
         {&EnergyBook::kinetic, &EnergyBook::rotational, &EnergyBook::potential, &EnergyBook::elasticNormal,
          &EnergyBook::elasticSliding, &EnergyBook::elasticRolling, &EnergyBook::elasticTorsion, &EnergyBook::plastic,
          &EnergyBook::adhesive, &EnergyBook::viscous, &EnergyBook::sliding, &EnergyBook::rolling, &EnergyBook::torsion,
          &EnergyBook::numerical, &EnergyBook::left, &EnergyBook::coilWork, &EnergyBook::loaded}) {
        b.*term = next;
        next *= 2;
    }
    return b;
}

}  // namespace

TEST_CASE("the energy ledger adds up flows, keeps the last instant, and leaves the rest as its residual") {
    EnergyLedger ledger;
    ledger.add(powersOfTwo());
    CHECK(ledger.present() == 127);         // the seven instantaneous terms
    CHECK(ledger.losses() == 16383 - 127);  // the seven losses
    CHECK(ledger.elastic() == 8 + 16 + 32 + 64);
    CHECK(ledger.residual() == 65536 + 32768 - 16384 - 16383);
    ledger.add(powersOfTwo());
    CHECK(ledger.present() == 127);
    CHECK(ledger.losses() == 2 * (16383 - 127));
    CHECK(ledger.residual() == 2 * (65536 + 32768 - 16384 - (16383 - 127)) - 127);
}

TEST_CASE("a run joins the books of all its calls, and has none unless the backend keeps one") {
    FakeBackend backend;
    Notebook notes;
    play(smallCase(), backend, notes);
    CHECK_FALSE(notes.samples.back().energy);

    FakeBackend booking;
    double work = 0;
    booking.spoil = [&work](std::uint64_t step, Sensors& s) {
        s.energy.emplace();
        s.energy->coilWork = static_cast<double>(step);
        s.energy->potential = static_cast<double>(step);
        work += s.energy->coilWork;
    };
    Notebook booked;
    const RunResult r = play(smallCase(), booking, booked);
    REQUIRE(r.last.energy);
    CHECK(r.last.energy->sum.coilWork == work);
    CHECK(r.last.energy->sum.potential == static_cast<double>(booking.step));
    CHECK(booked.samples.front().energy->sum.coilWork < work);
}

TEST_CASE("the energy of a small dose closes at every line of the time series") {
    const Case c = loadCase(
        VKDOSE_SOURCE_DIR "/cases/mini.toml",
        {"sensors.energy=true", "settle.time_s=0.1", "dose.rotate_s=0.15", "dose.rest_s=0.02", "stop.max_doses=1"});
    auto backend = makeReferenceBackend();
    Notebook notes;
    const std::atomic<bool> stop{false};
    const RunResult r = runCase(c, *backend, notes, stop);
    REQUIRE(r.last.energy);
    const double work = r.last.energy->sum.coilWork;
    CHECK(work > 0.1 * r.last.energy->sum.loaded);
    REQUIRE(notes.samples.size() > 40);
    for (const Sample& s : notes.samples) CHECK(near(s.energy->residual(), 0, work, 1e-9));  // rounding of doubles
    // The aim for the time step's own loss is 1e-3 of the work of a dose at the case's full length; this one is cut.
    CHECK(near(r.last.energy->sum.numerical, 0, work, 5e-3));
    // The drive's mean torque tells the same work, up to the half step at either end.
    double power = 0, before = 0;
    for (const Sample& s : notes.samples) {
        power += s.coilPower * (s.time - before);
        before = s.time;
    }
    CHECK(nearRelative(power, work, 1e-3));
}
