#include "host/sim/run_loop.h"

#include <algorithm>
#include <cmath>

#include "host/sim/density.h"
#include "host/sim/expected_steps.h"

namespace vkdose {

namespace {

std::uint64_t active(const Sensors& s) {
    return s.count[static_cast<std::size_t>(Region::Canister)] + s.count[static_cast<std::size_t>(Region::Throat)];
}

}  // namespace

RunLoop::RunLoop(const Case& c, Insertion filled, Derived derived, Backend& backend, RunObserver& observer,
                 const std::atomic<bool>& stop)
    : case_(c),
      backend_(backend),
      observer_(observer),
      stop_(stop),
      timeline_(c),
      judge_(c.schedule.stop),
      rest_(c, filled.particles),
      book_(c, derived, timeline_.conveyingSense()),
      fields_(c, timeline_) {
    result_.filled = std::move(filled);
    result_.derived = std::move(derived);
    result_.particles = result_.filled.allParticles();
    active_ = result_.filled.particles.size();
    result_.ledger = Ledger(active_, result_.filled.mass);
    result_.last.sensors.count[0] = active_;
    result_.last.sensors.mass[0] = result_.filled.mass;
}

StopReason RunLoop::steps() {
    while (!timeline_.over(step_)) {
        while (observer_.wantsCheckpoint()) {
            addPowder();
            checkpoint();
        }
        addPowder();
        if (stop_) {
            checkpoint();
            sample();
            if (book_.underWay()) closeDose(false);
            keepEndState();
            return StopReason::Interrupted;
        }
        stretch_ = timeline_.at(step_);
        if (stretch_.phase != Phase::Settle && !dosing_) beginDosing();
        if (stretch_.phase == Phase::Rotate && book_.index() != stretch_.dose) openDose();
        advance(timeline_.nextSample(step_));
        bool endsRun = false;
        if (step_ == sampleStep_) {
            sample();
            endsRun = control();
            if (stretch_.phase == Phase::Settle) watchRest();
            if (timeline_.frameDue(step_)) frame();
            for (const FieldSample& f : fields_.look(backend_, step_, stretch_.phase, stretch_.dose))
                observer_.onField(f);
        }
        if (step_ == timeline_.settleSteps()) {
            look();
            measureDensity();
            keepState(KeptState::Settled);
        }
        if (endsRun || (step_ == stretch_.end && phaseEnded())) {
            if (timeline_.keepsFrames() && !timeline_.frameDue(step_)) frame();
            if (endsRun) closeDose(false);
            keepEndState();
            keepState(KeptState::End);
            return endsRun ? StopReason::Torque : judge_.reason();
        }
        if (checkpointDue()) checkpoint();
    }
    // Kept with the dose still under way, so that a run that is reopened goes on with it.
    if (timeline_.hasDoses()) keepState(KeptState::End);  // without doses it is the settled one
    if (book_.underWay()) closeDose(false);
    keepEndState();
    return timeline_.cutByEndTime(step_) ? StopReason::EndTime : StopReason::Settled;
}

void RunLoop::advance(std::uint64_t sampleStep) {
    sampleStep_ = sampleStep;
    const double perCall = backend_.particleStepsPerCall() / static_cast<double>(std::max<std::uint64_t>(active_, 1));
    const auto limit = static_cast<std::uint64_t>(std::clamp(perCall, 64.0, 5e4));
    const std::uint64_t n = std::min({sampleStep_ - step_, stretch_.pieceEnd - step_, limit});
    const auto begin = WallClock::now();
    clocks_.enter(stretch_.phase, stretch_.dose);
    if (clocks_.any()) backend_.setClocks(clocks_.now());
    const Sensors s = backend_.advance(static_cast<std::uint32_t>(n), stretch_.rate);
    result_.wallTime += std::chrono::duration<double>(WallClock::now() - begin).count();
    result_.particleSteps += static_cast<double>(active_) * static_cast<double>(n);
    step_ += n;
    clocks_.count(n);
    active_ = active(s);
    gather(s, n);
    report();
}

void RunLoop::watchRest() {
    const Sensors& s = result_.last.sensors;
    const bool rests = rest_.rests(s, step_);
    if (rests && case_.schedule.untilRest && step_ < timeline_.settleSteps()) {
        timeline_.endSettling(step_);
        stretch_.end = step_;
        report();  // that the phase has ended
    }
    if (step_ != timeline_.settleSteps()) return;
    result_.settling =
        Settling{step_, rests, timeline_.time(step_), meanSpeed(s), rest_.fall().speed, mass(s, Region::Dosed)};
    observer_.onSettled(*result_.settling, case_);
}

void RunLoop::look() {
    const double time = timeline_.time(step_);
    result_.settled = settledBed(case_, time, backend_.particles(), backend_.contacts(),
                                 bodyPoses(case_.world, time, backend_.coilAngle(), moved()));
}

void RunLoop::measureDensity() {
    if (!case_.bulkDensityMeasured || !result_.settled || !result_.settling) return;
    const auto bulk = settledDensity(case_, *result_.settling, result_.settled->particles, result_.settled->bodies);
    if (!bulk) return;
    Case measured = case_;
    measured.bulkDensity = bulk->density;
    result_.derived = derive(measured, result_.filled);
    book_.expect(result_.derived);
}

void RunLoop::frame() {
    if (!observer_.storesFrames()) return;
    observer_.onFrame({step_, timeline_.time(step_), stretch_.phase, stretch_.dose, backend_.coilAngle(),
                       backend_.particles(), backend_.contacts(), moved()});
    if (case_.frames.states && step_ > 0) keepState(KeptState::Frame);
}

std::vector<Moved> RunLoop::moved() const {
    const std::vector<double> times = clocks_.times();
    std::vector<Moved> moved(times.begin(), times.end());
    if (!moveFreely(case_.world.bodies)) return moved;
    const std::vector<FreeBody> free = backend_.freeBodies();
    moved.resize(std::max(moved.size(), free.size()));
    for (std::size_t b = 0; b < free.size(); ++b) moved[b] = Moved(moved[b].time, free[b]);
    return moved;
}

std::vector<FreePlace> RunLoop::freePlaces() const {
    std::vector<FreePlace> places;
    if (!moveFreely(case_.world.bodies)) return places;
    const std::vector<FreeBody> free = backend_.freeBodies();
    for (std::size_t b = 0; b < free.size(); ++b) {
        const RigidBody& body = case_.world.bodies[b];
        if (!body.movesFreely()) continue;
        const Vec3 at = body.pose(0, 0, Moved(0, free[b])).origin;
        const geometry::Hinge* hinge = body.hinge();
        const Vec3 velocity =
            hinge != nullptr ? glm::cross(free[b].rate * hinge->axis, at - hinge->through) : free[b].velocity;
        places.push_back({at, velocity, hinge != nullptr, free[b].angle, free[b].rate});
    }
    return places;
}

void RunLoop::beginDosing() {
    dosing_ = true;
    backend_.setLaw(*stretch_.law);
    changeGravity(stretch_.gravity);
    result_.dosedWhileSettling = mass(result_.last.sensors, Region::Dosed);
}

bool RunLoop::control() {
    if (stretch_.phase != Phase::Rotate || !book_.conveys()) return false;
    DoseBook::Order order = book_.look(result_.last, step_ == stretch_.stop);
    if (!order.stop) obey(order);
    if (order.speed) timeline_.changeSpeed(step_, *order.speed);
    if (!order.stop) return false;
    if (step_ < stretch_.stop) {
        timeline_.stopTurning(step_);
        stretch_ = timeline_.at(step_ - 1);
    }
    return *order.stop == StopCause::Torque && case_.schedule.torqueEndsRun;
}

void RunLoop::obey(DoseBook::Order& order) {
    DriveOrder given = observer_.order();
    if (given.stop) given.speed.reset();
    if (!book_.obey(given, result_.last, order)) return;
    result_.orders.push_back({step_, timeline_.time(step_), given});
    observer_.onOrder(result_.orders.back());
}

void RunLoop::openDose() {
    book_.open(stretch_.dose, timeline_.time(step_), result_.last.sensors);
    regions_.openDose();
    loads_.openDose();
    if (!powders_.empty()) powders_.look(backend_.particles());  // a run from a settled bed has not looked yet
    powders_.openDose();
}

void RunLoop::closeDose(bool complete) {
    result_.doses.push_back(book_.close(complete, result_.last.sensors, timeline_.time(step_)));
    result_.doses.back().regions = regions_.sinceDose();
    result_.doses.back().bodies = loads_.sinceDose(case_.world.timeStep);
    result_.doses.back().powders = powders_.sinceDose();
    observer_.onDose(result_.doses.back());
}

bool RunLoop::phaseEnded() {
    if (!stretch_.closesDose) return false;
    closeDose(true);
    const Dose& d = result_.doses.back();
    return judge_.over(d.mass, d.particles, active_ + planned());
}

void RunLoop::fail(StopReason reason, const std::string& what) {
    result_.reason = reason;
    result_.error = what;
    if (book_.underWay()) closeDose(false);
    try {
        keepEndState();
    } catch (const std::runtime_error&) {
        // The backend cannot give its state any more. `endState` stays false and the first error is the one
        // reported.
    }
}

void RunLoop::keepEndState() {
    result_.particles = backend_.particles();
    result_.bodiesMoved = moved();
    result_.bodyPeaks = loads_.peaks();
    result_.endState = true;
}

void RunLoop::report() {
    Progress p;
    p.phase = stretch_.phase;
    p.dose = stretch_.dose;
    p.doseMass = book_.soFar(now_);
    p.time = timeline_.time(step_);
    p.step = step_;
    const std::uint64_t expected = expectedSteps(case_, timeline_, result_);
    p.expectedSteps = expected < step_ ? 0 : expected;  // a dose to a mass that takes longer than it should
    p.phaseEnd = step_ == stretch_.end;
    p.steps = step_ - before_.steps;
    p.particleSteps = result_.particleSteps - before_.particleSteps;
    p.wallTime = result_.wallTime - before_.wallTime;
    p.bodiesMoved = moved();
    observer_.onProgress(p);
}

}  // namespace vkdose
