#pragma once
// How much powder has come into each region of a world, and how much is in it.

#include <cstdint>
#include <vector>

#include "host/core/record.h"
#include "host/model/particles.h"
#include "host/model/world.h"
#include "host/sim/body_room.h"
#include "host/sim/region_count.h"

namespace vkdose {

/// Counts each particle once for each region, at the first look that finds its centre there. A dosed particle counts
/// for the region that deleted it, so that these regions together hold what has been dosed.
class RegionBook {
  public:
    explicit RegionBook(const World& world);

    bool empty() const { return samples_.empty(); }
    /// `poses`: of the world's bodies now.
    void look(const Particles& particles, const BodyPoses& poses);
    /// Of each region at the last look.
    const std::vector<RegionSample>& samples() const { return samples_; }

    void openDose();
    std::vector<RegionCount> sinceDose() const;

    /// For a checkpoint, and back. Without regions they do nothing. Throws RecordError if the record has other regions.
    void save(Record& record) const;
    void restore(const Record& record);

  private:
    const World& world_;
    BodyPoses starts_;                   ///< of the bodies
    std::vector<RegionSample> samples_;  ///< of each region
    std::vector<RegionCount> before_;    ///< what had come into each at the start of the dose
    std::vector<std::uint32_t> seen_;    ///< of each particle: a bit for each region that it has been in
};

}  // namespace vkdose
