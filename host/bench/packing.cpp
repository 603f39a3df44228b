#include "host/bench/packing.h"

#include <algorithm>
#include <cmath>

#include "host/core/random.h"

namespace vkdose::bench {

namespace {

constexpr int kSide = 15;                 // lattice sites along an edge of the tile
constexpr double kVolumeFraction = 0.66;  // random close packing of this size range is at about 0.65
constexpr int kRounds = 400;              // of pushing apart; the tests say what overlaps are left
constexpr double kShare = 0.3;            // of an overlap, taken by each of the two: more rings, less creeps

/// Spheres sorted into cubes at least as wide as the largest sphere, of a periodic box.
class Grid {
  public:
    Grid(double edge, double reach) : cells_(int(edge / reach)), width_(edge / cells_) {}

    void sort(const std::vector<Vec3>& x) {
        members_.assign(std::size_t(cells_) * cells_ * cells_, {});
        for (std::size_t i = 0; i < x.size(); ++i) members_[cell(x[i].x, x[i].y, x[i].z)].push_back(i);
    }

    /// Calls `visit(j)` for every sphere j > i in the 27 cells around x.
    template <class Visit>
    void around(const Vec3& x, std::size_t i, const Visit& visit) const {
        for (int a = -1; a <= 1; ++a)
            for (int b = -1; b <= 1; ++b)
                for (int c = -1; c <= 1; ++c)
                    for (std::size_t j : members_[cell(x.x + a * width_, x.y + b * width_, x.z + c * width_)])
                        if (j > i) visit(j);
    }

  private:
    std::size_t cell(double x, double y, double z) const {
        const auto wrapped = [&](double v) { return std::size_t((int(std::floor(v / width_)) + cells_) % cells_); };
        return (wrapped(x) * cells_ + wrapped(y)) * cells_ + wrapped(z);
    }

    int cells_;
    double width_;
    std::vector<std::vector<std::size_t>> members_;
};

void pushApart(Particles& p, double edge) {
    std::vector<Vec3>& x = p.position;
    std::vector<Vec3> push(x.size());
    Grid grid(edge, 2 * kRadiusMax);
    for (int round = 0; round < kRounds; ++round) {
        grid.sort(x);
        std::fill(push.begin(), push.end(), Vec3(0));
        for (std::size_t i = 0; i < x.size(); ++i)
            grid.around(x[i], i, [&](std::size_t j) {
                const Vec3 apart = x[i] - x[j];
                const Vec3 d = apart - edge * glm::round(apart / edge);
                const double reach = p.radius[i] + p.radius[j], square = glm::dot(d, d);
                if (square >= reach * reach || square == 0) return;
                const double distance = std::sqrt(square);
                const Vec3 shift = kShare * (reach - distance) / distance * d;
                push[i] += shift;
                push[j] -= shift;
            });
        for (std::size_t i = 0; i < x.size(); ++i) {
            x[i] += push[i];
            x[i] -= edge * glm::floor(x[i] / edge);
        }
    }
}

}  // namespace

Packing relaxedTile(std::uint64_t seed) {
    const std::size_t n = std::size_t(kSide) * kSide * kSide;
    std::vector<double> radius(n);
    double volume = 0;
    for (std::size_t i = 0; i < n; ++i) {
        radius[i] = kRadiusMin + (kRadiusMax - kRadiusMin) * uniforms(seed, Stream::Radius, i)[0];
        volume += 4.0 / 3.0 * kPi * radius[i] * radius[i] * radius[i];
    }
    const double edge = std::cbrt(volume / kVolumeFraction), site = edge / kSide;
    Packing tile;
    tile.size = Vec3(edge);
    for (std::size_t i = 0; i < n; ++i) {
        const auto a = uniforms(seed, Stream::Jitter, i), b = uniforms(seed, Stream::Jitter, i, 1);
        const Vec3 corner(double(i % kSide), double(i / kSide % kSide), double(i / kSide / kSide));
        tile.particles.add(site * (corner + Vec3(a[0], a[1], b[0])), radius[i]);
    }
    pushApart(tile.particles, edge);
    return tile;
}

Packing tiled(const Packing& tile, int nx, int ny, int nz) {
    Packing all;
    all.size = tile.size * Vec3(nx, ny, nz);
    for (int a = 0; a < nx; ++a)
        for (int b = 0; b < ny; ++b)
            for (int c = 0; c < nz; ++c)
                for (std::size_t i = 0; i < tile.particles.size(); ++i)
                    all.particles.add(tile.particles.position[i] + tile.size * Vec3(a, b, c), tile.particles.radius[i]);
    return all;
}

}  // namespace vkdose::bench
