#pragma once
// Corners that are one vertex.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <unordered_map>
#include <vector>

#include "host/core/vec.h"

namespace vkdose::geometry {

/// Makes points that are closer to each other than the tolerance one: the first that was met.
class Welder {
  public:
    explicit Welder(double tolerance) : tolerance_(tolerance) {}

    std::uint32_t add(const Vec3& p) {
        const Cell c{std::floor(p.x / tolerance_), std::floor(p.y / tolerance_), std::floor(p.z / tolerance_)};
        std::uint32_t best = kNone;
        for (int n = 0; n < 27; ++n) {
            const auto found = cells_.find({c[0] + n % 3 - 1, c[1] + n / 3 % 3 - 1, c[2] + n / 9 - 1});
            if (found == cells_.end()) continue;
            for (const std::uint32_t v : found->second)
                if (glm::length(vertices_[v] - p) <= tolerance_) best = std::min(best, v);
        }
        if (best != kNone) return best;
        vertices_.push_back(p);
        cells_[c].push_back(static_cast<std::uint32_t>(vertices_.size() - 1));
        return static_cast<std::uint32_t>(vertices_.size() - 1);
    }
    std::vector<Vec3> take() { return std::move(vertices_); }

  private:
    static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
    using Cell = std::array<double, 3>;
    struct CellHash {
        std::size_t operator()(const Cell& c) const {
            std::size_t hash = 0;
            for (const double x : c) hash = hash * 1000003U ^ std::hash<double>()(x == 0 ? 0 : x);
            return hash;
        }
    };
    double tolerance_;
    std::vector<Vec3> vertices_;
    std::unordered_map<Cell, std::vector<std::uint32_t>, CellHash> cells_;
};

}  // namespace vkdose::geometry
