#pragma once
// Beds whose density is known, in the paper's canister.

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
    Particles bed;
    for (double y = low; y < high + a / 2; y += 2 * a)
        for (double x = -10e-3; x < 11e-3; x += 2 * a)
            for (double z = 1e-3; z < 60e-3; z += 2 * a) bed.add({x, y, z}, a);
    return bed;
}

}  // namespace vkdose::test
