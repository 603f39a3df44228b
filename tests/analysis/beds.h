#pragma once
// Beds whose density is known, in the paper's canister.

#include <cmath>

#include "geometry/coil.h"
#include "host/model/case.h"

namespace vkdose::test {

inline Canister paperCanister() {
    return {60e-3, 23e-3, 170e-3, 23e-3, 10e-3, false};
}

inline geometry::Coil paperCoil() {
    geometry::Coil coil;
    coil.radius = 10.4e-3;
    coil.pitch = 8.75e-3;
    coil.wireRadius = 1e-3;
    coil.length = 70e-3;
    return coil;
}

/// Spheres of 1 mm radius on a cubic lattice of 2 mm over the whole floor plan, in planes from `low` to `high` [m, y].
inline Particles layers(double low, double high) {
    constexpr double a = 1e-3;
    const int planes = static_cast<int>(std::lround((high - low) / (2 * a))) + 1;
    Particles bed;
    for (int i = 0; i < planes; ++i)
        for (int j = -5; j <= 5; ++j)
            for (int k = 0; k < 30; ++k) bed.add({2 * a * j, low + 2 * a * i, a + 2 * a * k}, a);
    return bed;
}

}  // namespace vkdose::test
