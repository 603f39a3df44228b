#pragma once
// The pairs that may touch: a list with a skin. It is valid until some particle has moved half the skin.

#include <cstdint>
#include <vector>

#include "host/model/particles.h"

namespace vkdose::reference {

class Neighbours {
  public:
    /// Forgets everything. The next `update` builds the list, and the count of builds goes on from `builds`. `skin`
    /// and `reach`, how far beyond touch a contact may hold, in metres. `period`: World::period, longer than twice the
    /// reach of a pair.
    void reset(double skin, double reach, std::uint64_t builds = 0, const Vec3& period = Vec3(0));

    /// Builds the list if a particle has moved more than half the skin since the last build, and at the first call.
    void update(const Particles& particles);

    /// Makes the list as it was built last, so that the next build falls where it would have. `anchors` are the
    /// positions of that build, empty if the next `update` is to build it.
    void restore(const Particles& particles, const std::vector<Vec3>& anchors, std::uint64_t builds);

    /// Positions at the last build; empty after `reset`.
    const std::vector<Vec3>& anchors() const { return anchors_; }

    /// Indices j > i, ascending, of the particles closer to i than a_i + a_j + reach + skin at the last build, by the
    /// nearest image.
    const std::vector<std::uint32_t>& after(std::size_t i) const { return rows_[i]; }

    std::uint64_t builds() const { return builds_; }

  private:
    bool stale(const Particles& particles) const;
    void build(const Particles& particles);

    double skin_ = 0, reach_ = 0;
    Vec3 period_{0};
    std::uint64_t builds_ = 0;
    std::vector<Vec3> anchors_;  ///< positions at the last build
    std::vector<std::vector<std::uint32_t>> rows_;
};

}  // namespace vkdose::reference
