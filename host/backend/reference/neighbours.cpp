#include "host/backend/reference/neighbours.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "host/model/world.h"

namespace vkdose::reference {

namespace {

/// A regular grid over the active particles, with cells no smaller than the longest reach of a pair.
class CellGrid {
  public:
    CellGrid(const Particles& particles, double beyond) {
        Vec3 low(std::numeric_limits<double>::infinity()), high(-std::numeric_limits<double>::infinity());
        double largest = 0;
        for (std::size_t i = 0; i < particles.size(); ++i) {
            if (particles.status[i] != Status::Active) continue;
            low = glm::min(low, particles.position[i]);
            high = glm::max(high, particles.position[i]);
            largest = std::max(largest, particles.radius[i]);
        }
        low_ = low;
        high_ = high;
        const double reach = reach_ = 2 * largest + beyond;
        for (int d = 0; d < 3; ++d) {
            constexpr double kMaxCells = 64;  // per axis: bounds the memory when a few particles are far apart
            const double cells = std::floor((high[d] - low[d]) / reach);
            count_[d] = cells >= 1 ? static_cast<int>(std::min(cells, kMaxCells)) : 1;
            // The cells are slightly wider than the extent needs, so that rounding cannot put a pair two cells apart.
            edge_[d] = std::max(reach, (high[d] - low[d]) / count_[d]) * (1 + 1e-9);
        }
        cells_.resize(static_cast<std::size_t>(count_[0]) * count_[1] * count_[2]);
        for (std::size_t i = 0; i < particles.size(); ++i)
            if (particles.status[i] == Status::Active) cells_[index(cellOf(particles.position[i]))].push_back(i);
    }

    /// Calls `visit(j)` for every particle in the 27 cells around `x`, if `x` is in reach of any particle.
    template <class Visit>
    void around(const Vec3& x, Visit visit) const {
        if (glm::any(glm::lessThan(x, low_ - reach_)) || glm::any(glm::greaterThan(x, high_ + reach_))) return;
        const std::array<int, 3> home = cellOf(x);
        const auto low = [&](int d) { return std::max(home[d] - 1, 0); };
        const auto high = [&](int d) { return std::min(home[d] + 1, count_[d] - 1); };
        for (int cx = low(0); cx <= high(0); ++cx)
            for (int cy = low(1); cy <= high(1); ++cy)
                for (int cz = low(2); cz <= high(2); ++cz)
                    for (const std::size_t j : cells_[index({cx, cy, cz})]) visit(j);
    }

  private:
    std::array<int, 3> cellOf(const Vec3& x) const {
        std::array<int, 3> cell{};
        for (int d = 0; d < 3; ++d)
            cell[d] = std::clamp(static_cast<int>(std::floor((x[d] - low_[d]) / edge_[d])), 0, count_[d] - 1);
        return cell;
    }
    std::size_t index(const std::array<int, 3>& cell) const {
        return (static_cast<std::size_t>(cell[0]) * count_[1] + cell[1]) * count_[2] + cell[2];
    }

    double reach_ = 0;
    Vec3 low_{0}, high_{0};
    Vec3 edge_{1};
    std::array<int, 3> count_{};
    std::vector<std::vector<std::size_t>> cells_;
};

}  // namespace

void Neighbours::reset(double skin, double reach, std::uint64_t builds, const Vec3& period) {
    skin_ = skin;
    reach_ = reach;
    period_ = period;
    builds_ = builds;
    anchors_.clear();
    rows_.clear();
}

void Neighbours::update(const Particles& particles) {
    if (stale(particles)) build(particles);
}

void Neighbours::restore(const Particles& particles, const std::vector<Vec3>& anchors, std::uint64_t builds) {
    if (!anchors.empty()) {
        Particles then = particles;
        then.position = anchors;
        build(then);
    }
    builds_ = builds;
}

bool Neighbours::stale(const Particles& particles) const {
    if (anchors_.size() != particles.size()) return true;
    const double allowed = skin_ / 2;
    for (std::size_t i = 0; i < particles.size(); ++i) {
        const Vec3 moved = shortest(particles.position[i] - anchors_[i], period_);
        if (particles.status[i] == Status::Active && glm::dot(moved, moved) > allowed * allowed) return true;
    }
    return false;
}

void Neighbours::build(const Particles& particles) {
    anchors_ = particles.position;
    rows_.resize(particles.size());
    ++builds_;
    const double beyond = skin_ + reach_;
    const CellGrid grid(particles, beyond);
    std::vector<Vec3> images = imageShifts(period_);
    images.emplace_back(0);  // the place itself
    for (std::size_t i = 0; i < particles.size(); ++i) {
        rows_[i].clear();
        if (particles.status[i] != Status::Active) continue;
        for (const Vec3& image : images) {
            const Vec3 at = particles.position[i] + image;
            grid.around(at, [&](std::size_t j) {
                const Vec3 apart = at - particles.position[j];
                const double reach = particles.radius[i] + particles.radius[j] + beyond;
                if (j > i && glm::dot(apart, apart) < reach * reach) rows_[i].push_back(static_cast<std::uint32_t>(j));
            });
        }
        std::sort(rows_[i].begin(), rows_[i].end());
    }
}

}  // namespace vkdose::reference
