#pragma once
// Dense packings for the benchmark, made from a seed in a second or two and then tiled, so that a million spheres cost
// no more to relax than a few thousand.

#include <cstdint>

#include "host/model/particles.h"

namespace vkdose::bench {

inline constexpr double kRadiusMin = 0.625e-3, kRadiusMax = 1.875e-3;  ///< the paper's, uniform between [m]

/// Spheres in the box from the origin to `size` [m], whose walls they press on.
struct Packing {
    Particles particles;
    Vec3 size{0};
};

/// A cube of 3375 spheres between walls: radii drawn uniformly, centres from a shifted lattice pushed apart until the
/// overlaps that are left balance each other, if their forces are as linear springs, all alike between spheres and
/// twice as stiff at a wall. Without friction, gravity or history it is at rest. Same seed, same bits.
Packing relaxedTile(std::uint64_t seed);

/// `nx` x `ny` x `nz` copies side by side, every other one mirrored: a sphere at a wall then meets its own image, by
/// twice its overlap with the wall, and the whole is as much at rest as the tile.
Packing tiled(const Packing& tile, int nx, int ny, int nz);

}  // namespace vkdose::bench
