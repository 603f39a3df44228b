// The states that a run keeps, and how it begins: afresh, where a state of its own was kept, or with the powder of
// another run.
#include <cmath>

#include "host/sim/run_loop.h"
#include "host/sim/run_record.h"

namespace vkdose {

namespace {

/// In force when the state was kept.
Vec3 gravityOf(const Record& run) {
    const auto& g = run.get<double>("gravity", 3);
    return {g[0], g[1], g[2]};
}

}  // namespace

void RunLoop::begin() {
    backend_.load(worldNow(), case_.settlingLaw, result_.particles);
    if (timeline_.frameDue(0)) frame();
}

void RunLoop::goOn(const RunCheckpoint& from) {
    restore(from.run);
    backend_.load(worldNow(), dosing_ ? case_.dosingLaw : case_.settlingLaw, result_.particles);
    backend_.restore(from.backend);
    before_ = {step_, result_.particleSteps, result_.wallTime};
    result_.last.free = freePlaces();
    // The adhesion of the doses may be another than that of the run that settled this bed.
    if (!dosing_ && result_.settled) look();
}

void RunLoop::takeOver(const RunCheckpoint& from, double time) {
    const StateFacts facts = factsOf(from.run);
    if (facts.radii != result_.particles.radius) throw RecordError("its particles are not those of the case");
    step_ = static_cast<std::uint64_t>(std::llround(time / case_.world.timeStep));
    gravity_ = gravityOf(from.run);
    backend_.load(worldNow(), facts.dosing ? case_.dosingLaw : case_.settlingLaw, result_.particles);
    Record state = from.backend;
    // The clock of bodies that move counts steps.
    if (state.arrays().contains(kSnapshotSteps)) state.putOne(kSnapshotSteps, step_);
    backend_.restore(state);
    if (facts.step > 0) clocks_.takeOver(from.run, static_cast<double>(step_) / static_cast<double>(facts.step));
    active_ = facts.active;
    // A refill keeps its time, not its step.
    restoreAdded(from.run, facts.step > 0 ? static_cast<double>(step_) / static_cast<double>(facts.step) : 1);
    regions_.restore(from.run);
    if (!powders_.empty()) powders_.look(backend_.particles());
    takeSample(from.run, facts);
    before_.steps = step_;
    const bool settled = facts.settled || step_ >= timeline_.settleSteps();
    if (settled)
        takeSettled(from.run, facts);
    else if (facts.step == step_)  // else its time steps were others
        rest_.restore(from.run);
    if (!settled) changeGravity(case_.settlingGravity());
    observer_.onSample(result_.last);
    if (timeline_.keepsFrames()) frame();
    for (const FieldSample& f : fields_.open(backend_, step_)) observer_.onField(f);
    if (settled) keepState(KeptState::Settled);
}

World RunLoop::worldNow() const {
    World world = case_.world;
    world.gravity = gravity_;
    return world;
}

void RunLoop::changeGravity(const Vec3& to) {
    if (to == gravity_) return;
    if (energy_) energy_->sum.loaded += energyOfGravityChange(case_.world, backend_.particles(), gravity_, to);
    backend_.setGravity(to);
    gravity_ = to;
}

void RunLoop::takeSample(const Record& run, const StateFacts& facts) {
    Sample& s = result_.last;
    get(run, "last", s);
    get(run, "now", now_);
    get(run, "energy", energy_);
    if (facts.sinceSample)
        s.sensors = now_;
    else
        loads_.takeOver(run);
    if (facts.dosing) {  // its drive rests now
        s.sensors.coilTorque = s.coilTorque = s.coilPower = 0;
    }
    s.step = step_;
    s.time = timeline_.time(step_);
    s.phase = Phase::Settle;
    s.dose = 0;
    s.coilAngle = backend_.coilAngle();
    s.energy = energy_;
    s.free = freePlaces();
    s.regions = regions_.samples();
    s.powders = powders_.places();
}

void RunLoop::takeSettled(const Record& run, const StateFacts& facts) {
    timeline_.endSettling(step_);
    if (facts.settled && !facts.dosing) get(run, result_.settling);
    if (result_.settling) {
        result_.settling->step = step_;
    } else {
        const double speed = meanSpeed(result_.last.sensors), fall = rest_.fall().speed;
        result_.settling = Settling{step_, speed < case_.schedule.restSpeedRatio * fall, result_.last.time, speed,
                                    fall,  mass(result_.last.sensors, Region::Dosed)};
    }
    look();
    measureDensity();
}

void RunLoop::keepState(KeptState kind) {
    if (!observer_.storesStates()) return;
    RunCheckpoint state{save(), backend_.snapshot()};
    std::vector<double> sums = state.run.get<double>("sums");
    sums.back() = 0;
    state.run.put("sums", std::move(sums));
    state.run.putOne("steps_of_others", result_.particleSteps);
    observer_.onState(kind, state, timeline_.time(step_));
}

Record RunLoop::save() const {
    Record r;
    r.put("progress", std::vector<std::uint64_t>{step_, active_, dosing_ ? 1U : 0U, gathered_, varied_ ? 1U : 0U});
    r.put("sums", std::vector<double>{impulse_, powerSum_, rate_, result_.dosedWhileSettling, result_.maxOverlapRatio,
                                      result_.maxOverlapTime, result_.particleSteps, result_.wallTime});
    r.putOne("steps_of_others", result_.stepsOfOthers);
    r.put("gravity", std::vector<double>{gravity_.x, gravity_.y, gravity_.z});
    put(r, "now", now_);
    clocks_.save(r);
    loads_.save(r);
    regions_.save(r);
    powders_.save(r);
    put(r, "energy", energy_);
    timeline_.save(r);
    book_.save(r);
    put(r, "doses", result_.doses);
    put(r, "orders", result_.orders);
    put(r, "last", result_.last);
    put(r, result_.settled);
    put(r, result_.settling);
    rest_.save(r);
    r.put("radius", result_.particles.radius);
    saveAdded(r);
    fields_.save(r);
    result_.ledger.save(r);
    judge_.save(r);
    return r;
}

void RunLoop::restore(const Record& r) {
    if (r.get<double>("radius") != result_.particles.radius)
        throw RecordError("its particles are not those of its case: a list that has changed, or another version");
    const auto& progress = r.get<std::uint64_t>("progress", 5);
    step_ = progress[0];
    active_ = progress[1];
    dosing_ = progress[2] != 0;
    gathered_ = progress[3];
    varied_ = progress[4] != 0;
    const auto& sums = r.get<double>("sums", 8);
    clocks_.restore(r);
    loads_.restore(r);
    regions_.restore(r);
    powders_.restore(r);
    impulse_ = sums[0];
    powerSum_ = sums[1];
    rate_ = sums[2];
    result_.dosedWhileSettling = sums[3];
    result_.maxOverlapRatio = sums[4];
    result_.maxOverlapTime = sums[5];
    result_.particleSteps = sums[6];
    result_.wallTime = sums[7];
    result_.stepsOfOthers = r.one<double>("steps_of_others");
    gravity_ = gravityOf(r);
    get(r, "now", now_);
    get(r, "energy", energy_);
    timeline_.restore(r);
    if (!dosing_) timeline_.endSettling(timeline_.settleSteps());  // the doses are those of the case
    book_.restore(r);
    get(r, "doses", result_.doses);
    get(r, "orders", result_.orders);
    get(r, "last", result_.last);
    result_.last.regions = regions_.samples();
    result_.last.powders = powders_.places();
    get(r, result_.particles, result_.settled);
    measureDensity();
    get(r, result_.settling);
    rest_.restore(r);
    fields_.restore(r);
    result_.ledger.restore(r);
    restoreAdded(r);
    judge_.restore(r);
    if (!timeline_.over(step_)) stretch_ = timeline_.at(step_);
}

void RunLoop::checkpoint() {
    if (!observer_.storesCheckpoints()) return;
    checkpointTime_ = timeline_.time(step_);
    const double begun = wallSeconds();
    observer_.onCheckpoint({save(), backend_.snapshot()}, checkpointTime_);
    pace_.stored(begun, wallSeconds());
}

bool RunLoop::checkpointDue() const {
    const CheckpointInterval& every = case_.checkpoint;
    const double time = timeline_.time(step_);
    return pace_.due(wallSeconds()) ||
           (every.simulated > 0 && std::floor(time / every.simulated) > std::floor(checkpointTime_ / every.simulated));
}

}  // namespace vkdose
