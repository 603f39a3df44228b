#pragma once
// Triangles in the cells of a box, to find those near a segment.

#include <vector>

#include "geometry/mesh_file.h"

namespace vkdose {

class Cells {
  public:
    /// `mesh` must outlive this object.
    explicit Cells(const std::vector<geometry::Triangle>& mesh);

    /// Whether the segment passes a triangle, and goes on at both ends for more than `least` [m] from its plane.
    bool passedBy(const Vec3& a, const Vec3& b, double least = 0) const;

    /// Whether no triangle is in the way from `a` to `b`, nor `aside` [m] of it to either side, up and down.
    bool isOpen(const Vec3& a, const Vec3& b, double aside) const;

    const Vec3& low() const { return low_; }
    const Vec3& high() const { return high_; }

  private:
    static constexpr int kSide = 24;

    int cell(double x, int axis) const;
    template <class Visit>
    void forEachCell(const Vec3& low, const Vec3& high, const Visit& visit) const;

    const std::vector<geometry::Triangle>& mesh_;
    Vec3 low_{1e300}, high_{-1e300};
    Vec3 perLength_{0};  ///< cells for each metre along the axes
    std::vector<std::vector<std::size_t>> cells_;
};

}  // namespace vkdose
