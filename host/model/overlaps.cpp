#include "host/model/overlaps.h"

namespace vkdose {

Imaged withImages(const World& world, const Particles& particles) {
    Imaged imaged{particles, {}};
    // Of two opposite shifts one is enough.
    std::vector<Vec3> shifts;
    for (int d = 0; d < 3; ++d) {
        if (world.period[d] == 0) continue;
        Vec3 shift(0);
        shift[d] = world.period[d];
        const std::vector<Vec3> former = shifts;
        for (const Vec3& other : former) shifts.insert(shifts.end(), {other + shift, other - shift});
        shifts.push_back(shift);
    }
    const double reach = 2 * largestRadius(particles);
    for (const Vec3& shift : shifts)
        for (std::size_t i = 0; i < particles.size(); ++i) {
            const Vec3 x = particles.position[i] + shift;
            const bool far = glm::any(glm::lessThan(x, world.domain.low - reach)) ||
                             glm::any(glm::greaterThan(x, world.domain.high + reach));
            if (far || particles.status[i] != Status::Active) continue;
            imaged.all.add(x, particles.radius[i]);
            imaged.of.push_back(i);
        }
    return imaged;
}

}  // namespace vkdose
