#pragma once
// A run that stays in the hands of its caller: it goes on for a while and rests, and while it rests it can be looked
// at. It prints nothing, writes nothing and ends no process. Its bits are those of `vkdose run`, however often it
// rests.

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "host/backend/backend.h"
#include "host/model/case.h"
#include "host/sim/dose.h"
#include "host/sim/sample.h"
#include "host/sim/stop_rule.h"

namespace vkdose {

/// The run is made by a thread of its own, which sleeps while the run rests. All calls but `awaitRest` and `halt` are
/// refused with std::logic_error while the run goes on. Only one thread may call at a time.
class Simulation {
  public:
    /// Loads the case; the run rests before its first step. Throws CaseError, and what Backend::load throws.
    Simulation(Case c, std::unique_ptr<Backend> backend);
    /// Ends the run.
    ~Simulation();
    Simulation(const Simulation&) = delete;
    Simulation& operator=(const Simulation&) = delete;

    /// Lets the run go on to the reading of the sensors nearest to `seconds` from now, and at least to the next one.
    /// Returns at once: awaitRest. Infinity: to its end. Does nothing if the run is over.
    void advance(double seconds);

    /// The same, to the end of a dose or of the run.
    void advanceToDose();

    /// Waits until the run rests, or for `most`. Returns whether it rests. Throws RunError or DeviceError if that ended
    /// the run, whenever it is called.
    bool awaitRest(std::chrono::milliseconds most);

    /// Asks a run that goes on to rest as soon as the work that it has given to the backend is done, which takes about
    /// a second on a CPU. It then rests between two readings of the sensors.
    void halt();

    const Case& theCase() const { return case_; }
    std::string backend() const { return backend_->description(); }

    bool over() const;                       ///< whether no step is left to be made
    StopReason reason() const;               ///< why the run ended; call only if it is over
    double time() const;                     ///< [s]
    const Sample& last() const;              ///< the latest reading of the sensors; step 0 before the first
    const std::vector<Dose>& doses() const;  ///< those that have ended
    double doseMass() const;  ///< dosed since the start of the latest dose, at the latest reading [kg]; 0 before it
    const Particles& particles() const;  ///< now; valid until the run goes on

  private:
    class Thread;

    Case case_;
    std::unique_ptr<Backend> backend_;
    std::unique_ptr<Thread> thread_;  // after what it uses
};

}  // namespace vkdose
