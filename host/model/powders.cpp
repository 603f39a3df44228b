#include "host/model/powders.h"

#include <fmt/format.h>

namespace vkdose {
std::vector<PowderOf> powdersOf(const Case& c) {
    std::vector<PowderOf> powders{{c.world.materials.front().name, kFirstPowder, c.filling, "particles"}};
    for (std::size_t k = 0; k < c.furtherPowders.size(); ++k) {
        const Powder& p = c.furtherPowders[k];
        powders.push_back({p.name, p.material, p.filling, fmt::format("powder[{}]", k)});
    }
    return powders;
}

std::size_t powderIndex(const Case& c, int material) {
    std::size_t index = 0;
    for (std::size_t k = 0; k < c.furtherPowders.size(); ++k)
        if (c.furtherPowders[k].material == material) index = k + 1;
    return index;
}

Fill fillOf(const Case& c) {
    Fill fill;
    if (c.filling.list) {
        const Particles& list = *c.filling.list;
        for (std::size_t i = 0; i < list.size(); ++i) {
            const double mass = massOf(c.world, list, i);
            fill.mass += mass;
            fill.volume += mass / c.world.density(list.material[i]);
        }
        return fill;
    }
    for (const PowderOf& p : powdersOf(c)) {
        fill.mass += p.filling.mass;
        fill.volume += p.filling.mass / c.world.density(p.material);
    }
    return fill;
}

double solidDensity(const Case& c, std::optional<int> material) {
    if (material) return c.world.density(*material);
    if (c.furtherPowders.empty()) return c.world.density();
    const Fill fill = fillOf(c);
    return fill.mass / fill.volume;
}

}  // namespace vkdose
