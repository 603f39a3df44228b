#pragma once
// Drawing radii. The number of a draw, not the order of calls, decides its value (core/random.h).

#include <cstdint>
#include <vector>

#include "host/model/case.h"

namespace vkdose {

/// Radius of particle `index` [m]. Normal and Lognormal are drawn again while they fall outside
/// [radiusMin, radiusMax]; `redrawn` counts these draws. Throws std::logic_error after 100000 of them
/// (loadCase refuses bounds that leave so little).
double drawRadius(const SizeDistribution& size, std::uint64_t seed, std::uint64_t index, std::uint64_t& redrawn);

/// Bounds of the radii that can be drawn [m].
double smallestRadius(const SizeDistribution& size);
double largestRadius(const SizeDistribution& size);

/// Mean radius and mean cubed radius by number [m, m3] of the drawn particles.
double meanRadius(const SizeDistribution& size);
double meanCubedRadius(const SizeDistribution& size);

/// Whether the distribution is that of a powder's volume: Quantiles or Sieve. Its bounds are of the spheres alone.
bool byVolume(const SizeDistribution& size);

/// The same powder in spheres `factor` times as large.
SizeDistribution enlarged(SizeDistribution size, double factor);

/// Fraction of the draws that fall inside the bounds. It is 1 for distributions that never draw again.
double acceptance(const SizeDistribution& size);

/// Quantiles, Sieve: fraction of the powder's volume finer than radius r, after scaling. Between d10 and d50 and
/// between d50 and d90 the volume is spread evenly over ln r; both slopes go on beyond, to 0 and to 1. Between two
/// sieves it is spread evenly over ln r.
double finerVolume(const SizeDistribution& size, double radius);
/// Radii where `finerVolume` reaches 0 and 1: the natural truncation [m].
double finestRadius(const SizeDistribution& size);
double coarsestRadius(const SizeDistribution& size);

/// Quantiles, Sieve: the number of particles between two radii [m], over that of all that are drawn.
struct NumberClass {
    double low = 0, high = 0, share = 0;
};
std::vector<NumberClass> numberClasses(const SizeDistribution& size);

}  // namespace vkdose
