// Warnings about the regions where powder is dosed or counted.
#include <algorithm>

#include "host/advice/body_words.h"

namespace vkdose {
namespace {

/// The deepest that a point of the domain can be in a region [m]; negative if none is in it.
double deepestIn(const CountRegion& region, const Box& domain) {
    if (region.kind == CountRegion::Kind::Box) {
        const Vec3 shared = glm::min(region.high, domain.high) - glm::max(region.low, domain.low);
        return std::min({shared.x, shared.y, shared.z});
    }
    const Vec3 corner = glm::mix(domain.low, domain.high, glm::vec<3, bool>(glm::greaterThan(region.normal, Vec3(0))));
    return region.depth(corner);
}

/// Whether all of the region that is in the domain lies behind the walls of the canister.
bool behindWalls(const CountRegion& region, const Canister& can, const Box& domain) {
    constexpr int kPlaces = 24;
    Box room = domain;
    bool held = false;
    if (region.kind == CountRegion::Kind::Box)
        room = {glm::max(region.low, domain.low), glm::min(region.high, domain.high)};
    for (int i = 0; i < kPlaces * kPlaces * kPlaces; ++i) {
        const Vec3 share = (Vec3(i % kPlaces, i / kPlaces % kPlaces, i / kPlaces / kPlaces) + 0.5) / double(kPlaces);
        const Vec3 at = room.low + share * (room.high - room.low);
        if (!region.holds(at)) continue;
        if (!(behindWall(can, at) > 0)) return false;
        held = true;
    }
    return held;
}

}  // namespace

Found unreachableRegion(const Subject& s) {
    for (const CountRegion& region : s.c.world.regions)
        if (!(deepestIn(region, s.c.world.domain) > 0))
            return Finding{"region." + region.name,
                           "no sphere can reach it: it lies outside of the domain, where a sphere is lost and the run "
                           "ends",
                           "move the region, or widen [domain]"};
    for (const CountRegion& region : s.c.world.regions)
        if (s.c.canister && behindWalls(region, *s.c.canister, s.c.world.domain))
            return Finding{"region." + region.name, "no sphere can reach it: it lies behind the walls of the canister",
                           "move the region into the canister, or beyond its outlet"};
    return {};
}

Found noOutlet(const Subject& s) {
    const bool deletes = std::any_of(s.c.world.regions.begin(), s.c.world.regions.end(),
                                     [](const CountRegion& region) { return region.deletes; });
    if (deletes || s.c.canister || s.c.schedule.rotateTime == 0) return {};
    return Finding{"region", "there are doses, but nothing is ever dosed without a canister",
                   "add a [[region]] that the powder falls into"};
}

}  // namespace vkdose
