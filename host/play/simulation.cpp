#include "host/play/simulation.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <condition_variable>
#include <exception>
#include <limits>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <thread>
#include <utility>

#include "host/core/error.h"
#include "host/core/key.h"
#include "host/output/run_folder.h"
#include "host/sim/runner.h"

namespace vkdose {

namespace {

double dosedMass(const Sample& s) {
    return s.sensors.mass[std::size_t(Region::Dosed)];
}

/// The error that ended a run, or null.
std::exception_ptr errorOf(const RunResult& result) {
    if (result.reason == StopReason::RunError) return std::make_exception_ptr(RunError(result.error));
    if (result.reason == StopReason::DeviceError) return std::make_exception_ptr(DeviceError(result.error));
    return nullptr;
}

}  // namespace

/// The thread that makes the run. While it sleeps, all that it writes belongs to the caller.
class Simulation::Thread final : public RunObserver {
  public:
    Thread(const Case& c, Backend& backend) : case_(c), backend_(backend), filled_(insertParticles(c)) {
        seen_.refills.resize(c.refills.size(), false);
        seen_.last.sensors.count[0] = filled_.particles.size();
        seen_.last.sensors.mass[0] = filled_.mass;
        thread_ = std::thread([this] { play(); });
    }
    ~Thread() override {
        {
            const std::lock_guard lock(mutex_);
            closed_ = true;
            rests_ = false;
        }
        changed_.notify_all();
        thread_.join();
    }
    Thread(const Thread&) = delete;
    Thread& operator=(const Thread&) = delete;

    /// Wakes the run until this time [s], and if wanted to the end of a dose before it.
    void wake(double until, bool toDose) {
        {
            const std::lock_guard lock(mutex_);
            requireRest();
            if (seen_.over) return;
            until_ = until;
            toDose_ = toDose;
            halt_ = doseEnded_ = rests_ = false;
            seen_.particles.reset();
        }
        changed_.notify_all();
    }

    bool awaitRest(std::chrono::milliseconds most) {
        std::unique_lock lock(mutex_);
        if (!changed_.wait_for(lock, most, [this] { return rests_ || seen_.over; })) return false;
        if (error_) std::rethrow_exception(error_);
        return true;
    }

    void halt() {
        const std::lock_guard lock(mutex_);
        halt_ = true;
    }

    /// Brings the run to the place after its steps so far at which a state can be kept.
    void wakeToKeep() {
        {
            const std::lock_guard lock(mutex_);
            requireRest();
            if (seen_.over) return;
            keeping_ = halt_ = true;
            rests_ = false;
        }
        changed_.notify_all();
    }

    /// What the caller may look at while the run rests.
    struct Seen {
        bool over = false;
        bool takesOrders = false;
        DriveOrder order;                ///< the caller's
        std::vector<bool> refills;       ///< which of the case have been added, or will be with the next step
        RunResult result;                ///< if it is over
        std::uint64_t steps = 0;         ///< made
        std::vector<Moved> bodiesMoved;  ///< as in Frame
        Sample last;                     ///< as in `samples`; before the first, what was filled in
        std::vector<Sample> samples;
        std::vector<Dose> doses;
        std::vector<FieldSample> fields;
        double dosedBefore = 0;                      ///< the latest dose [kg]
        std::shared_ptr<const Particles> particles;  ///< once somebody has asked for them
        std::optional<RunCheckpoint> kept;           ///< by wakeToKeep
    };
    Seen& seen() {
        const std::lock_guard lock(mutex_);
        requireRest();
        return seen_;
    }

  private:
    void play() {
        RunResult result;
        std::exception_ptr error;
        try {
            Derived derived = derive(case_, filled_);
            const std::atomic<bool> stop{false};
            result = runFilled(case_, std::move(filled_), std::move(derived), backend_, *this, stop);
            error = errorOf(result);
        } catch (...) {
            error = std::current_exception();
        }
        const std::lock_guard lock(mutex_);
        seen_.result = std::move(result);
        seen_.over = true;
        error_ = error;
        changed_.notify_all();
    }

