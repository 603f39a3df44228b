#include "host/model/overlaps.h"

namespace vkdose {

namespace {

/// Of two opposite shifts one is enough.
bool isFirst(const Vec3& shift) {
    return shift.x > 0 || (shift.x == 0 && (shift.y > 0 || (shift.y == 0 && shift.z > 0)));
}

}  // namespace

Imaged withImages(const World& world, const Particles& particles) {
    Imaged imaged{particles, {}};
    const double reach = 2 * largestRadius(particles);
    for (const Vec3& shift : imageShifts(world.period)) {
        if (!isFirst(shift)) continue;
        for (std::size_t i = 0; i < particles.size(); ++i) {
            const Vec3 x = particles.position[i] + shift;
            const bool far = glm::any(glm::lessThan(x, world.domain.low - reach)) ||
                             glm::any(glm::greaterThan(x, world.domain.high + reach));
            if (far || particles.status[i] != Status::Active) continue;
            imaged.all.add(x, particles.radius[i]);
            imaged.of.push_back(i);
        }
    }
    return imaged;
}

}  // namespace vkdose
