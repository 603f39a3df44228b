#include "host/sim/runner.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "host/core/error.h"
#include "host/sim/density.h"
#include "host/sim/dose_book.h"
#include "host/sim/expected_steps.h"
#include "host/sim/region_book.h"
#include "host/sim/run_record.h"
#include "host/sim/state_facts.h"

namespace vkdose {

namespace {

using Clock = std::chrono::steady_clock;

/// Work of one `advance`. It is large enough that the call costs nothing beside it, and small enough that Ctrl-C and
/// the progress bar answer within a second or so at the speeds of a CPU. It is a fixed number, so that the same case
/// makes the same calls.
constexpr double kParticleStepsPerCall = 4e6;

std::uint64_t count(const Sensors& s, Region r) {
    return s.count[static_cast<std::size_t>(r)];
}
double mass(const Sensors& s, Region r) {
    return s.mass[static_cast<std::size_t>(r)];
}
std::uint64_t active(const Sensors& s) {
    return count(s, Region::Canister) + count(s, Region::Throat);
}

class Run {
  public:
    Run(const Case& c, Insertion filled, Derived derived, Backend& backend, RunObserver& observer,
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
        result_.particles = result_.filled.particles;
        result_.ledger = Ledger(result_.particles.size(), result_.filled.mass);
        result_.last.sensors.count[0] = result_.particles.size();
        result_.last.sensors.mass[0] = result_.filled.mass;
        active_ = result_.particles.size();
    }

    /// `begin` brings the backend and this to the state in which the first step is made.
    template <class Begin>
    RunResult play(const Begin& begin) {
        try {
            playThrough(begin);
        } catch (const OutputError& e) {
            result_.reason = StopReason::OutputError;
            result_.error = e.what();
        }
        result_.statistics = statistics(result_.doses);
        return std::move(result_);
    }

    void begin() {
        backend_.load(case_.world, case_.settlingLaw, result_.particles);
        if (timeline_.frameDue(0)) frame();
    }

    /// Goes on where the run was when `from` was taken.
    void goOn(const RunCheckpoint& from) {
        restore(from.run);
        backend_.load(case_.world, dosing_ ? case_.dosingLaw : case_.settlingLaw, result_.particles);
        backend_.restore(from.backend);
        before_ = {step_, result_.particleSteps, result_.wallTime};
        // The adhesion of the doses may be another than that of the run that settled this bed.
        if (!dosing_ && result_.settled) look();
    }

    /// Begins with the powder of another run, which was in the state `from` at `time` [s].
    void takeOver(const RunCheckpoint& from, double time) {
        const StateFacts facts = factsOf(from.run);
        if (facts.radii != result_.filled.particles.radius)
            throw RecordError("its particles are not those of the case");
        step_ = static_cast<std::uint64_t>(std::llround(time / case_.world.timeStep));
        backend_.load(case_.world, facts.dosing ? case_.dosingLaw : case_.settlingLaw, result_.particles);
        Record state = from.backend;
        // The clock of bodies that move counts steps.
        if (state.arrays().contains(kSnapshotSteps)) state.putOne(kSnapshotSteps, step_);
        backend_.restore(state);
        active_ = facts.active;
        takeSample(from.run, facts);
        before_.steps = step_;
        const bool settled = facts.settled || step_ >= timeline_.settleSteps();
        if (settled)
            takeSettled(from.run, facts);
        else if (facts.step == step_)  // else its time steps were others
            rest_.restore(from.run);
        observer_.onSample(result_.last);
        if (timeline_.keepsFrames()) frame();
        for (const FieldSample& f : fields_.open(backend_, step_)) observer_.onField(f);
        if (settled) keepState(KeptState::Settled);
    }

  private:
    template <class Begin>
    void playThrough(const Begin& begin) {
        try {
            begin(*this);
            checkpointed_ = Clock::now();
            checkpointTime_ = timeline_.time(step_);
            result_.reason = steps();
        } catch (const RunError& e) {
            fail(StopReason::RunError, e.what());
        } catch (const DeviceError& e) {
            fail(StopReason::DeviceError, e.what());
        }
    }

    /// The latest sensors of another run become the first sample of this one.
    void takeSample(const Record& run, const StateFacts& facts) {
        Sample& s = result_.last;
        get(run, "last", s);
        get(run, "now", now_);
        get(run, "energy", energy_);
        if (facts.sinceSample)
            s.sensors = now_;
        else
            loads_.restore(run);
        if (facts.dosing) {  // its drive rests now
            s.sensors.coilTorque = s.coilTorque = s.coilPower = 0;
        }
        s.step = step_;
        s.time = timeline_.time(step_);
        s.phase = Phase::Settle;
        s.dose = 0;
        s.coilAngle = backend_.coilAngle();
        s.energy = energy_;
    }

