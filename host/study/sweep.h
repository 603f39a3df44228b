#pragma once
// Runs the members of a study, several at a time, and notes their results as they come. It knows neither processes nor
// devices; these belong to the MemberRunner.

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "host/study/bed.h"
#include "host/study/sweep_folder.h"

namespace vkdose {

struct MemberTask {
    int number = 0;
    std::filesystem::path folder;  ///< of the run; holds its case.toml
    bool resume = false;           ///< from the checkpoint in it
    bool bed = false;              ///< it settles the bed of several members, and keeps that state
};

/// A member that has not ended yet.
struct WaitingMember {
    const Member* member = nullptr;
    double steps = 0;  ///< steps that it still has to make by the closed forms
};

/// Runs members one beside the other.
class MemberRunner {
  public:
    virtual ~MemberRunner() = default;
    /// The number of members that run at once, for people: "2 at a time".
    virtual std::string manner() const = 0;
    /// Puts the members into the order in which it wants to start them. By default that is the order of their numbers.
    virtual void order(std::vector<WaitingMember>& members) { (void)members; }
    /// Whether it runs beds as well. If not, every member settles its own.
    virtual bool settlesBeds() const { return false; }
    /// Whether it can start this member now, beside those that run. Always true if none runs.
    virtual bool takes(const Member& member) const = 0;
    /// Starts a member and returns at once.
    virtual void start(const MemberTask& task) = 0;
    /// A member that has ended, if one ends within a moment (a second or so).
    virtual std::optional<MemberEnd> wait() = 0;
    /// Asks those that run to end soon and to keep what they have. They still have to be waited for.
    virtual void interrupt() = 0;
};

struct SweepProgress {
    int members = 0;
    int ok = 0;
    int failed = 0;
    int running = 0;
    double fraction = 0;      ///< of the expected work of all members
    double fractionHere = 0;  ///< the part of it that this call has done
};

class SweepObserver {
  public:
    virtual ~SweepObserver() = default;
    virtual void onMember(const Member&, const MemberResult&) {}
    virtual void onProgress(const SweepProgress&) {}
    /// Is told before `beds` settle, each once, for `members` members.
    virtual void onBeds(std::size_t beds, std::size_t members) { (void)beds, (void)members; }
    /// Is told when another process, perhaps of a sweep that was killed, still writes into the folder of a member's
    /// run.
    virtual void onBusy(const std::filesystem::path&) {}
    /// Is told why a member's checkpoint cannot be used, so that the member is started anew.
    virtual void onAnew(const Member&, const std::string& why) { (void)why; }
};

/// What ends a sweep before all of its members have ended.
enum class Halt { None, Interrupted, TimeIsUp };
/// Is asked before a member starts, and about once a second while some run.
using HaltRule = std::function<Halt()>;

struct SweepOutcome {
    int members = 0;
    int ok = 0;
    int failed = 0;          ///< those of earlier calls included
    bool whole = false;      ///< every member has ended
    double workLeft = 0;     ///< particle-steps of the others by the closed forms
    Halt halt = Halt::None;  ///< what ended it
};

/// Runs those of `members` that have not ended yet. If the runner can, each bed that several of them have settles once
/// before, in a folder of its own, and they begin with it; a bed that fails leaves its members to themselves. With
/// `retryFailed` it runs failed ones again, and starts a member anew if its checkpoint cannot be used. A member that
/// fails does not keep the others from running. As soon as `halt` says so, none is started any more, and the running
/// ones end so that they can be resumed. Throws OutputError.
SweepOutcome runMembers(SweepFolder& folder, const std::vector<Member>& members, MemberRunner& runner,
                        SweepObserver& observer, const HaltRule& halt, bool retryFailed = false);

}  // namespace vkdose
