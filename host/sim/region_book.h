#pragma once
// How much powder has come into each region of a world.

#include <cstdint>
#include <vector>

#include "host/core/record.h"
#include "host/model/particles.h"
#include "host/model/world.h"
#include "host/sim/region_count.h"

namespace vkdose {

/// Counts each particle once for each region, at the first look that finds its centre there. A dosed particle counts
/// for the region that deleted it, so that these regions together hold what has been dosed.
class RegionBook {
  public:
    explicit RegionBook(const World& world) : world_(world), counts_(world.regions.size()), before_(counts_) {}

    bool empty() const { return counts_.empty(); }
    void look(const Particles& particles);
    const std::vector<RegionCount>& counts() const { return counts_; }

    void openDose() { before_ = counts_; }
    std::vector<RegionCount> sinceDose() const;

    /// For a checkpoint, and back; nothing without regions. Throws RecordError if the record has other regions.
    void save(Record& record) const;
    void restore(const Record& record);

  private:
    const World& world_;
    std::vector<RegionCount> counts_, before_;  ///< of each region; at the start of the dose
    std::vector<std::uint32_t> seen_;           ///< of each particle: a bit for each region that it has been in
};

}  // namespace vkdose
