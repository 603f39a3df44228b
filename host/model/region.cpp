#include "host/model/region.h"

#include <algorithm>

namespace vkdose {

double CountRegion::depth(const Vec3& x) const {
    if (kind == Kind::Beyond) return glm::dot(x - point, normal);
    const Vec3 inside = glm::min(x - low, high - x);
    return std::min({inside.x, inside.y, inside.z});
}

}  // namespace vkdose
