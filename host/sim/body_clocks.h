#pragma once
// The clocks of the bodies that move in phases of the schedule (RigidBody::phases), through a run.

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "host/core/record.h"
#include "host/model/world.h"

namespace vkdose {

class BodyClocks {
  public:
    explicit BodyClocks(const World& world);

    /// Whether a body of the world moves in phases.
    bool any() const { return !clocks_.empty(); }

    /// Says in which phase and dose the next steps are made. A phase that goes on changes nothing.
    void enter(Phase phase, int dose);
    void count(std::uint64_t steps) { advanceClocks(clocks_, steps); }

    /// Of all bodies in their order. Empty if no body moves in phases.
    const std::vector<BodyClock>& now() const { return clocks_; }
    /// The same in time [s].
    std::vector<double> times() const;

    /// For a checkpoint, and back. A record without clocks leaves them at 0. Throws RecordError if the record has other
    /// bodies.
    void save(Record& record) const;
    void restore(const Record& record);
    /// Those of another run with the same bodies, whose time step was `ratio` times that of this one. Its phases are
    /// none of this run.
    void takeOver(const Record& record, double ratio);

  private:
    const World& world_;
    std::vector<BodyClock> clocks_;
    std::optional<std::pair<Phase, int>> within_;  ///< phase and dose
};

}  // namespace vkdose
