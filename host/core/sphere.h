#pragma once

#include "host/core/vec.h"

namespace vkdose {

/// Of a ball with this radius [m3]; sphereMass (host/model/particles.h) is its mass.
inline double sphereVolume(double radius) {
    return 4.0 / 3.0 * kPi * radius * radius * radius;
}

}  // namespace vkdose