    /// The settling is over, because it was over in the other run, or because it took its time there.
    void takeSettled(const Record& run, const StateFacts& facts) {
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
    }

    /// Looks at the bed that has settled.
    void look() {
        result_.settled = settledBed(case_, timeline_.time(step_), backend_.particles(), backend_.contacts());
    }

    /// The clock of the wall is not in it, so that a state depends on its run alone.
    void keepState(KeptState kind) {
        if (!observer_.storesStates()) return;
        RunCheckpoint state{save(), backend_.snapshot()};
        std::vector<double> sums = state.run.get<double>("sums");
        sums.back() = 0;
        state.run.put("sums", std::move(sums));
        state.run.putOne("steps_of_others", result_.particleSteps);
        observer_.onState(kind, state, timeline_.time(step_));
    }

    Record save() const {
        Record r;
        r.put("progress", std::vector<std::uint64_t>{step_, active_, dosing_ ? 1U : 0U, gathered_, varied_ ? 1U : 0U});
        r.put("sums",
              std::vector<double>{impulse_, powerSum_, rate_, result_.dosedWhileSettling, result_.maxOverlapRatio,
                                  result_.maxOverlapTime, result_.particleSteps, result_.wallTime});
        r.putOne("steps_of_others", result_.stepsOfOthers);
        put(r, "now", now_);
        loads_.save(r);
        regions_.save(r);
        put(r, "energy", energy_);
        timeline_.save(r);
        book_.save(r);
        put(r, "doses", result_.doses);
        put(r, "last", result_.last);
        put(r, result_.settled);
        put(r, result_.settling);
        rest_.save(r);
        r.put("radius", result_.filled.particles.radius);
        fields_.save(r);
        result_.ledger.save(r);
        judge_.save(r);
        return r;
    }

    void restore(const Record& r) {
        if (r.get<double>("radius") != result_.filled.particles.radius)
            throw RecordError("its particles are not those of its case: a list that has changed, or another version");
        const auto& progress = r.get<std::uint64_t>("progress", 5);
        step_ = progress[0];
        active_ = progress[1];
        dosing_ = progress[2] != 0;
        gathered_ = progress[3];
        varied_ = progress[4] != 0;
        const auto& sums = r.get<double>("sums", 8);
        loads_.restore(r);
        regions_.restore(r);
        impulse_ = sums[0];
        powerSum_ = sums[1];
        rate_ = sums[2];
        result_.dosedWhileSettling = sums[3];
        result_.maxOverlapRatio = sums[4];
        result_.maxOverlapTime = sums[5];
        result_.particleSteps = sums[6];
        result_.wallTime = sums[7];
        if (r.arrays().contains("steps_of_others")) result_.stepsOfOthers = r.one<double>("steps_of_others");
        get(r, "now", now_);
        get(r, "energy", energy_);
        timeline_.restore(r);
        if (!dosing_) timeline_.endSettling(timeline_.settleSteps());  // the doses are those of the case
        book_.restore(r);
        get(r, "doses", result_.doses);
        get(r, "last", result_.last);
        result_.last.regions = regions_.counts();
        get(r, result_.filled.particles, result_.settled);
        measureDensity();
        get(r, result_.settling);
        rest_.restore(r);
        fields_.restore(r);
        result_.ledger.restore(r);
        judge_.restore(r);
        if (!timeline_.over(step_)) stretch_ = timeline_.at(step_);
    }

    void checkpoint() {
        if (!observer_.storesCheckpoints()) return;
        checkpointTime_ = timeline_.time(step_);
        observer_.onCheckpoint({save(), backend_.snapshot()}, checkpointTime_);
        checkpointed_ = Clock::now();
    }

    bool checkpointDue() const {
        const CheckpointInterval& every = case_.checkpoint;
        const double wall = std::chrono::duration<double>(Clock::now() - checkpointed_).count();
        const double time = timeline_.time(step_);
        return (every.wall > 0 && wall >= every.wall) ||
               (every.simulated > 0 &&
                std::floor(time / every.simulated) > std::floor(checkpointTime_ / every.simulated));
    }

