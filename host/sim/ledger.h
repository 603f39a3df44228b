#pragma once
// The mass ledger: all powder that was filled in is in the canister, in the throat or dosed, and nothing is lost.

#include <cstdint>

#include "host/backend/backend.h"

namespace vkdose {

/// Masses are sums in single precision on a device. Rounding may lose up to this part of the filled mass.
inline constexpr double kLedgerTolerance = 1e-6;

class Ledger {
  public:
    /// Number of the particles that were filled in at the start, and their mass [kg].
    Ledger(std::uint64_t count, double mass) : count_(count), mass_(mass) {}

    /// More powder was added: `count` particles of `mass` [kg].
    void add(std::uint64_t count, double mass) {
        count_ += count;
        mass_ += mass;
    }

    /// Closes the ledger at simulated time `time` [s]. Throws RunError if a particle is lost, if the counts of the
    /// four regions do not add up to the filled one exactly, if the masses do not to 1e-6 of the filled mass, if a
    /// mass is not a number or negative, or if fewer particles are dosed than before.
    void close(const Sensors& sensors, double time);

    void save(Record& record) const;
    void restore(const Record& record);

    // Powder that was added is among it.
    std::uint64_t filledCount() const { return count_; }
    double filledMass() const { return mass_; }

    /// Largest |sum of masses - filled| / filled of all closings so far.
    double worstMassError() const { return worst_; }
    std::uint64_t closings() const { return closings_; }

  private:
    std::uint64_t count_;
    double mass_;
    double worst_ = 0;
    std::uint64_t closings_ = 0;
    std::uint64_t dosedBefore_ = 0;
};

}  // namespace vkdose
