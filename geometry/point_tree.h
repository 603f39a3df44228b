#pragma once
// Finds points near a segment.

#include <algorithm>
#include <cstdint>
#include <vector>

#include "host/core/vec.h"

namespace vkdose::geometry {

/// A tree of boxes, halved at the median, so that no arrangement of points makes it slow. The points must outlive it.
class PointTree {
  public:
    PointTree(const std::vector<Vec3>& points, std::vector<std::uint32_t> chosen)
        : points_(points), order_(std::move(chosen)) {
        if (!order_.empty()) build(0, order_.size());
    }

    /// Calls `visit` for every point that may lie within `reach` of the segment from a to b.
    template <class Visit>
    void near(const Vec3& a, const Vec3& b, double reach, const Visit& visit) const {
        if (!nodes_.empty()) descend(0, glm::min(a, b) - reach, glm::max(a, b) + reach, a, b, reach, visit);
    }

  private:
    struct Node {
        Vec3 low, high;
        std::size_t begin, end;
        std::size_t right = 0;  ///< 0 at a leaf; the left child follows its parent
    };
    static constexpr std::size_t kLeaf = 8;

    void build(std::size_t begin, std::size_t end) {
        const std::size_t me = nodes_.size();
        nodes_.push_back({points_[order_[begin]], points_[order_[begin]], begin, end});
        for (std::size_t i = begin; i < end; ++i) {
            nodes_[me].low = glm::min(nodes_[me].low, points_[order_[i]]);
            nodes_[me].high = glm::max(nodes_[me].high, points_[order_[i]]);
        }
        if (end - begin <= kLeaf) return;
        const Vec3 size = nodes_[me].high - nodes_[me].low;
        const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
        const std::size_t middle = begin + (end - begin) / 2;
        std::nth_element(order_.begin() + std::ptrdiff_t(begin), order_.begin() + std::ptrdiff_t(middle),
                         order_.begin() + std::ptrdiff_t(end),
                         [&](std::uint32_t i, std::uint32_t j) { return points_[i][axis] < points_[j][axis]; });
        build(begin, middle);
        nodes_[me].right = nodes_.size();
        build(middle, end);
    }

    /// Whether the segment passes the box, widened by `reach` (by slabs).
    static bool passes(const Node& n, const Vec3& a, const Vec3& b, double reach) {
        double from = 0, to = 1;
        for (int d = 0; d < 3; ++d) {
            const double way = b[d] - a[d], low = n.low[d] - reach - a[d], high = n.high[d] + reach - a[d];
            if (way == 0) {
                if (low > 0 || high < 0) return false;
                continue;
            }
            from = std::max(from, std::min(low / way, high / way));
            to = std::min(to, std::max(low / way, high / way));
        }
        return from <= to + 1e-9;
    }

    template <class Visit>
    void descend(std::size_t me, const Vec3& low, const Vec3& high, const Vec3& a, const Vec3& b, double reach,
                 const Visit& visit) const {
        const Node& n = nodes_[me];
        if (!passes(n, a, b, reach)) return;
        if (n.right == 0) {
            for (std::size_t i = n.begin; i < n.end; ++i) visit(order_[i]);
            return;
        }
        descend(me + 1, low, high, a, b, reach, visit);
        descend(n.right, low, high, a, b, reach, visit);
    }

    const std::vector<Vec3>& points_;
    std::vector<std::uint32_t> order_;
    std::vector<Node> nodes_;
};

}  // namespace vkdose::geometry
