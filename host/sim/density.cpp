#include "host/sim/density.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "host/core/sphere.h"

namespace vkdose {

namespace {

constexpr double kNothing = -std::numeric_limits<double>::infinity();

/// With fewer mean spheres than this, a region says more about its edge than about the powder.
constexpr double kLeastSpheres = 100;

/// A bed whose spheres move faster than this share of the speed after a fall from its top has not settled.
constexpr double kStillFalls = 0.1;

/// Points along a side of the lattice that stands for a sphere. A part of a sphere is known to about 1/16 of its
/// diameter.
constexpr int kLattice = 16;

/// How one side of a floor plan is divided.
struct Division {
    double low, high;  ///< ends of the side [m]
    double piece;      ///< length of a piece [m]
    int count;
};

constexpr double kLeftOver = 1e-9;  ///< of a piece: so much is left over by rounding, and is no piece

/// Pieces of this length. The last one is cut by the end.
Division piecesOf(double length, double low, double high) {
    return {low, high, length, std::max(0, static_cast<int>(std::ceil((high - low) / length - kLeftOver)))};
}

/// Equal pieces at least so long, or one that is shorter.
Division equalPieces(double least, double low, double high) {
    const int count = std::max(1, static_cast<int>((high - low) / least + kLeftOver));
    return {low, high, (high - low) / count, count};
}

/// Rectangles over a floor plan, each with the top of the highest sphere whose centre is over it.
class Surface {
  public:
    Surface(const Particles& p, const Division& x, const Division& z)
        : low_{x.low, z.low}, high_{x.high, z.high}, side_{x.piece, z.piece}, cells_{x.count, z.count} {
        top_.assign(static_cast<std::size_t>(cells_[0]) * cells_[1], kNothing);
        for (std::size_t i = 0; i < p.size(); ++i) {
            const int cell = p.status[i] == Status::Active ? cellOf(p.position[i]) : -1;
            if (cell >= 0) top_[cell] = std::max(top_[cell], p.position[i].y + p.radius[i]);
        }
    }

    /// Index of the column over which a point lies; -1 beside the plan.
    int cellOf(const Vec3& x) const {
        const double place[2] = {x.x, x.z};
        int index[2];
        for (int k = 0; k < 2; ++k) {
            if (!(place[k] >= low_[k]) || !(place[k] < high_[k])) return -1;
            index[k] = std::min(static_cast<int>((place[k] - low_[k]) / side_[k]), cells_[k] - 1);
        }
        return index[0] * cells_[1] + index[1];
    }
    double top(int cell) const { return top_[cell]; }
    int columns() const { return cells_[0] * cells_[1]; }
    double highest() const { return top_.empty() ? kNothing : *std::max_element(top_.begin(), top_.end()); }
    Vec3 low(int cell) const {
        return {low_[0] + cell / cells_[1] * side_[0], 0, low_[1] + cell % cells_[1] * side_[1]};
    }
    double area(int cell) const { return extent(0, cell / cells_[1]) * extent(1, cell % cells_[1]); }
    int slices() const { return cells_[1]; }
    int sliceOf(int cell) const { return cell % cells_[1]; }
    double sliceLength(int slice) const { return extent(1, slice); }

  private:
    double extent(int k, int i) const { return std::min(side_[k], high_[k] - low_[k] - i * side_[k]); }

