#pragma once
// How far a run is, on stderr: a bar that redraws itself on a terminal, plain lines otherwise.

#include <chrono>
#include <cstdio>
#include <set>

#include "host/sim/runner.h"

namespace vkdose {

/// Shows a run while it goes on.
class RunDisplay : public RunObserver {
  public:
    /// Ends what is on the terminal, so that other text can follow.
    virtual void close() = 0;
};

class ProgressDisplay : public RunDisplay {
  public:
    explicit ProgressDisplay(std::FILE* stream = stderr);
    ~ProgressDisplay() override;
    ProgressDisplay(const ProgressDisplay&) = delete;
    ProgressDisplay& operator=(const ProgressDisplay&) = delete;

    void onProgress(const Progress& progress) override;
    void onSettled(const Settling& settling, const Case& c) override;
    void onDose(const Dose& dose) override;
    void onRefill(const AddedPowder& powder) override;

    void close() final;

  private:
    using Clock = std::chrono::steady_clock;
    void say(const std::string& text);

    std::FILE* stream_;
    bool terminal_;
    bool open_ = false;             ///< a bar stands on the current line
    std::set<std::size_t> inlets_;  ///< tables of many refills of which one was told
    Clock::time_point last_;
};

/// The text of one progress line without bar: "dose 3 rotate, t = 6.2 s, 41 %, 8.1 M particle-steps/s, ETA 12 min 05
/// s".
std::string progressText(const Progress& progress);

}  // namespace vkdose
