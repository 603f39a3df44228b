// Warnings about the regions where powder is dosed or counted.
#include <algorithm>

#include "host/advice/body_words.h"
#include "host/model/clearance.h"

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

/// Whether a sphere that falls straight down from there leaves the domain, and meets nothing and no region that deletes
/// before.
bool fallsOut(const World& world, const Clearance& around, Vec3 x, double radius, const Vec3& down) {
    const auto inside = [&](const Vec3& at) {
        return glm::all(glm::greaterThanEqual(at, world.domain.low)) &&
               glm::all(glm::lessThanEqual(at, world.domain.high));
    };
    for (; inside(x); x += radius * down)
        if (world.doses(x) || !around.nearest(x, radius).what.empty()) return false;
    return true;
}

}  // namespace

Found openBelow(const Subject& s) {
    constexpr std::size_t kLooks = 200;
    const World& world = s.c.world;
    const double g = glm::length(world.gravity);
    const Vec3 down = g > 0 ? world.gravity / g : Vec3(0);
    const bool onward = glm::length(world.period * down) > 0;  // it comes in again at the other end
    if (s.c.canister || g == 0 || onward) return {};
    const Particles& p = s.filled.particles;
    const Clearance around(world);
    const std::size_t step = std::max<std::size_t>(p.size() / kLooks, 1);
    for (std::size_t i = 0; i < p.size(); i += step) {
        if (!fallsOut(world, around, p.position[i], p.radius[i], down)) continue;
        const Vec3 mm = 1e3 * p.position[i];
        return Finding{
            "particles",
            fmt::format("nothing stands under the powder at ({:.3g}, {:.3g}, {:.3g}) mm: it falls out of the "
                        "domain, which ends the run",
                        mm.x, mm.y, mm.z),
            "close the device below, or add a [[region]] that the powder falls into"};
    }
    return {};
}

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
