// A run that begins with the powder of another one.

#include "host/sim/state_facts.h"
#include "tests/sim/fake_backend.h"
#include "tests/support/catch.h"

using namespace vkdose;
using namespace vkdose::test;

namespace {

/// Keeps the states of a run as well.
struct StateKeeper : Notebook {
    struct Kept {
        RunCheckpoint state;
        double time = 0;
    };
    std::vector<Kept> settled, ends, checkpoints;
    void onState(KeptState kind, const RunCheckpoint& state, double time) override {
        (kind == KeptState::Settled ? settled : ends).push_back({state, time});
    }
    bool storesStates() const override { return true; }
    void onCheckpoint(const RunCheckpoint& state, double time) override { checkpoints.push_back({state, time}); }
    bool storesCheckpoints() const override { return true; }
};

Case settlingCase() {
    Case c = smallCase();
    c.sensorInterval = 0.01;
    c.checkpoint.wall = 0;
    return c;
}

/// A particle falls out while the powder settles, then one in every dose.
void doseIt(FakeBackend& backend) {
    backend.dosed = [](std::uint64_t step) { return step < 50 ? 0 : 1 + (step > 100 ? (step - 100 + 30) / 70 : 0); };
    backend.torque = [](std::uint64_t step) { return 1e-3 * static_cast<double>(step % 7); };
}

RunResult playFrom(const Case& c, const StateKeeper::Kept& from, FakeBackend& backend, RunObserver& notes) {
    const std::atomic<bool> stop{false};
    Derived derived;
    derived.massPerDose = 2e-3;
    doseIt(backend);
    return runFrom(c, smallFilling(), derived, backend, notes, stop, from.state, from.time);
}

void checkSame(const Dose& a, const Dose& b) {
    CHECK(a.index == b.index);
    CHECK(a.startTime == b.startTime);
    CHECK(a.endTime == b.endTime);
    CHECK(a.mass == b.mass);
    CHECK(a.cumulative == b.cumulative);
    CHECK(a.particles == b.particles);
    CHECK(a.coilTorque == b.coilTorque);
    CHECK(a.closedForm == b.closedForm);
}

}  // namespace

TEST_CASE("from the settled bed of another run the doses are those of that run") {
    FakeBackend first, second;
    StateKeeper source, after;
    doseIt(first);
    const RunResult whole = play(settlingCase(), first, source);
    REQUIRE(source.settled.size() == 1);
    CHECK(source.settled[0].time == 0.1);
    REQUIRE(source.ends.size() == 1);
    CHECK(source.ends[0].time == whole.last.time);

    const RunResult r = playFrom(settlingCase(), source.settled[0], second, after);
    REQUIRE(whole.doses.size() == 3);
    REQUIRE(r.doses.size() == 3);
    for (std::size_t i = 0; i < 3; ++i) checkSame(r.doses[i], whole.doses[i]);
    CHECK(whole.doses[0].mass > 0);
    CHECK(r.dosedWhileSettling == whole.dosedWhileSettling);
    CHECK(r.dosedWhileSettling > 0);
    REQUIRE(r.settling);
    CHECK(r.settling->time == whole.settling->time);
    CHECK(r.settling->spilled == whole.settling->spilled);
    CHECK(second.calls.front().firstStep == 100);
    CHECK(second.calls.front().kc == 7);  // of the doses, from the first step on
    // The bed stands in the first line, and what came before is not told again.
    REQUIRE(after.samples.size() + 10 == source.samples.size() + 1);
    CHECK(after.samples.front().time == 0.1);
    CHECK(after.samples.front().sensors.mass == source.samples[9].sensors.mass);
    CHECK(after.samples.back().time == source.samples.back().time);
    CHECK(after.frames.empty());  // the case asks for none
    CHECK(r.particleSteps > 0);
    CHECK(r.particleSteps < whole.particleSteps);
    // The new run keeps the bed for others.
    REQUIRE(after.settled.size() == 1);
    CHECK(after.settled[0].time == 0.1);
    CHECK(factsOf(after.settled[0].state.run).settled);
}

