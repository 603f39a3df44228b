#pragma once
// Runs a case on a backend: insert, settle, dose after dose, until a stop rule holds. Knows no concrete backend.

#include <atomic>
#include <cstdint>
#include <string>
#include <vector>

#include "host/backend/backend.h"
#include "host/core/record.h"
#include "host/model/case.h"
#include "host/sim/energy_ledger.h"
#include "host/sim/field_watch.h"
#include "host/sim/frame.h"
#include "host/sim/ledger.h"
#include "host/sim/stop_rule.h"
#include "host/sim/timeline.h"

namespace vkdose {

/// One line of the time series, at a multiple of the sensor interval or at the end of a phase. Torque and power are
/// means, the overlap is the largest since the sample before; everything else is the value at `time`.
struct Sample {
    std::uint64_t step = 0;
    double time = 0;  ///< [s]
    Phase phase = Phase::Settle;
    int dose = 0;                        ///< 0 while settling
    double coilAngle = 0;                ///< turned since the start, positive when conveying [rad]
    Sensors sensors;                     ///< coilTorque: about +z, on the coil, mean since the last sample [N m]
    double outletVelocity = 0;           ///< mean v_z of the mass in the throat [m/s]; NaN while it is empty
    double coilTorque = 0;               ///< the drive's: positive when the powder resists conveying [N m]
    double coilPower = 0;                ///< drive torque times speed [W]
    std::optional<EnergyLedger> energy;  ///< if the case asks for it
};

struct Dose {
    int index = 0;         ///< 1 for the first
    double startTime = 0;  ///< [s]
    double mass = 0;       ///< dosed from the start of its rotation to the end of its rest [kg]
    std::uint64_t particles = 0;
    double cumulative = 0;  ///< dosed since the start of the run [kg]
    double coilTorque = 0;  ///< drive torque, mean over its rotation [N m]
    double closedForm = 0;  ///< rho_b p pi r_c^2 n_t [kg]; 0 without a coil
    bool complete = false;  ///< false if the run ended within it: then it is in no statistics
};

struct DoseStatistics {
    int doses = 0;         ///< complete ones
    double mean = 0;       ///< [kg]
    double deviation = 0;  ///< sample standard deviation (n - 1) [kg]; 0 for fewer than two doses
    double relative = 0;   ///< deviation / mean [-]; 0 if nothing was dosed
};
DoseStatistics statistics(const std::vector<Dose>& doses);

/// How far a run is; for the progress bar.
struct Progress {
    Phase phase = Phase::Settle;
    int dose = 0;
    double time = 0;  ///< simulated [s]
    std::uint64_t step = 0;
    std::uint64_t expectedSteps = 0;  ///< of the whole run, from the doses so far; 0 when nothing can be said
    bool phaseEnd = false;
    // Since the run began or was gone on with: what was before says nothing of the machine it is on now.
    std::uint64_t steps = 0;
    double particleSteps = 0;  ///< active particles times steps
    double wallTime = 0;       ///< spent stepping [s]
};

/// What a run can go on from: the runner's own state and the backend's snapshot.
struct RunCheckpoint {
    Record run;
    Record backend;
};

/// Told as a run goes on. What it throws ends the run; an OutputError says that a result could not be stored.
class RunObserver {
  public:
    virtual ~RunObserver() = default;
    virtual void onProgress(const Progress&) {}
    virtual void onSample(const Sample&) {}
    virtual void onDose(const Dose&) {}
    virtual void onField(const FieldSample&) {}
    /// At the intervals of the case and when the run is interrupted, if `storesCheckpoints`.
    virtual void onCheckpoint(const RunCheckpoint&, double time) { (void)time; }
    virtual bool storesCheckpoints() const { return false; }
    /// Where the case wants frames (Timeline::frameDue) and at the end of the run, if `storesFrames`. Of a run that
    /// goes on from a checkpoint, those after it.
    virtual void onFrame(const Frame&) {}
    virtual bool storesFrames() const { return false; }
};

struct RunResult {
    Insertion filled;
    Derived derived;
    std::vector<Dose> doses;
    DoseStatistics statistics;
    double dosedWhileSettling = 0;  ///< [kg]
    Sample last;                    ///< the last sample; step 0 if there was none
    StopReason reason = StopReason::Settled;
    std::string error;  ///< what stopped the run, for RunError, DeviceError and OutputError
    Ledger ledger{0, 0};
    Particles particles;         ///< end state; the inserted ones if the backend cannot give it any more
    bool endState = false;       ///< true if `particles` is the end state
    double maxOverlapRatio = 0;  ///< largest overlap over smaller radius of the whole run
    double maxOverlapTime = 0;   ///< when the call in which it occurred ended [s]
    double particleSteps = 0;
    double wallTime = 0;  ///< spent stepping [s]

    double particleStepsPerSecond() const { return wallTime > 0 ? particleSteps / wallTime : 0; }
};

/// Runs `c` with the particles in `filled`. Setting `stop` ends the run at the next opportunity, keeping everything
/// computed until then. Errors of the run, the device or the output after loading began end it likewise: `reason` and
/// `error` tell. With `from`, goes on where that checkpoint of the same case was taken, as if never interrupted.
/// Throws CaseError if the schedule makes no sense and RecordError if the checkpoint does not fit.
RunResult runFilled(const Case& c, Insertion filled, Derived derived, Backend& backend, RunObserver& observer,
                    const std::atomic<bool>& stop, const RunCheckpoint* from = nullptr);

/// The same, inserting the particles first.
RunResult runCase(const Case& c, Backend& backend, RunObserver& observer, const std::atomic<bool>& stop);

}  // namespace vkdose
