#pragma once
// The surface of the powder over a plan, as seen from above.

#include <vector>

#include "host/model/particles.h"

namespace vkdose {

/// Heights over a square lattice of spots of the plan (x, z): of the highest point of any sphere above a spot that is
/// neither dosed nor lost [m, y].
class SurfaceMap {
  public:
    /// The lattice covers all spheres with spots `step` [m] apart; wider where they would be more than a million.
    SurfaceMap(const Particles& particles, double step);

    std::size_t spots() const { return top_.size(); }
    double x(std::size_t spot) const { return lowX_ + (static_cast<double>(spot / rows_) + 0.5) * step_; }
    double z(std::size_t spot) const { return lowZ_ + (static_cast<double>(spot % rows_) + 0.5) * step_; }
    /// -infinity where there is no powder.
    double top(std::size_t spot) const { return top_[spot]; }

  private:
    double lowX_ = 0, lowZ_ = 0, step_ = 1;
    std::size_t rows_ = 1;
    std::vector<double> top_;
};

}  // namespace vkdose