TEST_CASE("a changed case takes another run's bed") {
    FakeBackend first, second;
    StateKeeper source, after;
    doseIt(first);
    play(settlingCase(), first, source);
    Case c = settlingCase();
    c.dosingLaw.of(ContactClass::ParticleParticle).kc = 9;
    c.schedule.rotateTime = 0.02;
    c.schedule.restTime = 0.01;
    c.schedule.coilSpeed = 8;
    c.schedule.stop.maxDoses = 2;
    c.frames.interval = 0.01;
    const RunResult r = playFrom(c, source.settled.at(0), second, after);
    CHECK(r.doses.size() == 2);
    CHECK(r.doses.at(0).startTime == 0.1);
    CHECK(r.doses.at(1).endTime == 0.16);
    for (const FakeBackend::Call& call : second.calls) CHECK(call.kc == 9);
    CHECK(std::abs(second.calls.front().rate) == 8);
    REQUIRE(after.frames.size() == 7);
    CHECK(after.frames.front().time == 0.1);
    CHECK(after.frames.front().dose == 0);
    SECTION("with another time step the clock stays") {
        c.world.timeStep = 5e-4;
        FakeBackend third;
        Notebook notes;
        const RunResult again = playFrom(c, source.settled.at(0), third, notes);
        CHECK(again.doses.at(0).startTime == 0.1);
        CHECK(again.doses.at(1).endTime == 0.16);
    }
}

TEST_CASE("from the end of another run its doses are over, and the first one begins") {
    FakeBackend first, second;
    StateKeeper source, after;
    doseIt(first);
    const RunResult whole = play(settlingCase(), first, source);
    const RunResult r = playFrom(settlingCase(), source.ends.at(0), second, after);
    CHECK(second.calls.front().firstStep == 310);
    REQUIRE(r.doses.size() == 3);
    CHECK(r.doses[0].index == 1);
    CHECK(r.doses[0].startTime == whole.last.time);
    CHECK(r.dosedWhileSettling == whole.doses.back().cumulative);
    double most = 0;  // of a dose under way, without what the other run dosed
    for (const Progress& p : after.progress) {
        CAPTURE(p.step);
        CHECK(p.doseMass <= (p.dose > 0 ? r.doses.at(p.dose - 1).mass : 0));
        most = std::max(most, p.doseMass);
    }
    CHECK(most == r.doses.back().mass);
    REQUIRE(r.settling);
    CHECK(r.settling->time == whole.last.time);
    CHECK(after.samples.front().phase == Phase::Settle);
    CHECK(after.samples.front().coilTorque == 0);
    CHECK(factsOf(after.settled.at(0).state.run).settled);
}

TEST_CASE("powder that had not settled settles on") {
    Case c = settlingCase();
    c.checkpoint.simulated = 0.001;
    FakeBackend first, second;
    StateKeeper source, after;
    doseIt(first);
    play(c, first, source);
    const auto early = std::find_if(source.checkpoints.begin(), source.checkpoints.end(),
                                    [](const StateKeeper::Kept& k) { return k.time > 0.05; });
    REQUIRE(early != source.checkpoints.end());
    REQUIRE(early->time < 0.1);
    SECTION("for as long as the case says, counted from the beginning of the other run") {
        c.schedule.settleTime = 0.12;
        const RunResult r = playFrom(c, *early, second, after);
        CHECK(r.doses.at(0).startTime == 0.12);
        CHECK(second.calls.front().kc == 3);
        CHECK(after.settled.at(0).time == 0.12);
    }
    SECTION("not at all if that is over") {
        c.schedule.settleTime = 0.02;
        const RunResult r = playFrom(c, *early, second, after);
        CHECK(r.doses.at(0).startTime == early->time);
    }
}

TEST_CASE("a run that took over another's bed goes on from its own checkpoints") {
    FakeBackend first, second;
    StateKeeper source, after;
    doseIt(first);
    play(settlingCase(), first, source);
    Case c = settlingCase();
    c.checkpoint.simulated = 0.001;
    const RunResult whole = playFrom(c, source.settled.at(0), second, after);
    REQUIRE(after.checkpoints.size() > 10);
    for (const StateKeeper::Kept& from : after.checkpoints) {
        FakeBackend third;
        Notebook notes;
        doseIt(third);
        const std::atomic<bool> stop{false};
        Derived derived;
        derived.massPerDose = 2e-3;
        const RunResult r = runFilled(c, smallFilling(), derived, third, notes, stop, &from.state);
        REQUIRE(r.doses.size() == whole.doses.size());
        for (std::size_t i = 0; i < r.doses.size(); ++i) checkSame(r.doses[i], whole.doses[i]);
        CHECK(r.particleSteps == whole.particleSteps);
    }
}

TEST_CASE("another run's powder must be that of the case") {
    FakeBackend first, second;
    StateKeeper source;
    play(settlingCase(), first, source);
    Notebook notes;
    const std::atomic<bool> stop{false};
    const auto& from = source.settled.at(0);
    CHECK_THROWS_AS(runFrom(settlingCase(), smallFilling(11), {}, second, notes, stop, from.state, from.time),
                    RecordError);
}