    double low_[2], high_[2], side_[2];
    int cells_[2];
    std::vector<double> top_;
};

/// The parts of active spheres for which `inside(point)` holds. Each sphere is a lattice of points that together weigh
/// as much as the sphere.
struct Parts {
    double mass = 0, solid = 0;  ///< [kg], [m3]
};
template <typename Inside>
Parts partsWithin(const World& world, const Particles& p, const Inside& inside) {
    std::vector<Vec3> lattice;
    for (int i = 0; i < kLattice; ++i)
        for (int j = 0; j < kLattice; ++j)
            for (int k = 0; k < kLattice; ++k) {
                const Vec3 x = (Vec3(i, j, k) + 0.5) * (2.0 / kLattice) - 1.0;
                if (glm::dot(x, x) < 1) lattice.push_back(x);
            }
    Parts parts;
    for (std::size_t i = 0; i < p.size(); ++i) {
        if (p.status[i] != Status::Active) continue;
        int hits = 0;
        for (const Vec3& x : lattice) hits += inside(p.position[i] + p.radius[i] * x) ? 1 : 0;
        const double solid = sphereVolume(p.radius[i]) * hits / static_cast<double>(lattice.size());
        parts.mass += world.density(p.material[i]) * solid;
        parts.solid += solid;
    }
    return parts;
}

std::optional<BulkDensity> densityOf(const Parts& parts, double volume, double meanRadius) {
    if (!(volume > kLeastSpheres * sphereVolume(meanRadius))) return std::nullopt;
    return BulkDensity{parts.mass / volume, parts.mass, volume, parts.solid};
}

}  // namespace

double meanActiveRadius(const Particles& particles) {
    double sum = 0, count = 0;
    for (std::size_t i = 0; i < particles.size(); ++i) {
        if (particles.status[i] != Status::Active) continue;
        sum += particles.radius[i];
        ++count;
    }
    return count > 0 ? sum / count : 0;
}

std::optional<BulkDensity> bedDensity(const World& world, const Particles& particles, const Canister& canister,
                                      const geometry::Coil* coil, const BodyPoses& bodies) {
    const double a = meanActiveRadius(particles), margin = 2 * a;
    if (!(a > 0)) return std::nullopt;
    const double across = canister.width / 2 - margin;
    const Surface surface(particles, piecesOf(2 * margin, -across, across),
                          piecesOf(2 * margin, margin, canister.length - margin));
    const double low = (coil ? coil->radius + coil->wireRadius : 0.0) + margin;
    const auto inside = [&](const Vec3& x) {
        if (x.y < low) return false;
        const int cell = surface.cellOf(x);
        return cell >= 0 && x.y < surface.top(cell) - margin;
    };
    const Box box{{-across, low, margin}, {across, surface.highest() - margin, canister.length - margin}};
    const BodyRoom room(world, bodies, particles, box, a, margin);
    double volume = 0;
    for (int cell = 0; cell < surface.columns(); ++cell)
        volume += surface.area(cell) * std::max(0.0, surface.top(cell) - margin - low);
    const Parts parts = partsWithin(world, particles, [&](const Vec3& x) { return inside(x) && !room.takes(x); });
    return densityOf(parts, volume - room.volume(inside), a);
}

std::optional<BulkDensity> coilDensity(const World& world, const Particles& particles, const Canister& canister,
                                       const geometry::Coil& coil, double from, const BodyPoses& bodies) {
    const double a = meanActiveRadius(particles), margin = 2 * a;
    if (!(a > 0)) return std::nullopt;
    const double outer = coil.radius + coil.wireRadius;
    const double begin = std::max({coil.zStart, 0.0, from}), end = std::min(coil.zStart + coil.length, canister.length);
    // No narrow column across: it could have no sphere over it however full the canister is.
    const Surface surface(particles, equalPieces(2 * margin, -outer, outer), piecesOf(2 * margin, begin, end));
    std::vector<double> lowestTop(surface.slices(), std::numeric_limits<double>::infinity());
    for (int cell = 0; cell < surface.columns(); ++cell) {
        double& top = lowestTop[surface.sliceOf(cell)];
        top = std::min(top, surface.top(cell));
    }
    const auto covered = [&](int slice) { return lowestTop[slice] > outer + margin; };
    const auto inside = [&](const Vec3& x) {
        if (x.x * x.x + x.y * x.y >= outer * outer) return false;
        const int cell = surface.cellOf(x);
        return cell >= 0 && covered(surface.sliceOf(cell));
    };
    const BodyRoom room(world, bodies, particles, {{-outer, -outer, begin}, {outer, outer, end}}, a, margin);
    const double wire = kPi * coil.wireRadius * coil.wireRadius *
                        std::hypot(1.0, 2 * kPi * coil.radius / coil.pitch);  // volume per length along the axis
    double volume = 0;
    for (int slice = 0; slice < surface.slices(); ++slice)
        if (covered(slice)) volume += surface.sliceLength(slice) * (kPi * outer * outer - wire);
    const Parts parts = partsWithin(world, particles, [&](const Vec3& x) { return inside(x) && !room.takes(x); });
    // The wire has no place of its own here: a body takes as large a share of it as of the cylinder.
    const double share = 1 - wire / (kPi * outer * outer);
    return densityOf(parts, volume - share * room.volume(inside), a);
}

std::optional<BulkDensity> settledDensity(const Case& c, const Settling& settling, const Particles& particles,
                                          const BodyPoses& bodies) {
    if (!c.canister || settling.speed > kStillFalls * settling.fallSpeed) return std::nullopt;
    const geometry::Coil* coil = c.world.coil ? &*c.world.coil : nullptr;
    auto bulk = bedDensity(c.world, particles, *c.canister, coil, bodies);
    if (!bulk && coil != nullptr) bulk = coilDensity(c.world, particles, *c.canister, *coil, 0, bodies);
    return bulk;
}

std::optional<BulkDensity> containerDensity(const World& world, const Particles& particles, double radius,
                                            const BodyPoses& bodies) {
    const double a = meanActiveRadius(particles), margin = 2 * a, within = radius - margin;
    if (!(a > 0) || !(within > 0)) return std::nullopt;
    // The square in the cylinder: its columns are all full.
    const double half = within / std::sqrt(2.0);
    const Division side = equalPieces(2 * margin, -half, half);
    const Surface surface(particles, side, side);
    const Box box{{-within, margin, -within}, {within, surface.highest() - margin, within}};
    const BodyRoom room(world, bodies, particles, box, a, margin);
    double top = std::numeric_limits<double>::infinity();
    for (int cell = 0; cell < surface.columns(); ++cell) {
        const Vec3 corner = surface.low(cell);
        const bool body = surface.top(cell) == kNothing &&
                          room.takesAnyOver(corner.x, corner.x + side.piece, corner.z, corner.z + side.piece);
        if (!body) top = std::min(top, surface.top(cell) - margin);
    }
    if (!(top > margin) || !std::isfinite(top)) return std::nullopt;
    const auto inside = [&](const Vec3& x) {
        return x.y > margin && x.y < top && x.x * x.x + x.z * x.z < within * within;
    };
    const Parts parts = partsWithin(world, particles, [&](const Vec3& x) { return inside(x) && !room.takes(x); });
    return densityOf(parts, kPi * within * within * (top - margin) - room.volume(inside), a);
}

double closedFormMass(double bulkDensity, const geometry::Coil& coil, double turns) {
    return bulkDensity * coil.pitch * kPi * coil.radius * coil.radius * turns;
}

double closedFormDensity(const Derived& derived, const geometry::Coil& coil) {
    return derived.massPerTurn / closedFormMass(1, coil, 1);
}

bool wasMeasured(const Case& c, double density) {
    constexpr double kRounding = 1e-9;
    return c.bulkDensityMeasured && std::abs(density / c.bulkDensity - 1) > kRounding;
}

}  // namespace vkdose
