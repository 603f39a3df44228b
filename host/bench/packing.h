#pragma once
// Dense packings for the benchmark, made from a seed in a second or two and then tiled, so that a million spheres cost
// no more to relax than a few thousand.

#include <cstdint>

#include "host/model/particles.h"

namespace vkdose::bench {

inline constexpr double kRadiusMin = 0.625e-3, kRadiusMax = 1.875e-3;  ///< the paper's, uniform between [m]

/// Spheres in the box from the origin to `size` [m]. A sphere near a face reaches beyond it, into where the
/// neighbouring tile would lie.
struct Packing {
    Particles particles;
    Vec3 size{0};
};

/// A cube of 3375 spheres, periodic in all directions: radii drawn uniformly, centres from a shifted lattice pushed
/// apart until little is left of the overlaps. A little denser than random close packing, so that the spheres press on
/// each other and each touches about as many as in a bed under load. Same seed, same bits.
Packing relaxedTile(std::uint64_t seed);

/// `nx` x `ny` x `nz` copies side by side.
Packing tiled(const Packing& tile, int nx, int ny, int nz);

}  // namespace vkdose::bench
