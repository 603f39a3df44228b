#include "host/app/ensemble_runner.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <utility>

#include "host/app/play.h"
#include "host/core/error.h"
#include "host/output/hdf5.h"

namespace vkdose {

namespace {

constexpr std::chrono::seconds kMoment{1};

}  // namespace

EnsembleRunner::EnsembleRunner(BackendChoice choice, int most, const DeviceRoom& room)
    : choice_(std::move(choice)), most_(most), room_(room) {
    if (!hdf5::threadSafe())
        throw RunError("this HDF5 is for one thread at a time, an ensemble writes from several; use --jobs");
}

EnsembleRunner::~EnsembleRunner() {
    // An error ends the sweep: what has been started is to end with it.
    stop_ = true;
    for (auto& [number, thread] : threads_) thread.join();
}

std::string EnsembleRunner::manner() const {
    return most_ > 0 ? fmt::format("{} at a time on one device", most_)
                     : "as many at a time as the device's memory holds";
}

void EnsembleRunner::order(std::vector<WaitingMember>& members) {
    std::vector<BatchMember> sized;
    std::map<int, WaitingMember> byNumber;
    for (const WaitingMember& w : members) {
        const Case c = loadResolvedCase(w.member->caseText, "case.toml");
        sized.push_back(
            {w.member->number, w.steps, roomOf(c.world, insertParticles(c).allParticles(), c.dosingLaw.user)});
        byNumber[w.member->number] = w;
    }
    batches_ = batchesOf(std::move(sized), room_, std::size_t(most_ > 0 ? most_ : kMostThreads));
    members.clear();
    places_.clear();
    for (std::size_t batch = 0; batch < batches_.size(); ++batch)
        for (const int number : batches_[batch].members) {
            members.push_back(byNumber.at(number));
            places_[number] = {batch, byNumber.at(number).member->particles};
        }
}

bool EnsembleRunner::takes(const Member& member) const {
    const std::size_t running = threads_.size() + first_.size();
    if (running == 0) return true;
    const std::size_t batch = places_.at(first_.empty() ? threads_.begin()->first : first_.front().number).batch;
    return places_.at(member.number).batch == batch && running < batches_[batch].places;
}

void EnsembleRunner::start(const MemberTask& task) {
    if (threads_.empty())
        first_.push_back(task);
    else
        play(task, nullptr);
}

void EnsembleRunner::launch() {
    std::size_t particles = 0;
    for (const MemberTask& task : first_) particles += places_.at(task.number).particles;
    ensemble_.reset();  // the former one makes room for this one
    ensemble_.emplace(makeEnsemble(choice_, particles));
    std::vector<std::unique_ptr<Backend>> backends;
    while (backends.size() < first_.size()) backends.push_back(ensemble_->enter());
    const std::vector<MemberTask> tasks = std::exchange(first_, {});
    for (std::size_t i = 0; i < tasks.size(); ++i) play(tasks[i], std::move(backends[i]));
}

void EnsembleRunner::play(const MemberTask& task, std::unique_ptr<Backend> backend) {
    threads_[task.number] = std::thread([this, task, backend = std::move(backend)]() mutable {
        MemberEnd end = run(task, std::move(backend));
        const std::lock_guard lock(mutex_);
        ended_.push_back(std::move(end));
        someEnded_.notify_one();
    });
}

MemberEnd EnsembleRunner::run(const MemberTask& task, std::unique_ptr<Backend> backend) {
    MemberEnd end{task.number, kOk, ""};
    try {
        // As `vkdose run` and `vkdose resume` would; a member's end takes its backend with it, and nobody waits for it.
        ReadyRun ready = task.resume ? readyToResume(task.folder) : readyRun({task.folder / "case.toml", {}});
        ready.role = {task.bed ? 0 : std::uint32_t(task.number), task.bed, ""};
        if (!backend) backend = ensemble_->enter();
        if (ready.from) requireSameKind(ready.from->backend, choice_, *backend);
        RunFolder folder = folderOf(ready, task.folder, true, *backend);
        const Played played = vkdose::play(std::move(ready), *backend, folder, nullptr, stop_);
        end.code = played.code;
        end.said = played.error;
        const std::vector<std::string> found = validationFindings(choice_, *backend);
        if (played.error.empty() && !found.empty()) end = {task.number, kDeviceError, lastSaid(found.back())};
    } catch (...) {
        const Refusal refusal = refusalOf(std::current_exception());
        end.code = refusal.code;
        end.said = lastSaid(refusal.text);
    }
    return end;
}

std::optional<MemberEnd> EnsembleRunner::wait() {
    if (threads_.empty()) launch();
    std::unique_lock lock(mutex_);
    if (!someEnded_.wait_for(lock, kMoment, [this] { return !ended_.empty(); })) return std::nullopt;
    MemberEnd end = std::move(ended_.front());
    ended_.pop_front();
    lock.unlock();
    threads_.at(end.number).join();
    threads_.erase(end.number);
    return end;
}

}  // namespace vkdose
