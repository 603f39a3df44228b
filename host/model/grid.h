#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "host/core/vec.h"
#include "host/model/world.h"

namespace vkdose {

/// Play between the largest spheres of the insertion grid, as a fraction of their diameter, unless the case says more.
inline constexpr double kGridGap = 0.02;

/// Regular grid that fills a box layer by layer from below. The sites are at least 2 r_max (1 + gap) apart and
/// half of that away from the sides. No two spheres then overlap, for any jitter.
class InsertionGrid {
  public:
    InsertionGrid(const Box& region, double largestRadius, double gap);
    /// Only these sites, which are ascending numbers of the grid's own.
    InsertionGrid(InsertionGrid whole, std::shared_ptr<const std::vector<std::uint64_t>> sites);

    Vec3 site(std::uint64_t index) const;  ///< index < capacity()
    double capacity() const;               ///< number of sites, 0 if the region is too narrow
    double pitch() const { return pitch_; }
    /// The sites beside one of a whole grid, along each axis.
    std::vector<std::uint64_t> beside(std::uint64_t index) const;
    double jitterAmplitude() const;  ///< per coordinate [m]

    /// Height of the top of the first `count` sites [m, y]. It is as far above the highest of them as the sides of the
    /// box are from the sites beside them, so that a lid there touches no particle in spite of rounding.
    double top(std::uint64_t count) const;

  private:
    double gap_;
    double pitch_;
    Vec3 low_;
    Vec3 high_;
    std::uint64_t columns_ = 0;
    std::uint64_t rows_ = 0;
    double layers_ = 0;
    std::shared_ptr<const std::vector<std::uint64_t>> sites_;  ///< null: all
};

/// By how much the sphere of a draw stands off its site, in each coordinate at most `amplitude` [m], so that a bed does
/// not start out as a crystal.
Vec3 jitter(std::uint64_t seed, std::uint64_t draw, double amplitude);

}  // namespace vkdose
