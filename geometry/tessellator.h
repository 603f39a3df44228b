#pragma once
// The triangles of one shape, as it gives them to `tessellated` (shape.h).

#include <vector>

#include "geometry/mesh_file.h"

namespace vkdose::geometry {

/// Whether straight lines on a curved shape are cut as well.
enum class StraightLines { Cut, Whole };

/// Collects the triangles.
class Tessellator {
  public:
    using Corners = std::vector<Vec3>;

    /// Sides of about `facet` [m]; what is endless is cut off at the box from `low` to `high` [m].
    Tessellator(double facet, const Vec3& low, const Vec3& high, StraightLines straight)
        : facet_(facet), low_(low), high_(high), straight_(straight) {}

    const Vec3& low() const { return low_; }
    const Vec3& high() const { return high_; }
    /// In how many pieces a curve of that length is cut, at least `least`.
    int pieces(double length, int least) const;
    /// The same of a straight line on the shape.
    int straightPieces(double length) const;

    /// A triangle seen from outside, unless two of its corners are one.
    void put(const Vec3& a, const Vec3& b, const Vec3& c);
    void putAll(const std::vector<Triangle>& triangles);
    /// Joins two closed rings of as many corners; `outwards` tells which way round.
    void strip(const Corners& a, const Corners& b, bool outwards);
    /// Joins each ring to the next.
    void strips(const std::vector<Corners>& rings, bool outwards);
    /// Turns all triangles over, so that they are seen from the other side.
    void turnOver();

    std::vector<Triangle> take() { return std::move(mesh_); }

  private:
    double facet_;
    Vec3 low_, high_;
    StraightLines straight_;
    std::vector<Triangle> mesh_;
};

}  // namespace vkdose::geometry
