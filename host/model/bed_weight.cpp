#include "host/model/bed_weight.h"

#include <algorithm>
#include <cmath>

namespace vkdose {
namespace {

/// Cross-section of the canister below the height y over the coil's axis [m2].
double crossSection(const Canister& can, double y) {
    const double half = can.width / 2;
    if (can.flatFloor) return can.width * std::max(0.0, y + half);
    if (y >= 0) return 0.5 * kPi * half * half + can.width * y;
    if (y <= -half) return 0;
    return half * half * std::acos(-y / half) + y * std::sqrt(half * half - y * y);
}

}  // namespace

double settledTop(const Canister& can, double volume) {
    double low = -can.width / 2;
    double high = low + can.width + volume / (can.length * can.width);
    for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high);
        (crossSection(can, middle) * can.length < volume ? low : high) = middle;
    }
    return high;
}

double bedDepth(const Canister& can, double mass, double density) {
    return settledTop(can, mass / density / kBedFraction) + can.width / 2;
}

double loadUnderBed(double density, double down, double depth, double radius) {
    return density * kBedFraction * down * depth * 4 * radius * radius;
}

}  // namespace vkdose
