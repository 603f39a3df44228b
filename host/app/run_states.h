#pragma once
// The states that can be looked at: the frames of a run, or its end if it kept none; or the start of a case.

#include <cstddef>
#include <filesystem>
#include <optional>
#include <vector>

#include "host/model/case.h"
#include "host/output/frames.h"

namespace vkdose {

class RunStates {
  public:
    /// Opens the states of the run in this output folder. Throws UsageError if the folder holds no run, or a run with
    /// neither frames nor an end. Throws OutputError if the stored data cannot be read.
    explicit RunStates(const std::filesystem::path& folder);
    /// The state in which a run of this case would begin. Powder of refills is not in it.
    explicit RunStates(Case c);

    const Case& setup() const { return case_; }
    bool hasFrames() const { return !only_; }
    /// In the order of time. A run without frames has only its end, a case only its start.
    const std::vector<FrameEntry>& entries() const { return entries_; }
    Frame read(std::size_t entry) const;

    /// The entry nearest to a time. Throws UsageError, which says what there is, if the time is before the first entry,
    /// or after the last entry by more than the time between two entries.
    std::size_t at(double time) const;

    std::size_t settled() const { return settledOf(entries_); }

    /// Four states that tell a run's story: settled; the end of the first dose's turning; half of all that came out is
    /// out; the last state with a tenth of the fill left. Fewer where two are the same.
    std::vector<std::size_t> story() const;

  private:
    double massLeft(std::size_t entry) const;

    Case case_;
    std::optional<Frames> frames_;
    std::optional<Frame> only_;  ///< the end or the start
    std::vector<FrameEntry> entries_;
};

}  // namespace vkdose
