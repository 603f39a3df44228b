#include "host/study/sweep.h"

#include <algorithm>
#include <deque>
#include <map>

#include "host/core/exit_code.h"
#include "host/core/file.h"
#include "host/core/folder_lock.h"
#include "host/output/checkpoint.h"

namespace vkdose {

namespace fs = std::filesystem;

namespace {

class Sweep {
  public:
    Sweep(SweepFolder& folder, const std::vector<Member>& members, MemberRunner& runner, SweepObserver& observer,
          const HaltRule& rule)
        : folder_(folder), members_(members), runner_(runner), observer_(observer), rule_(rule) {}

    SweepOutcome run(bool retryFailed) {
        retryFailed_ = retryFailed;
        if (runner_.settlesBeds()) settleBeds();
        queue();
        while (!waiting_.empty() || !running_.empty()) {
            if (halts()) waiting_.clear();
            while (!waiting_.empty() && runner_.takes(*waiting_.front().member) && !halts()) startNext();
            if (running_.empty()) continue;
            if (const auto end = runner_.wait()) ended(*end);
            observer_.onProgress(progress());
        }
        return outcome();
    }

  private:
    struct Running {
        const Member* member;
        double before;  ///< simulated time that it had reached when it was started [s]
    };

    /// Whether something ends the sweep. Then those that run are to end.
    bool halts() {
        if (halt_ != Halt::None) return true;
        halt_ = rule_();
        if (halt_ != Halt::None) runner_.interrupt();
        return halt_ != Halt::None;
    }

    SweepOutcome outcome() const {
        SweepOutcome outcome;
        outcome.members = int(members_.size());
        for (const Member& m : members_) {
            const auto status = folder_.status(m.number);
            outcome.ok += status == MemberStatus::Ok ? 1 : 0;
            outcome.failed += status == MemberStatus::Failed ? 1 : 0;
            if (status != MemberStatus::Ok && status != MemberStatus::Failed) outcome.workLeft += workLeft(m);
        }
        outcome.workLeft -= savedByBeds();
        outcome.whole = outcome.ok + outcome.failed == int(members_.size());
        outcome.halt = halt_;
        return outcome;
    }

    bool isWaiting(const Member& m) const {
        const auto status = folder_.status(m.number);
        return !status || status == MemberStatus::Interrupted || (status == MemberStatus::Failed && retryFailed_);
    }

    /// The beds of those members that have yet to begin.
    std::vector<Bed> bedsNeeded() const {
        std::vector<Bed> needed;
        for (Bed bed : bedsOf(members_)) {
            std::erase_if(bed.members, [&](int number) {
                const auto m = std::find_if(members_.begin(), members_.end(),
                                            [&](const Member& one) { return one.number == number; });
                const fs::path run = folder_.memberFolder(number);
                return !isWaiting(*m) || isOver(run) || fs::exists(run / kCheckpointName);
            });
            if (!bed.members.empty()) needed.push_back(std::move(bed));
        }
        return needed;
    }

    /// Particle-steps that members who have yet to begin need not make, because their beds settle once.
    double savedByBeds() const {
        std::vector<Bed> unsettled = runner_.settlesBeds() ? bedsNeeded() : std::vector<Bed>();
        std::erase_if(unsettled, [&](const Bed& bed) { return beds_.contains(bed.members.front()); });
        return workSaved(unsettled, members_);
    }

    /// Settles each bed that is needed once, as a run of its own.
    void settleBeds() {
        const std::vector<Bed> beds = bedsNeeded();
        std::vector<Member> runs;
        std::size_t served = 0;
        for (const Bed& bed : beds) {
            if (isSettled(bedFolder(folder_.path(), bed), bed.caseText)) continue;
            const auto first =
                std::find_if(members_.begin(), members_.end(), [&](const Member& m) { return m.number == bed.number; });
            Member run;
            run.number = bed.number;
            run.caseText = bed.caseText;
            run.particles = first->particles;
            run.expectedWork = first->settlingWork;
            runs.push_back(std::move(run));
            served += bed.members.size();
        }
        if (!runs.empty()) observer_.onBeds(runs.size(), served);
        playBeds(runs);
        for (const Bed& bed : beds) {
            const fs::path folder = bedFolder(folder_.path(), bed);
            if (!isSettled(folder, bed.caseText)) continue;
            for (const int number : bed.members) beds_[number] = folder;
        }
    }

    void playBeds(const std::vector<Member>& runs) {
        std::vector<WaitingMember> order;
        for (const Member& m : runs)
            order.push_back({&m, m.expectedWork / double(std::max<std::size_t>(m.particles, 1))});
        runner_.order(order);
        std::deque<WaitingMember> waiting(order.begin(), order.end());
        std::size_t running = 0;
        while (!waiting.empty() || running > 0) {
            if (halts()) waiting.clear();
            for (; !waiting.empty() && runner_.takes(*waiting.front().member) && !halts(); waiting.pop_front())
                running += startBed(*waiting.front().member) ? 1 : 0;
            if (running == 0) continue;
            if (runner_.wait()) --running;
            observer_.onProgress(progress());
        }
    }

    /// Waits until no process writes into the folder of a run. Returns false if the sweep halts before.
    bool awaitFree(const fs::path& run) {
        if (!FolderLock::isTaken(run)) return true;
        observer_.onBusy(run);
        return FolderLock::await(run, [&] { return halts(); });
    }

