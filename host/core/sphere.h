#pragma once

#include "host/core/vec.h"

namespace vkdose {

/// Volume of a ball with this radius [m3]. Its mass is sphereMass (host/model/particles.h).
inline double sphereVolume(double radius) {
    return 4.0 / 3.0 * kPi * radius * radius * radius;
}

}  // namespace vkdose
