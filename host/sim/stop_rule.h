#pragma once
// When a run is over: the paper's rules on the dosed mass, a number of doses, an end time, an empty canister.

#include <cstdint>
#include <deque>
#include <string>

#include "host/core/record.h"
#include "host/model/case.h"

namespace vkdose {

/// The reason why a run ended.
enum class StopReason {
    Settled,      ///< the case asks for no doses
    Experiment,   ///< the cumulative mass changed by no more than the threshold over the last doses
    Simulation,   ///< nothing was dosed over the last doses
    Empty,        ///< neither canister nor throat holds a particle
    Doses,        ///< the number of doses asked for
    EndTime,      ///< the simulated time asked for
    Torque,       ///< the drive's torque was too large, and the case says that this ends the run
    Interrupted,  ///< by the user
    RunError,
    DeviceError,
    OutputError,
};

/// One word for files: "experiment_rule", "empty", ...
std::string stopKeyword(StopReason reason);

/// One sentence for people, with the figures of the rule.
std::string stopSentence(StopReason reason, const StopRule& rule);

/// Judges the rules that look at doses. (The end time is the timeline's.)
class DoseJudge {
  public:
    explicit DoseJudge(const StopRule& rule) : rule_(rule) {}

    /// Tells the judge about a complete dose: its mass [kg], its particles, and how many are left to dose.
    /// Returns true when the run is over; `reason()` then says why.
    ///
    /// A dose without a single particle counts as exactly zero, whatever rounding left in the difference of sums.
    /// Paper: an experiment is complete when three consecutive doses together give no more than 0.15 g; a simulation
    /// when the cumulative mass does not change for three consecutive doses.
    ///
    /// Both rules count from the first dose that gives powder: a device fills before it delivers. If nothing ever
    /// comes, the number of doses or the end time ends the run. A run with neither ends after kPatience times as many
    /// doses as the rule looks at.
    bool over(double mass, std::uint64_t particles, std::uint64_t left);

    /// Whether the run is over as it stands; then `reason()` says why.
    bool ends(std::uint64_t left);

    static constexpr int kPatience = 10;

    StopReason reason() const { return reason_; }

    void save(Record& record) const;
    void restore(const Record& record);

  private:
    bool empty() const;

    StopRule rule_;
    std::deque<double> recent_;  ///< masses of the last doses, from the first on that gave powder [kg]
    int doses_ = 0;
    StopReason reason_ = StopReason::Doses;
};

}  // namespace vkdose
