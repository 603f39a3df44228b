#include "host/bench/packing.h"

#include <algorithm>
#include <cmath>

#include "host/core/random.h"
#include "host/core/sphere.h"

namespace vkdose::bench {

namespace {

constexpr int kSide = 15;                 // lattice sites along an edge of the tile
constexpr double kVolumeFraction = 0.62;  // enough for overlaps like those of a bed, a hundredth of a radius
constexpr int kRounds = 800;              // of pushing apart; the tests say what forces are left
constexpr double kShare = 0.1;            // of an overlap, taken by each of the two in a round
constexpr double kInertia = 0.9;          // of the last round's push: without it long waves take thousands of rounds

/// Spheres of a box sorted into cubes at least as wide as the largest sphere.
class Grid {
  public:
    Grid(double edge, double reach) : cells_(int(edge / reach)), width_(edge / cells_) {}

    void sort(const std::vector<Vec3>& x) {
        members_.assign(std::size_t(cells_) * cells_ * cells_, {});
        for (std::size_t i = 0; i < x.size(); ++i)
            members_[index(cell(x[i].x), cell(x[i].y), cell(x[i].z))].push_back(i);
    }

    /// Calls `visit(j)` for every sphere j > i in the 27 cells around x.
    template <class Visit>
    void around(const Vec3& x, std::size_t i, const Visit& visit) const {
        const auto low = [&](double v) { return std::max(0, cell(v) - 1); };
        const auto high = [&](double v) { return std::min(cells_ - 1, cell(v) + 1); };
        for (int a = low(x.x); a <= high(x.x); ++a)
            for (int b = low(x.y); b <= high(x.y); ++b)
                for (int c = low(x.z); c <= high(x.z); ++c)
                    for (std::size_t j : members_[index(a, b, c)])
                        if (j > i) visit(j);
    }

  private:
    int cell(double v) const { return std::clamp(int(std::floor(v / width_)), 0, cells_ - 1); }
    std::size_t index(int a, int b, int c) const { return (std::size_t(a) * cells_ + b) * cells_ + c; }

    int cells_;
    double width_;
    std::vector<std::vector<std::size_t>> members_;
};

/// Minimises the sum of the squared overlaps: at the end linear springs balance.
void pushApart(Particles& p, double edge, const geometry::Coil* coil) {
    std::vector<Vec3>& x = p.position;
    std::vector<Vec3> push(x.size(), Vec3(0));
    Grid grid(edge, 2 * kRadiusMax);
    for (int round = 0; round < kRounds; ++round) {
        grid.sort(x);
        for (Vec3& d : push) d *= kInertia;
        for (std::size_t i = 0; i < x.size(); ++i) {
            const double r = p.radius[i];
            grid.around(x[i], i, [&](std::size_t j) {
                const Vec3 d = x[i] - x[j];
                const double reach = r + p.radius[j], square = glm::dot(d, d);
                if (square >= reach * reach || square == 0) return;
                const double distance = std::sqrt(square);
                const Vec3 shift = kShare * (reach - distance) / distance * d;
                push[i] += shift;
                push[j] -= shift;
            });
            for (glm::length_t a = 0; a < 3; ++a)  // a wall is where the sphere meets its own mirror image
                push[i][a] += 2 * kShare * (std::max(0.0, r - x[i][a]) - std::max(0.0, x[i][a] + r - edge));
            if (coil == nullptr) continue;
            for (const geometry::CoilTouch& touch : geometry::touches(*coil, 0, x[i] - Vec3(edge / 2, edge / 2, 0), r))
                push[i] += 2 * kShare * (r - touch.distance) * touch.normal;
        }
        for (std::size_t i = 0; i < x.size(); ++i) x[i] += push[i];
    }
}

Packing relaxed(std::uint64_t seed, const geometry::Coil* coil) {
    const std::size_t n = std::size_t(kSide) * kSide * kSide;
    std::vector<double> radius(n);
    double volume = 0;
    for (std::size_t i = 0; i < n; ++i) {
        radius[i] = kRadiusMin + (kRadiusMax - kRadiusMin) * uniforms(seed, Stream::Radius, i)[0];
        volume += sphereVolume(radius[i]);
    }
    const double edge = std::cbrt(volume / kVolumeFraction), site = edge / kSide;
    Packing tile;
    tile.size = Vec3(edge);
    for (std::size_t i = 0; i < n; ++i) {
        const auto a = uniforms(seed, Stream::Jitter, i), b = uniforms(seed, Stream::Jitter, i, 1);
        const Vec3 corner(double(i % kSide), double(i / kSide % kSide), double(i / kSide / kSide));
        tile.particles.add(site * (corner + Vec3(a[0], a[1], b[0])), radius[i]);
    }
    pushApart(tile.particles, edge, coil);
    return tile;
}

}  // namespace

Packing relaxedTile(std::uint64_t seed) {
    return relaxed(seed, nullptr);
}

Packing relaxedAround(const geometry::Coil& coil, std::uint64_t seed) {
    return relaxed(seed, &coil);
}

Packing tiled(const Packing& tile, int nx, int ny, int nz) {
    Packing all;
    all.size = tile.size * Vec3(nx, ny, nz);
    const auto place = [](double x, double size, int n) { return n * size + (n % 2 == 0 ? x : size - x); };
    for (int a = 0; a < nx; ++a)
        for (int b = 0; b < ny; ++b)
            for (int c = 0; c < nz; ++c)
                for (std::size_t i = 0; i < tile.particles.size(); ++i) {
                    const Vec3& x = tile.particles.position[i];
                    all.particles.add(
                        Vec3(place(x.x, tile.size.x, a), place(x.y, tile.size.y, b), place(x.z, tile.size.z, c)),
                        tile.particles.radius[i]);
                }
    return all;
}

}  // namespace vkdose::bench