    /// At a reading that finds the drive conveying.
    DriveOrder order() override {
        std::unique_lock lock(mutex_);
        seen_.takesOrders = true;
        restIfDue(lock);
        seen_.takesOrders = false;
        return std::exchange(seen_.order, {});
    }

    bool wantsRefill(std::size_t refill) override {
        const std::lock_guard lock(mutex_);
        return seen_.refills[refill];
    }
    void onRefill(const AddedPowder& powder) override { seen_.refills[powder.refill] = true; }

    /// Before each step. All that belongs to the latest reading is done by then: its dose is closed, its phase is over.
    bool wantsCheckpoint() override {
        std::unique_lock lock(mutex_);
        if (!keeping_) restIfDue(lock);
        if (!keeping_) reading_ = false;
        return keeping_;
    }
    /// Not at the intervals of the case.
    bool storesCheckpoints() const override { return keeping_; }
    void onCheckpoint(const RunCheckpoint& checkpoint, double) override {
        const std::lock_guard lock(mutex_);
        seen_.kept = checkpoint;
        keeping_ = false;
    }

    void restIfDue(std::unique_lock<std::mutex>& lock) {
        const bool reached = seen_.last.time > until_ - case_.sensorInterval / 2 || (toDose_ && doseEnded_);
        rests_ = !closed_ && (halt_ || (reading_ && reached));
        if (rests_) {
            reading_ = false;  // no second rest at the same one
            changed_.notify_all();
            changed_.wait(lock, [this] { return !rests_; });
        }
        if (closed_) throw RunError("the simulation was closed");
    }

    void onProgress(const Progress& p) override {
        seen_.steps = p.step;
        seen_.bodiesMoved = p.bodiesMoved;
    }
    void onSample(const Sample& s) override {
        if (s.dose != seen_.last.dose) seen_.dosedBefore = dosedMass(seen_.last);
        seen_.last = s;
        seen_.samples.push_back(s);
        reading_ = true;
    }
    void onField(const FieldSample& f) override { seen_.fields.push_back(f); }
    void onDose(const Dose& d) override {
        seen_.doses.push_back(d);
        doseEnded_ = true;
    }

    void requireRest() const {
        if (!rests_ && !seen_.over) throw std::logic_error("the run goes on in another thread; wait until it rests");
    }

    const Case& case_;
    Backend& backend_;
    Insertion filled_;

    std::mutex mutex_;
    std::condition_variable changed_;
    bool rests_ = false, closed_ = false;
    bool halt_ = true;      ///< before the first step
    bool keeping_ = false;  ///< a checkpoint is to be made
    double until_ = 0;      ///< [s]
    bool toDose_ = false;
    bool reading_ = false;    ///< no step has been made since the latest reading
    bool doseEnded_ = false;  ///< since the run went on
    Seen seen_;
    std::exception_ptr error_;

