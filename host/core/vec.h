#pragma once
// The one vector type of the host: GLM in double precision.
#define GLM_FORCE_XYZW_ONLY
#include <glm/glm.hpp>

namespace vkdose {
using Vec3 = glm::dvec3;
inline constexpr double kPi = 3.14159265358979323846;
}  // namespace vkdose
