#include "host/model/refill.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "host/core/error.h"
#include "host/model/free_sites.h"
#include "host/model/grid.h"
#include "host/model/powders.h"

namespace vkdose {
namespace {

/// How high the powder stands that spheres over this box can fall onto [m, y]; no lower than the box.
double topUnder(const Box& box, const Particles& p) {
    double top = box.low.y;
    for (std::size_t i = 0; i < p.size(); ++i) {
        if (p.status[i] != Status::Active) continue;
        const Vec3& x = p.position[i];
        const double r = p.radius[i];
        const bool under = x.x + r > box.low.x && x.x - r < box.high.x && x.z + r > box.low.z && x.z - r < box.high.z;
        if (under) top = std::max(top, x.y + r);
    }
    return top;
}

}  // namespace

Box refillRegion(const Case& c, const Refill& refill) {
    const bool first = c.canister || c.mixed;
    Box region = first ? c.filling.region : powdersOf(c)[powderIndex(c, refill.material)].filling.region;
    region.high.y = std::numeric_limits<double>::infinity();
    return region;
}

namespace {

std::vector<Vec3> placeInVessel(const Case& c, const Insertion& filled, std::size_t index, const Particles& now,
                                const Clearance& around) {
    const InsertionGrid grid = gridOfFill(c);
    const std::vector<std::uint64_t> clear = clearSites(c.world, grid, around, now);
    const std::size_t count = filled.waiting.at(index).particles.size(), first = filled.firstOf(index);
    if (clear.size() < count)
        throw RunError(fmt::format(
            "there is no room for the powder of refill \"{}\" ({:.4g} g): of the {:.0f} sites of "
            "the grid in the vessel {} are clear, for {} spheres; add it later, or less of it",
            c.refills.at(index).name, filled.waiting[index].mass * 1e3, grid.capacity(), clear.size(), count));
    std::vector<Vec3> places;
    for (std::size_t i = 0; i < count; ++i)
        places.push_back(grid.site(clear[i]) + jitter(c.seed, first + i, grid.jitterAmplitude()));
    return places;
}

}  // namespace

std::vector<Vec3> placeRefill(const Case& c, const Insertion& filled, std::size_t index, const Particles& now,
                              const Clearance& around) {
    if (c.filling.sites) return placeInVessel(c, filled, index, now, around);
    const Particles& powder = filled.waiting.at(index).particles;
    const Box region = refillRegion(c, c.refills.at(index));
    const double lift = topUnder(region, now) - region.low.y;
    std::vector<Vec3> places = powder.position;
    for (std::size_t i = 0; i < places.size(); ++i) {
        Vec3& x = places[i];
        x.y += lift;
        const auto refuse = [&](const std::string& problem) {
            throw RunError(
                fmt::format("there is no room for the powder of refill \"{}\" ({:.4g} g): its sphere at "
                            "({:.6g}, {:.6g}, {:.6g}) m {}",
                            c.refills.at(index).name, filled.waiting[index].mass * 1e3, x.x, x.y, x.z, problem));
        };
        if (x.y > c.world.domain.high.y)
            refuse(
                fmt::format("would be above the domain, which ends at y = {:.6g} m: add it later, or raise "
                            "domain.high",
                            c.world.domain.high.y));
        if (c.world.doses(x)) refuse("would be where powder is dosed");
        const Obstacle obstacle = around.nearest(x, powder.radius[i]);
        if (!obstacle.what.empty())
            refuse(fmt::format("would overlap {} by {:.3g} of its radius", obstacle.what,
                               1 - obstacle.distance / powder.radius[i]));
    }
    return places;
}

}  // namespace vkdose
