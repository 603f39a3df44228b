#pragma once
// The one vector type of the host: GLM in double precision. Numbers that all rooms need.
#define GLM_FORCE_XYZW_ONLY
#include <glm/glm.hpp>
#include <limits>

namespace vkdose {
using Vec3 = glm::dvec3;
inline constexpr double kPi = 3.14159265358979323846;
inline constexpr double kInfinity = std::numeric_limits<double>::infinity();
inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
}  // namespace vkdose
