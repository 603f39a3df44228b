#pragma once
// The states of a run that can be looked at: its frames, or its end if it kept none.

#include <cstddef>
#include <filesystem>
#include <optional>
#include <vector>

#include "host/model/case.h"
#include "host/output/frames.h"

namespace vkdose {

class RunStates {
  public:
    /// Of the run whose output folder this is. Throws UsageError if it holds no run, or one with neither frames nor an
    /// end, OutputError if what is there cannot be read.
    explicit RunStates(const std::filesystem::path& folder);

    const Case& setup() const { return case_; }
    bool hasFrames() const { return !frames_.entries().empty(); }
    /// In the order of time; of a run without frames its end alone.
    const std::vector<FrameEntry>& entries() const { return entries_; }
    Frame read(std::size_t entry) const;

    /// The entry nearest to a time. Throws UsageError, which says what there is, if it is before the first or after the
    /// last by more than the time between two.
    std::size_t at(double time) const;

    std::size_t settled() const { return settledOf(entries_); }

    /// Four that tell a run's story: settled, the end of the first dose's turning, half of what came out is out, and
    /// the last with a tenth of the fill left. Fewer where two are the same.
    std::vector<std::size_t> story() const;

  private:
    double massLeft(std::size_t entry) const;

    Case case_;
    Frames frames_;
    std::optional<Frame> end_;
    std::vector<FrameEntry> entries_;
};

}  // namespace vkdose
