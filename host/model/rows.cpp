// Whether the neighbours that each particle has at the start fit a row of the neighbour list.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <vector>

#include "host/model/checks.h"
#include "host/model/rows.h"

namespace vkdose {
namespace {

/// Sorts the particles into cubic cells. Every particle within one edge length of a point lies in the 27 cells around
/// that point.
class Cells {
  public:
    Cells(const Particles& particles, double edge) : edge_(edge) {
        for (std::size_t i = 0; i < particles.size(); ++i) cells_[cellOf(particles.position[i])].push_back(i);
    }

    /// Calls `visit(j)` for every particle in the cells around `x`, until it returns false.
    template <class Visit>
    void around(const Vec3& x, Visit visit) const {
        const Cell home = cellOf(x);
        for (int n = 0; n < 27; ++n) {
            const auto found = cells_.find({home[0] + n % 3 - 1, home[1] + n / 3 % 3 - 1, home[2] + n / 9 - 1});
            if (found == cells_.end()) continue;
            for (const std::size_t j : found->second)
                if (!visit(j)) return;
        }
    }

  private:
    using Cell = std::array<double, 3>;  // whole numbers, of any size
    Cell cellOf(const Vec3& x) const {
        return {std::floor(x.x / edge_), std::floor(x.y / edge_), std::floor(x.z / edge_)};
    }
    double edge_;
    std::map<Cell, std::vector<std::size_t>> cells_;
};

/// A particle with more neighbours than a row holds, if there is one.
/// `beyond` is the skin and the reach of contacts.
std::optional<std::size_t> crowdedParticle(const Particles& p, double largest, double beyond) {
    // The device computes in single precision, so that a particle just beyond the edge may count as a neighbour there.
    constexpr double kRounding = 1 + 1e-5;
    const Cells cells(p, (2 * largest + beyond) * kRounding);
    for (std::size_t i = 0; i < p.size(); ++i) {
        int neighbours = -1;  // itself does not count
        cells.around(p.position[i], [&](std::size_t j) {
            const double reach = (p.radius[i] + p.radius[j] + beyond) * kRounding;
            if (glm::distance(p.position[i], p.position[j]) < reach) ++neighbours;
            return neighbours <= kMaxNeighbours;
        });
        if (neighbours > kMaxNeighbours) return i;
    }
    return std::nullopt;
}

/// Most particles of the grid, of any sizes, that can be within reach of one. The sites are so far apart that spheres
/// of the largest radius do not overlap, and no packing of equal spheres fills more than 0.7405 of its space.
double mostInGrid(double largest, double skin) {
    return 0.7405 * std::pow((3 * largest + skin) / largest, 3) - 1;
}

}  // namespace

void checkRows(CaseReader& reader, const Case& c, const Particles& particles, const SizeRange& radii) {
    if (particles.size() <= kMaxNeighbours) return;
    const double reach = longestReach(c.world, c.dosingLaw, radii.largest), beyond = c.world.skin + reach;
    if (!c.filling.list && mostInGrid(radii.largest, beyond) <= kMaxNeighbours) return;
    const std::optional<std::size_t> crowded = crowdedParticle(particles, radii.largest, beyond);
    if (!crowded) return;
    const Vec3 x = particles.position[*crowded] * 1e3;
    const double usual = kUsualSkin * radii.mean;
    const bool helps = usual < c.world.skin && !crowdedParticle(particles, radii.largest, usual + reach);
    reader.fault(
        "time.skin_mm",
        fmt::format("gives particle {} at ({:.4g}, {:.4g}, {:.4g}) mm more neighbours at the start than the {} "
                    "that a row of the list holds",
                    *crowded, x.x, x.y, x.z, kMaxNeighbours),
        helps ? fmt::format("give about {:.3g}, {} of the mean radius, or leave the key out", usual * 1e3, kUsualSkin)
              : "use a narrower range of sizes, and particles that do not overlap");
}

}  // namespace vkdose
