#pragma once
// Dense packings for the benchmark. A packing is made from a seed in a second or two and then tiled, so that a million
// spheres cost no more to relax than a few thousand.

#include <cstdint>

#include "geometry/coil.h"
#include "host/model/particles.h"

namespace vkdose::bench {

inline constexpr double kRadiusMin = 0.625e-3, kRadiusMax = 1.875e-3;  ///< the paper's, uniform between [m]

/// Spheres in the box from the origin to `size` [m], whose walls they press on.
struct Packing {
    Particles particles;
    Vec3 size{0};
};

/// A cube of 3375 spheres between walls. Radii are drawn uniformly. Centres start on a shifted lattice and are pushed
/// apart until the forces of the overlaps that are left balance. The forces are those of linear springs, all alike
/// between spheres and twice as stiff at a wall. Without friction, gravity or history the cube is at rest. The same
/// seed gives the same bits.
Packing relaxedTile(std::uint64_t seed);

/// The same around a coil in the middle of the cube: its axis lies halfway along x and y, and `zStart` counts from the
/// origin. Its wire is as stiff as the walls.
Packing relaxedAround(const geometry::Coil& coil, std::uint64_t seed);

/// `nx` x `ny` x `nz` copies side by side, every other one mirrored. A sphere at a wall then meets its own image with
/// twice its overlap with the wall, so the whole is as much at rest as the tile.
Packing tiled(const Packing& tile, int nx, int ny, int nz);

}  // namespace vkdose::bench
