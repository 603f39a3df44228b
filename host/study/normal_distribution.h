#pragma once
// The standard normal distribution, and points that are evenly spread over a cube or over it.

#include <cstddef>
#include <vector>

namespace vkdose {

double normalDensity(double x);
/// The part of the distribution below x.
double normalBelow(double x);

/// The `index`th point of Halton's sequence in the unit cube, from 1: evenly spread however many are taken. At most
/// kMostTargets dimensions.
std::vector<double> haltonPoint(int index, std::size_t dimensions);

/// Points of the distribution in kMostTargets dimensions, evenly spread and the same in every call.
const std::vector<std::vector<double>>& normalDraws();

}  // namespace vkdose
