#pragma once
// The loop of a run: phase after phase, call after call of the backend. runner.h holds the functions that play it.

#include <atomic>
#include <chrono>
#include <cstdint>
#include <new>
#include <optional>
#include <utility>

#include "host/core/error.h"
#include "host/core/memory_limit.h"
#include "host/sim/body_clocks.h"
#include "host/sim/body_loads.h"
#include "host/sim/checkpoint_pace.h"
#include "host/sim/dose_book.h"
#include "host/sim/energy_ledger.h"
#include "host/sim/region_book.h"
#include "host/sim/runner.h"
#include "host/sim/state_facts.h"

namespace vkdose {

/// A run that is under way.
class RunLoop {
  public:
    RunLoop(const Case& c, Insertion filled, Derived derived, Backend& backend, RunObserver& observer,
            const std::atomic<bool>& stop);

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

    void begin();
    /// Goes on where the run was when `from` was taken.
    void goOn(const RunCheckpoint& from);
    /// Begins with the powder of another run, which was in the state `from` at `time` [s].
    void takeOver(const RunCheckpoint& from, double time);

  private:
    template <class Begin>
    void playThrough(const Begin& begin) {
        try {
            begin(*this);
            pace_ = CheckpointPace(case_.checkpoint.wall, wallSeconds());
            checkpointTime_ = timeline_.time(step_);
            result_.reason = steps();
        } catch (const RunError& e) {
            fail(StopReason::RunError, e.what());
        } catch (const DeviceError& e) {
            fail(StopReason::DeviceError, e.what() + memoryLimitText());
        } catch (const std::bad_alloc&) {
            fail(StopReason::RunError, "out of memory: use fewer particles or end other programs" + memoryLimitText());
        }
    }

    // run_loop_states.cpp: the states that it keeps, and how it begins.

    /// The latest sensors of another run become the first sample of this one.
    void takeSample(const Record& run, const StateFacts& facts);
    /// The settling is over, because it was over in the other run, or because it took its time there.
    void takeSettled(const Record& run, const StateFacts& facts);
    /// The clock of the wall is not in it, so that a state depends on its run alone.
    void keepState(KeptState kind);
    Record save() const;
    void restore(const Record& r);
    void checkpoint();
    bool checkpointDue() const;

    // run_loop_refills.cpp: the powder that is added.

    /// Adds all powder that is due, if the sensors have just been read.
    void addPowder();
    /// Notes whether the powder that it watches is above its mark.
    bool due(std::size_t refill);
    /// The powder that is held against the mark of the refill [kg].
    double watched(const Refill& refill) const;
    bool isAdded(std::size_t refill) const;
    /// Particles of refills that the case will add.
    std::uint64_t planned() const;
    void bookAdded(std::size_t refill, std::uint64_t step);
    /// Energy that these particles bring, at rest at these positions after the steps so far [J].
    double energyOfRest(const Particles& powder, const std::vector<Vec3>& positions) const;
    void saveAdded(Record& r) const;
    /// `scale`: steps of this run for one of the run that kept the record.
    void restoreAdded(const Record& r, double scale = 1);

    // run_loop_sampling.cpp: from the calls of the backend to samples.

    /// Torque about +z on all that the drive turns, times the steps of a call. Of a body it is the torque at the drive
    /// that does the work of the body: the body may turn at another rate, or swing.
    double driveImpulse(const Sensors& s, std::uint64_t n) const;
    /// The torque that the drive must supply to convey against the powder's torque on the coil.
    double driveTorque(double onCoil) const { return -onCoil * timeline_.conveyingSense() + 0.0; }
    /// Joins the sensors of one call to those since the last sample.
    void gather(const Sensors& s, std::uint64_t n);
    void sample();

    // run_loop.cpp: the loop itself.

    StopReason steps();
    /// One call of the backend, towards the next sample. The coil turns at one rate in it.
    void advance(std::uint64_t sampleStep);
    /// Ends the settling if the case lets the bed's rest do so, and notes how it ended.
    void watchRest();
    /// Looks at the bed that has settled.
    void look();
    /// Takes the closed form of the doses anew with the density of the settled bed, if the case asks for it and the bed
    /// is large enough to tell it.
    void measureDensity();
    void frame();
    /// How far the bodies have come, as in Frame.
    std::vector<Moved> moved() const;
    /// As in Sample.
    std::vector<FreePlace> freePlaces() const;
    void beginDosing();
    /// The world of the case under the gravity that is in force.
    World worldNow() const;
    /// From the next step on gravity is this one [m/s2]. The energy ledger stays closed.
    void changeGravity(const Vec3& to);
    /// Lets the dose under way change the coil's speed or stop it. Returns true if that ends the run.
    bool control();
    void obey(DoseBook::Order& order);
    void openDose();
    void closeDose(bool complete);
    /// Returns true if the phase that ended completes a dose and the judge says it was the last one.
    bool phaseEnded();
    /// After an error: keeps the values of the last good sample and closes the dose under way as incomplete.
    void fail(StopReason reason, const std::string& what);
    void keepEndState();
    void report();

    static double mass(const Sensors& s, Region r) { return s.mass[static_cast<std::size_t>(r)]; }

    using WallClock = std::chrono::steady_clock;
    static double wallSeconds() { return std::chrono::duration<double>(WallClock::now().time_since_epoch()).count(); }

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
    Vec3 gravity_{case_.settlingGravity()};  ///< in force [m/s2]

    Sensors now_;                 ///< of the last call, joined with the calls since the last sample
    std::uint64_t gathered_ = 0;  ///< steps since the last sample
    BodyClocks clocks_{case_.world};
    BodyLoads loads_{loadNames(case_.world).size()};
    RegionBook regions_{case_.world};
    PowderBook powders_{case_.world};
    /// Of each refill: whether the powder that it watches was above its mark since its turn came.
    std::vector<std::uint64_t> wasAbove_ = std::vector<std::uint64_t>(case_.refills.size());
    double impulse_ = 0;   ///< torque times steps since the last sample
    double rate_ = 0;      ///< of the coil in the last call [rad/s about +z]
    bool varied_ = false;  ///< it was another since the last sample
    double powerSum_ = 0;  ///< power of the drive times steps since the last sample

    std::optional<EnergyLedger> energy_;  ///< since the start of the run, if the case asks for it

    CheckpointPace pace_{0, 0};
    double checkpointTime_ = 0;  ///< of the last checkpoint, or the start of the run, in simulated time [s]
};

}  // namespace vkdose
