#pragma once
// How deep the powder of a case will lie in its canister, and what its contacts bear there.

#include "host/model/case.h"

namespace vkdose {

/// Volume fraction at which a bed is expected to settle (measured beds of the shipped cases: about 0.46).
inline constexpr double kBedFraction = 0.46;

/// Forces in a bed run along chains that bear several times the mean.
inline constexpr double kChain = 5;

/// Height at which powder of this volume, voids included [m3], stands once it has settled [m, y].
double settledTop(const Canister& can, double volume);

/// Depth [m] of the settled bed of `mass` [kg] of particles of `density` [kg/m3], from the lowest point of the floor.
double bedDepth(const Canister& can, double mass, double density);

/// Mean force [N] on a contact of spheres of this radius [m] at the floor of a bed this deep, where gravity pulls down
/// with `down` [m/s2]. A contact bears the bed's pressure on the square that a sphere takes up.
double loadUnderBed(double density, double down, double depth, double radius);

}  // namespace vkdose