    std::thread thread_;  // after all that it uses
};

Simulation::Simulation(Case c, std::unique_ptr<Backend> backend)
    : process_(getpid()),
      case_(std::move(c)),
      backend_(std::move(backend)),
      thread_(std::make_unique<Thread>(case_, *backend_)) {
    while (!awaitRest(std::chrono::hours(1))) {
    }
}

Simulation::~Simulation() {
    if (inOwnProcess()) return;
    // The thread is not in this process and cannot be joined, and a driver waits for threads of its own.
    (void)thread_.release();
    (void)backend_.release();
}

bool Simulation::inOwnProcess() const {
    return getpid() == process_;
}

void Simulation::requireOwnProcess() const {
    if (!inOwnProcess())
        throw ForkError(
            fmt::format("the simulation was opened in process {}, and can be used only there; this process "
                        "was forked off from it and has the number {}: open one here",
                        process_, getpid()));
}

Simulation::Thread& Simulation::thread() const {
    requireOwnProcess();
    return *thread_;
}

void Simulation::advance(double seconds) {
    if (!(seconds >= 0)) throw std::invalid_argument("a run goes on for a time >= 0 s");
    thread().wake(time() + seconds, false);
}

void Simulation::advanceToDose() {
    thread().wake(std::numeric_limits<double>::infinity(), true);
}

bool Simulation::awaitRest(std::chrono::milliseconds most) {
    return thread().awaitRest(most);
}

void Simulation::halt() {
    thread().halt();
}

bool Simulation::takesOrders() const {
    return thread().seen().takesOrders;
}

void requireDriveSpeed(const Case& c, double speed) {
    if (!(speed >= 0) || std::isinf(speed)) throw std::invalid_argument("the speed of a drive is a number >= 0");
    if (speed <= c.schedule.fastestSpeed()) return;
    const std::string key = c.world.coil ? "coil.speed_rpm" : "dose.speed_rpm";
    (void)loadResolvedCase(c.resolved, c.name, {fmt::format("{}={}", key, speed * kRpm.perSI)});
}

void Simulation::changeSpeed(double speed) {
    requireOrders();
    requireDriveSpeed(case_, speed);
    thread().seen().order.speed = speed;
}

void Simulation::stopDrive() {
    requireOrders();
    thread().seen().order.stop = true;
}

void Simulation::addPowder(const std::string& refill) {
    auto& seen = thread().seen();
    const auto found =
        std::find_if(case_.refills.begin(), case_.refills.end(), [&](const Refill& r) { return r.name == refill; });
    if (found == case_.refills.end())
        throw std::invalid_argument(fmt::format("the case has no [[refill]] named \"{}\"", refill));
    if (seen.over || seen.last.step != seen.steps)
        throw std::logic_error("powder is added at a reading of the sensors, and not now");
    const auto index = static_cast<std::size_t>(found - case_.refills.begin());
    if (seen.refills[index]) throw std::logic_error(fmt::format("refill \"{}\" has been added", refill));
    seen.refills[index] = true;
}

void Simulation::store(const std::filesystem::path& folder, bool force) {
    if (!over()) {
        thread().wakeToKeep();
        while (!awaitRest(std::chrono::hours(1))) {
        }
    }
    auto& seen = thread().seen();
    RunFolder out(folder, force, case_, backend_->description());
    for (const Sample& s : seen.samples) out.onSample(s);
    for (const Dose& d : seen.doses) out.onDose(d);
    for (const FieldSample& f : seen.fields) out.onField(f);
    if (seen.over)
        out.finish(case_, seen.result);
    else
        out.onCheckpoint(std::exchange(seen.kept, {}).value(), time());
}

void Simulation::requireOrders() const {
    if (!takesOrders())
        throw std::logic_error("the drive takes orders at a reading of the sensors while it conveys, and not now");
}

bool Simulation::over() const {
    return thread().seen().over;
}

StopReason Simulation::reason() const {
    return thread().seen().result.reason;
}

double Simulation::time() const {
    return double(thread().seen().steps) * case_.world.timeStep;
}

const Sample& Simulation::last() const {
    return thread().seen().last;
}

const std::vector<Dose>& Simulation::doses() const {
    return thread().seen().doses;
}

double Simulation::doseMass() const {
    const auto& seen = thread().seen();
    return seen.last.dose > 0 ? dosedMass(seen.last) - seen.dosedBefore : 0;
}

std::shared_ptr<const Particles> Simulation::particles() const {
    std::shared_ptr<const Particles>& now = thread().seen().particles;
    if (!now) now = std::make_shared<const Particles>(backend_->particles());
    return now;
}

Frame Simulation::frame() const {
    const Sample& s = last();
    const auto& seen = thread().seen();
    return {seen.steps,           time(),          s.phase, s.dose, backend_->coilAngle(), *particles(),
            backend_->contacts(), seen.bodiesMoved};
}

FieldPoints Simulation::field(const FieldRequest& request) const {
    (void)thread().seen();  // the run rests
    return backend_->fields(request);
}

}  // namespace vkdose