    StopReason steps() {
        while (!timeline_.over(step_)) {
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
        if (book_.underWay()) closeDose(false);
        keepEndState();
        if (timeline_.hasDoses()) keepState(KeptState::End);  // without doses it is the settled one
        return timeline_.cutByEndTime(step_) ? StopReason::EndTime : StopReason::Settled;
    }

    /// One call of the backend, towards the next sample. The coil turns at one rate in it.
    void advance(std::uint64_t sampleStep) {
        sampleStep_ = sampleStep;
        const double perCall = kParticleStepsPerCall / static_cast<double>(std::max<std::uint64_t>(active_, 1));
        const auto limit = static_cast<std::uint64_t>(std::clamp(perCall, 64.0, 1e6));
        const std::uint64_t n = std::min({sampleStep_ - step_, stretch_.pieceEnd - step_, limit});
        const auto begin = Clock::now();
        const Sensors s = backend_.advance(static_cast<std::uint32_t>(n), stretch_.rate);
        result_.wallTime += std::chrono::duration<double>(Clock::now() - begin).count();
        result_.particleSteps += static_cast<double>(active_) * static_cast<double>(n);
        step_ += n;
        active_ = active(s);
        gather(s, n);
        report();
    }

    /// Torque about +z on all that the drive turns, times the steps of a call. Of a body it is the torque at the drive
    /// that does the work of the body: the body may turn at another rate, or swing.
    double driveImpulse(const Sensors& s, std::uint64_t n) const {
        double impulse = s.coilTorque * static_cast<double>(n);
        if (stretch_.rate == 0) return impulse;
        const std::vector<RigidBody>& bodies = case_.world.bodies;
        for (std::size_t b = 0; b < bodies.size(); ++b)
            if (bodies[b].clock == vkdose::Clock::Drive)
                impulse -= s.bodies[b].work / (stretch_.rate * case_.world.timeStep);
        return impulse;
    }

    /// Joins the sensors of one call to those since the last sample.
    void gather(const Sensors& s, std::uint64_t n) {
        if (s.energy) {
            if (!energy_) energy_.emplace();
            energy_->add(*s.energy);
        }
        if (s.maxOverlapRatio > result_.maxOverlapRatio) {
            result_.maxOverlapRatio = s.maxOverlapRatio;
            result_.maxOverlapTime = timeline_.time(step_);
        }
        const double impulse = driveImpulse(s, n);
        const double overlap = gathered_ > 0 ? std::max(now_.maxOverlapRatio, s.maxOverlapRatio) : s.maxOverlapRatio;
        now_ = s;
        now_.maxOverlapRatio = overlap;
        varied_ = gathered_ > 0 && (varied_ || stretch_.rate != rate_);
        rate_ = stretch_.rate;
        powerSum_ = gathered_ > 0 ? powerSum_ - impulse * rate_ : -impulse * rate_;
        gathered_ += n;
        impulse_ += impulse;
        loads_.add(s.bodies, n);
        if (stretch_.phase == Phase::Rotate) book_.turn(impulse, n, stretch_.rate);
    }

    void sample() {
        if (gathered_ == 0) return;
        Sample s;
        s.step = step_;
        s.time = timeline_.time(step_);
        s.phase = stretch_.phase;
        s.dose = stretch_.dose;
        s.coilAngle = backend_.coilAngle();
        s.sensors = now_;
        s.sensors.coilTorque = impulse_ / static_cast<double>(gathered_);
        s.coilTorque = driveTorque(s.sensors.coilTorque);
        const double speed = stretch_.phase == Phase::Reverse ? -std::abs(rate_) : std::abs(rate_);
        s.coilPower = varied_ ? powerSum_ / static_cast<double>(gathered_) : s.coilTorque * speed;
        const double throat = mass(now_, Region::Throat);
        s.outletVelocity = throat > 0 ? now_.throatMomentumZ / throat : std::numeric_limits<double>::quiet_NaN();
        s.energy = energy_;
        s.bodies = loads_.take(gathered_, case_.world.timeStep);
        if (!regions_.empty()) regions_.look(backend_.particles());
        s.regions = regions_.counts();
        gathered_ = 0;
        impulse_ = 0;
        observer_.onSample(s);
        result_.ledger.close(s.sensors, s.time);  // after the observer, so that a bad ledger is on record
        result_.last = s;
    }

    /// Ends the settling if the case lets the bed's rest do so, and notes how it ended.
    void watchRest() {
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
        observer_.onSettled(*result_.settling, case_.schedule);
    }

    /// Takes the closed form of the doses anew with the density of the settled bed, if the case asks for it and the bed
    /// is large enough to tell it.
    void measureDensity() {
        if (!case_.bulkDensityMeasured || !result_.settled) return;
        const auto bulk = settledDensity(case_, result_.settled->particles);
        if (!bulk) return;
        Case measured = case_;
        measured.bulkDensity = bulk->density;
        result_.derived = derive(measured, result_.filled);
        book_.expect(result_.derived);
    }

    void frame() {
        if (!observer_.storesFrames()) return;
        observer_.onFrame({step_, timeline_.time(step_), stretch_.phase, stretch_.dose, backend_.coilAngle(),
                           backend_.particles(), backend_.contacts()});
        if (case_.frames.states && step_ > 0) keepState(KeptState::Frame);
    }

    /// The torque that the drive must supply to convey against the powder's torque on the coil.
    double driveTorque(double onCoil) const { return -onCoil * timeline_.conveyingSense() + 0.0; }

    void beginDosing() {
        dosing_ = true;
        backend_.setLaw(*stretch_.law);
        result_.dosedWhileSettling = mass(result_.last.sensors, Region::Dosed);
    }

    /// Lets the dose under way change the coil's speed or stop it. Returns true if that ends the run.
    bool control() {
        if (stretch_.phase != Phase::Rotate || !book_.conveys()) return false;
        const DoseBook::Order order = book_.look(result_.last, step_ == stretch_.stop);
        if (order.speed) timeline_.changeSpeed(step_, *order.speed);
        if (!order.stop) return false;
        if (step_ < stretch_.stop) {
            timeline_.stopTurning(step_);
            stretch_ = timeline_.at(step_ - 1);
        }
        return *order.stop == StopCause::Torque && case_.schedule.torqueEndsRun;
    }

    void openDose() {
        book_.open(stretch_.dose, timeline_.time(step_), result_.last.sensors);
        regions_.openDose();
    }

    void closeDose(bool complete) {
        result_.doses.push_back(book_.close(complete, result_.last.sensors, timeline_.time(step_)));
        result_.doses.back().regions = regions_.sinceDose();
        observer_.onDose(result_.doses.back());
    }

    /// Returns true if the phase that ended completes a dose and the judge says it was the last one.
    bool phaseEnded() {
        if (!stretch_.closesDose) return false;
        closeDose(true);
        const Dose& d = result_.doses.back();
        return judge_.over(d.mass, d.particles, active_);
    }

    /// After an error: keeps the values of the last good sample and closes the dose under way as incomplete.
    void fail(StopReason reason, const char* what) {
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

    void keepEndState() {
        result_.particles = backend_.particles();
        result_.endState = true;
    }

    void report() {
        Progress p;
        p.phase = stretch_.phase;
        p.dose = stretch_.dose;
        p.time = timeline_.time(step_);
        p.step = step_;
        const std::uint64_t expected = expectedSteps(case_, timeline_, result_);
        p.expectedSteps = expected < step_ ? 0 : expected;  // a dose to a mass that takes longer than it should
        p.phaseEnd = step_ == stretch_.end;
        p.steps = step_ - before_.steps;
        p.particleSteps = result_.particleSteps - before_.particleSteps;
        p.wallTime = result_.wallTime - before_.wallTime;
        observer_.onProgress(p);
    }

    const Case& case_;
    Backend& backend_;
    RunObserver& observer_;
    const std::atomic<bool>& stop_;
    Timeline timeline_;
    DoseJudge judge_;
    RestWatch rest_;
    DoseBook book_;
    FieldWatch fields_;
    RunResult result_;

    /// The counts at the checkpoint from which the run goes on.
    struct {
        std::uint64_t steps = 0;
        double particleSteps = 0, wallTime = 0;
    } before_;

    std::uint64_t step_ = 0;
    std::uint64_t sampleStep_ = 0;
    std::uint64_t active_ = 0;  ///< particles still moving
    Timeline::Stretch stretch_{Phase::Settle, 0, 0, 0};
    bool dosing_ = false;

    Sensors now_;                 ///< of the last call, joined with the calls since the last sample
    std::uint64_t gathered_ = 0;  ///< steps since the last sample
    BodyLoads loads_{case_.world.bodies.size()};
    RegionBook regions_{case_.world};
    double impulse_ = 0;   ///< torque times steps since the last sample
    double rate_ = 0;      ///< of the coil in the last call [rad/s about +z]
    bool varied_ = false;  ///< it was another since the last sample
    double powerSum_ = 0;  ///< power of the drive times steps since the last sample

    std::optional<EnergyLedger> energy_;  ///< since the start of the run, if the case asks for it

    Clock::time_point checkpointed_;  ///< last checkpoint, or start of the run
    double checkpointTime_ = 0;       ///< the same in simulated time [s]
};

}  // namespace

RunResult runFilled(const Case& c, Insertion filled, Derived derived, Backend& backend, RunObserver& observer,
                    const std::atomic<bool>& stop, const RunCheckpoint* from) {
    return Run(c, std::move(filled), std::move(derived), backend, observer, stop).play([from](Run& run) {
        if (from != nullptr)
            run.goOn(*from);
        else
            run.begin();
    });
}

RunResult runFrom(const Case& c, Insertion filled, Derived derived, Backend& backend, RunObserver& observer,
                  const std::atomic<bool>& stop, const RunCheckpoint& from, double time) {
    return Run(c, std::move(filled), std::move(derived), backend, observer, stop).play([&](Run& run) {
        run.takeOver(from, time);
    });
}

RunResult runCase(const Case& c, Backend& backend, RunObserver& observer, const std::atomic<bool>& stop) {
    Insertion filled = insertParticles(c);
    Derived derived = derive(c, filled);
    return runFilled(c, std::move(filled), std::move(derived), backend, observer, stop);
}

}  // namespace vkdose