    /// Returns false if the process of a sweep that was killed has settled it meanwhile, or if the sweep halts.
    bool startBed(const Member& run) {
        const fs::path folder = bedFolder(folder_.path(), {run.number, "", {}});
        createFolder(folder);
        if (!awaitFree(folder)) return false;
        if (isSettled(folder, run.caseText)) return false;
        const bool same = fileContent(folder / "case.toml") == run.caseText;
        if (!same) replaceFile(folder / "case.toml", run.caseText);
        runner_.start({run.number, folder, same && fs::exists(folder / kCheckpointName), true});
        return true;
    }

    /// Puts the member's bed into its folder. Returns false if it has none.
    bool plant(const Member& m) const {
        const auto bed = beds_.find(m.number);
        if (bed == beds_.end()) return false;
        try {
            plantBed(bed->second, folder_.memberFolder(m.number), m);
            return true;
        } catch (const CheckpointError&) {  // somebody has changed it: then the member settles its own
            return false;
        }
    }

    static double share(const Member& m, double time) {
        return m.expectedTime > 0 ? m.expectedWork * std::min(1.0, time / m.expectedTime) : 0;
    }

    void queue() {
        std::vector<WaitingMember> waiting;
        for (const Member& m : members_) {
            const bool waits = isWaiting(m);
            if (folder_.status(m.number) == MemberStatus::Failed && waits) folder_.forget(m.number);
            if (waits)
                waiting.push_back({&m, stepsLeft(m)});
            else
                doneBefore_ += m.expectedWork;
            all_ += m.expectedWork;
        }
        runner_.order(waiting);
        waiting_.assign(waiting.begin(), waiting.end());
    }

    /// Particle-steps that it still has to make by the closed forms.
    double workLeft(const Member& m) const {
        const fs::path run = folder_.memberFolder(m.number);
        const double settled = beds_.contains(m.number) ? m.settlingWork : 0;
        return m.expectedWork - (fs::exists(run / kCheckpointName) ? share(m, timeReached(run)) : settled);
    }
    double stepsLeft(const Member& m) const { return workLeft(m) / double(std::max<std::size_t>(m.particles, 1)); }

    /// A checkpoint that cannot be read is given up only when failed members are to run again. Until then the version
    /// of vkdose that wrote it may still go on from it.
    bool canResume(const Member& m) const {
        const fs::path file = folder_.memberFolder(m.number) / kCheckpointName;
        if (!fs::exists(file)) return false;
        try {
            if (retryFailed_) (void)readCheckpoint(file);
            return true;
        } catch (const CheckpointError& e) {
            observer_.onAnew(m, e.what());
            return false;
        }
    }

    void startNext() {
        const Member& m = *waiting_.front().member;
        waiting_.pop_front();
        if (folder_.status(m.number)) folder_.forget(m.number);
        folder_.begin(m);
        const fs::path run = folder_.memberFolder(m.number);
        if (!awaitFree(run)) return;
        if (isOver(run)) {  // the run ended, and we were killed before we could note it
            note(m, readResult(run, {m.number, 0, ""}));
            return;
        }
        const bool resume = canResume(m) || plant(m);
        const double before = resume ? timeReached(run) : 0;
        doneBefore_ += share(m, before);
        running_[m.number] = {&m, before};
        runner_.start({m.number, run, resume});
    }

    void ended(const MemberEnd& end) {
        const Running& run = running_.at(end.number);
        const Member& m = *run.member;
        // A run that was cut short has done what it reached; the progress must not climb to the whole of it.
        const bool cut = end.code == kInterrupted;
        const double done = cut ? share(m, timeReached(folder_.memberFolder(m.number))) : m.expectedWork;
        doneHere_ += std::max(0.0, done - share(m, run.before));
        running_.erase(end.number);
        note(m, readResult(folder_.memberFolder(m.number), end));
    }

    void note(const Member& m, const MemberResult& result) {
        folder_.add(m, result);
        observer_.onMember(m, result);
    }

    SweepProgress progress() const {
        SweepProgress p;
        p.members = int(members_.size());
        p.running = int(running_.size());
        for (const Member& m : members_) {
            const auto status = folder_.status(m.number);
            p.ok += status == MemberStatus::Ok ? 1 : 0;
            p.failed += status == MemberStatus::Failed ? 1 : 0;
        }
        double here = doneHere_;
        for (const auto& [number, run] : running_)
            here += std::max(
                0.0, share(*run.member, timeReached(folder_.memberFolder(number))) - share(*run.member, run.before));
        p.fraction = all_ > 0 ? (doneBefore_ + here) / all_ : 0;
        p.fractionHere = all_ > 0 ? here / all_ : 0;
        return p;
    }

    SweepFolder& folder_;
    const std::vector<Member>& members_;
    MemberRunner& runner_;
    SweepObserver& observer_;
    const HaltRule& rule_;
    Halt halt_ = Halt::None;
    bool retryFailed_ = false;
    std::map<int, fs::path> beds_;  ///< folders of the settled beds with which members begin
    std::deque<WaitingMember> waiting_;
    std::map<int, Running> running_;
    double all_ = 0, doneBefore_ = 0, doneHere_ = 0;  ///< expected particle-steps
};

}  // namespace

SweepOutcome runMembers(SweepFolder& folder, const std::vector<Member>& members, MemberRunner& runner,
                        SweepObserver& observer, const HaltRule& halt, bool retryFailed) {
    return Sweep(folder, members, runner, observer, halt).run(retryFailed);
}

}  // namespace vkdose
