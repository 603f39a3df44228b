#pragma once
// Runs a case on a backend: insert, settle, dose after dose, until a stop rule holds. Knows no concrete backend.

#include <atomic>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "host/backend/backend.h"
#include "host/core/record.h"
#include "host/model/case.h"
#include "host/sim/dose.h"
#include "host/sim/field_watch.h"
#include "host/sim/frame.h"
#include "host/sim/ledger.h"
#include "host/sim/rest_watch.h"
#include "host/sim/sample.h"
#include "host/sim/settled_bed.h"
#include "host/sim/stop_rule.h"
#include "host/sim/timeline.h"

namespace vkdose {

/// How far a run is; for the progress bar.
struct Progress {
    Phase phase = Phase::Settle;
    int dose = 0;
    double doseMass = 0;  ///< dosed so far in the dose under way [kg]; 0 while there is none
    double time = 0;      ///< simulated [s]
    std::uint64_t step = 0;
    std::uint64_t expectedSteps = 0;  ///< of the whole run, estimated from the doses so far; 0 when nothing can be said
    bool phaseEnd = false;
    // Counted since the run began or was resumed: earlier work says nothing about the machine that the run is on now.
    std::uint64_t steps = 0;
    double particleSteps = 0;          ///< active particles times steps
    double wallTime = 0;               ///< spent stepping [s]
    std::vector<Moved> bodiesMoved{};  ///< as in Frame
};

/// A state to resume from: the runner's own and the backend's snapshot.
struct RunCheckpoint {
    Record run;
    Record backend;
};

/// The states that a run leaves for others to start from: at the end of settling, at its frames if the case asks for
/// that, and at its end.
enum class KeptState { Settled, Frame, End };

/// A refill of the case that has been added.
struct AddedPowder {
    std::size_t refill = 0;  ///< index in Case::refills
    std::string name;
    std::size_t table = 0, ofTable = 1;  ///< its [[refill]], and how many refills that gives
    std::uint64_t step = 0;              ///< steps made before
    double time = 0;                     ///< [s]
    std::size_t particles = 0;
    double mass = 0;  ///< [kg]
};

/// Is told of events as a run goes on. An exception that it throws ends the run; an OutputError says that a result
/// could not be stored.
class RunObserver {
  public:
    virtual ~RunObserver() = default;
    virtual void onProgress(const Progress&) {}
    virtual void onSample(const Sample&) {}
    virtual void onSettled(const Settling&, const Case&) {}
    virtual void onDose(const Dose&) {}
    /// Asked at each sample at which the drive conveys and nothing in the case stops it. The drive obeys from this
    /// sample on.
    virtual DriveOrder order() { return {}; }
    virtual void onOrder(const GivenOrder&) {}
    /// Asked before a call of the backend that follows a reading of the sensors: whether this refill of the case is to
    /// be added now, though its time has not come. Not asked again once it has been added.
    virtual bool wantsRefill(std::size_t refill) {
        (void)refill;
        return false;
    }
    virtual void onRefill(const AddedPowder&) {}
    virtual void onField(const FieldSample&) {}
    /// Asked before each call of the backend, when all that belongs to the steps so far is done. The run waits for the
    /// answer. With true a checkpoint is made now, if `storesCheckpoints`, and it is asked again.
    virtual bool wantsCheckpoint() { return false; }
    /// Called at the intervals of the case, when the run is interrupted and by `wantsCheckpoint`, if
    /// `storesCheckpoints`.
    virtual void onCheckpoint(const RunCheckpoint&, double time) { (void)time; }
    virtual bool storesCheckpoints() const { return false; }
    /// Called when the powder has settled, and at the end of a run with doses that nothing cut short, if
    /// `storesStates`.
    virtual void onState(KeptState, const RunCheckpoint&, double time) { (void)time; }
    virtual bool storesStates() const { return false; }
    /// Called where the case wants frames (Timeline::frameDue) and at the end of the run, if `storesFrames`. A run that
    /// goes on from a checkpoint gives only the frames after it.
    virtual void onFrame(const Frame&) {}
    virtual bool storesFrames() const { return false; }
};

struct RunResult {
    Insertion filled;
    Derived derived;
    std::vector<Dose> doses;
    DoseStatistics statistics;
    std::vector<AddedPowder> added;     ///< in the order of time
    std::vector<GivenOrder> orders;     ///< that the drive has obeyed, likewise
    double dosedWhileSettling = 0;      ///< [kg]
    std::optional<Settling> settling;   ///< once it is over, if there was any
    std::optional<SettledBed> settled;  ///< the bed at that time
    Sample last;                        ///< the last sample; step 0 if there was none
    StopReason reason = StopReason::Settled;
    std::string error;  ///< what stopped the run, for RunError, DeviceError and OutputError
    Ledger ledger{0, 0};
    Particles particles;             ///< end state; those that were loaded if the backend cannot give it any more
    std::vector<Moved> bodiesMoved;  ///< at the end, as in Frame
    std::vector<BodyPeaks> bodyPeaks;
    bool endState = false;       ///< true if `particles`, `bodiesMoved` and `bodyPeaks` are those of the end
    double maxOverlapRatio = 0;  ///< largest overlap over smaller radius of the whole run
    double maxOverlapTime = 0;   ///< when the call in which it occurred ended [s]
    double particleSteps = 0;
    double wallTime = 0;       ///< spent stepping [s]
    double stepsOfOthers = 0;  ///< of the particle-steps, those that another run made and timed

    double particleStepsPerSecond() const { return wallTime > 0 ? (particleSteps - stepsOfOthers) / wallTime : 0; }
};

/// Runs `c` with the particles in `filled`. Setting `stop` ends the run at the next opportunity, keeping everything
/// computed until then. Errors of the run, the device or the output after loading began end it likewise; `reason` and
/// `error` then tell the cause. With `from` the run goes on where that checkpoint of the same case was taken, as if it
/// had never been interrupted. Throws CaseError if the schedule makes no sense and RecordError if the checkpoint does
/// not fit.
RunResult runFilled(const Case& c, Insertion filled, Derived derived, Backend& backend, RunObserver& observer,
                    const std::atomic<bool>& stop, const RunCheckpoint* from = nullptr);

/// A run of its own that begins with the powder of another one, in the state `from`, taken at `time` [s]. Its clock
/// goes on from there. If that run had settled, so has this one; else the powder settles on. Doses begin with the
/// first. The particles in `filled` must be those of the other run, and the world as far as contacts remember it.
/// Throws CaseError and RecordError as above.
RunResult runFrom(const Case& c, Insertion filled, Derived derived, Backend& backend, RunObserver& observer,
                  const std::atomic<bool>& stop, const RunCheckpoint& from, double time);

/// The same as runFilled, inserting the particles first.
RunResult runCase(const Case& c, Backend& backend, RunObserver& observer, const std::atomic<bool>& stop);

}  // namespace vkdose
