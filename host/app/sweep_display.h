#pragma once
// The messages of a sweep: a line for every member that ends, and how far the whole study is.

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "host/app/commands.h"
#include "host/app/speed.h"
#include "host/study/sweep.h"

namespace vkdose {

/// How long a sweep will still take, by the pace of its members. The settling of beds before them does not count: its
/// work is no part of the progress.
class SweepPace {
  public:
    using Clock = std::chrono::steady_clock;
    /// Seconds from `now` to the end; negative while no member has done any work.
    double secondsLeft(const SweepProgress& progress, Clock::time_point now);

  private:
    std::optional<Clock::time_point> began_;  ///< when the first member was seen to run
};

class SweepDisplay : public SweepObserver {
  public:
    /// `command`: the command that goes on with the sweep. `quiet`: prints only what went wrong.
    SweepDisplay(std::string command, const Study& study, bool quiet);
    ~SweepDisplay() override;
    SweepDisplay(const SweepDisplay&) = delete;
    SweepDisplay& operator=(const SweepDisplay&) = delete;

    /// `manner`: of the runner.
    void begin(const std::vector<Member>& members, const std::string& manner);
    /// Is told before a calibration runs a point again, `runs` times with new seeds.
    void confirm(const std::string& place, std::size_t runs);
    void onMember(const Member& member, const MemberResult& result) override;
    void onProgress(const SweepProgress& progress) override;
    void onBeds(std::size_t beds, std::size_t members) override;
    void onBusy(const std::filesystem::path& folder) override;
    void onAnew(const Member& member, const std::string& why) override;
    /// How it ended, and how to go on.
    void finish(const SweepFolder& folder, const SweepOutcome& outcome, const SweepOptions& options);

  private:
    void close();
    /// The command that goes on with the sweep.
    std::string again(const SweepFolder& folder, const SweepOptions& options) const;

    std::string command_;
    const Study& study_;
    bool quiet_;
    bool terminal_;
    bool open_ = false;  ///< the progress stands on the current line
    SweepPace pace_;
    SweepPace::Clock::time_point last_ = SweepPace::Clock::now();  ///< of the last line of progress
};

/// "contact.friction 0.5, seed 2"
std::string memberText(const Study& study, const Member& member);

/// Members of a calibration that are not known before the first ones have ended.
struct LaterMembers {
    std::size_t most = 0;  ///< their number at most
    double work = 0;       ///< particle-steps at most, by the closed forms
    double longest = 0;    ///< of one of them
    int atOnce = 1;        ///< of them that may run at a time
    std::string what;      ///< "for 27 more points and confirming runs"
};

/// A line for every member, and what they come to with `atOnce` of them at a time.
std::string membersText(const Study& study, const std::vector<Member>& members, const LaterMembers& later,
                        const Speed& speed, int atOnce);

}  // namespace vkdose
