#pragma once
// A run that stays in the hands of its caller: it goes on for a while and rests, and while it rests it can be looked
// at and stored. It prints nothing, writes nothing of its own accord and ends no process. Its bits are those of
// `vkdose run`, however often it rests.

#include <sys/types.h>

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "host/backend/backend.h"
#include "host/model/case.h"
#include "host/sim/dose.h"
#include "host/sim/frame.h"
#include "host/sim/sample.h"
#include "host/sim/stop_rule.h"

namespace vkdose {

/// A call in a process that was forked off after the simulation had been opened.
class ForkError : public std::logic_error {
    using std::logic_error::logic_error;
};

/// Throws std::invalid_argument for a speed [rad/s] that no drive has, and CaseError if no case like this may have it.
void requireDriveSpeed(const Case& c, double speed);

/// It keeps its readings, doses and fields in memory, for `store`.
///
/// The run is made by a thread of its own, which sleeps while the run rests. All calls but `awaitRest` and `halt` are
/// refused with std::logic_error while the run goes on. Only one thread may call at a time.
///
/// It belongs to the process that opened it, because a fork takes no other thread along. In a process that was forked
/// off later all calls but `theCase`, `backend` and `inOwnProcess` throw ForkError, and the destructor does nothing.
class Simulation {
  public:
    /// Loads the case; the run rests before its first step. Throws CaseError, and what Backend::load throws.
    Simulation(Case c, std::unique_ptr<Backend> backend);
    /// Ends the run.
    ~Simulation();
    Simulation(const Simulation&) = delete;
    Simulation& operator=(const Simulation&) = delete;

    /// Lets the run go on for `seconds`: to the first reading of the sensors after half an interval less than that, and
    /// at least to the next one. Returns at once: awaitRest. Infinity: to its end. Does nothing if the run is over.
    void advance(double seconds);

    /// The same, to the end of a dose or of the run.
    void advanceToDose();

    /// Waits until the run rests, or for `most`. Returns whether it rests. Throws RunError or DeviceError if that ended
    /// the run, whenever it is called.
    bool awaitRest(std::chrono::milliseconds most);

    /// Whether the drive takes orders now: it conveys, it has not been told to stop, and the run rests at a reading.
    bool takesOrders() const;

    /// From now on the drive conveys at this speed >= 0 [rad/s], to the end of this dose's rotation. The ramp of the
    /// case applies. Throws std::logic_error unless takesOrders(), and CaseError if no case may have such a speed.
    void changeSpeed(double speed);

    /// The drive is told to stop now, as by the end of its rotation. Throws std::logic_error unless takesOrders().
    void stopDrive();

    /// Adds the powder of this refill of the case before the next step, as if its time had come. Throws
    /// std::invalid_argument if the case has no such refill, and std::logic_error if it has been added or the run does
    /// not rest at a reading, or before its first step.
    void addPowder(const std::string& refill);

    /// Leaves in `folder` what `vkdose run` would have left had it been interrupted now, so that `vkdose resume` goes
    /// on with the same bits; of a run that is over, what it leaves at its end. Frames of the time before and the
    /// states for other runs are not among it. Afterwards the drive takes no more orders at this reading. Throws
    /// FolderError if the folder is not empty, unless `force` is set and it holds a run, which is replaced; and
    /// OutputError.
    void store(const std::filesystem::path& folder, bool force);

    /// Asks a run that goes on to rest as soon as the work that it has given to the backend is done, which takes about
    /// a second on a CPU. It then rests between two readings of the sensors.
    void halt();

    /// Whether this is the process that opened it. requireOwnProcess throws ForkError if it is not.
    bool inOwnProcess() const;
    void requireOwnProcess() const;

    const Case& theCase() const { return case_; }
    std::string backend() const { return backend_->description(); }

    bool over() const;                       ///< whether no step is left to be made
    StopReason reason() const;               ///< why the run ended; call only if it is over
    double time() const;                     ///< [s]
    const Sample& last() const;              ///< the latest reading of the sensors; step 0 before the first
    const std::vector<Dose>& doses() const;  ///< those that have ended
    double doseMass() const;  ///< dosed since the start of the latest dose, at the latest reading [kg]; 0 before it

    /// The particles now. They are read from the backend once for each rest; all callers share them.
    std::shared_ptr<const Particles> particles() const;
    /// All that a frame of a run holds, now. Contacts are read anew each time. Forces are those of the last step, and
    /// none before a step.
    Frame frame() const;
    /// A field now, of the case or not. Throws RunError if it cannot be had (faultOf).
    FieldPoints field(const FieldRequest& request) const;

  private:
    class Thread;
    void requireOrders() const;
    /// Throws ForkError.
    Thread& thread() const;

    pid_t process_;  ///< that opened it
    Case case_;
    std::unique_ptr<Backend> backend_;
    std::unique_ptr<Thread> thread_;  // after what it uses
};

}  // namespace vkdose
