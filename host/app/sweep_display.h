#pragma once
// The messages of a sweep: a line for every member that ends, and how far the whole study is.

#include <chrono>
#include <optional>
#include <string>
#include <vector>

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
    void onMember(const Member& member, const MemberResult& result) override;
    void onProgress(const SweepProgress& progress) override;
    void onBeds(std::size_t beds, std::size_t members) override;
    void onBusy(const std::filesystem::path& folder) override;
    void onAnew(const Member& member, const std::string& why) override;
    /// How it ended, and how to go on.
    void finish(const SweepFolder& folder, const SweepOutcome& outcome);

  private:
    void close();

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

/// A line for every member, and what they come to with `atOnce` of them at a time.
std::string membersText(const Study& study, const std::vector<Member>& members, const Speed& speed, int atOnce);

}  // namespace vkdose
