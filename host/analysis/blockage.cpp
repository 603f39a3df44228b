#include "host/analysis/blockage.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "host/sim/density.h"

namespace vkdose {

BlockageRule blockageRule(const StopRule& stop, double closedForm) {
    constexpr double kPaperDose = 4.2e-3;  // by the closed form, to which the paper's threshold belongs [kg]
    BlockageRule rule;
    if (stop.kind == StopRule::Kind::Experiment)
        rule.threshold = stop.threshold;
    else
        rule.threshold *= closedForm / kPaperDose;
    if (stop.kind != StopRule::Kind::None) rule.doses = stop.doses;
    return rule;
}

double Supply::until(double time) const {
    double given = mass;
    for (const Refill& refill : refills)
        if (refill.time > time) given -= refill.mass;
    return given;
}

std::optional<int> blockedAt(const std::vector<Dose>& doses, const Supply& supply, const BlockageRule& rule) {
    std::vector<const Dose*> complete;
    for (const Dose& d : doses)
        if (d.complete) complete.push_back(&d);
    const int last = static_cast<int>(complete.size());
    // A device fills before it delivers. Where nothing ever comes it was blocked from the beginning.
    const auto delivers = [](const Dose* d) { return d->particles > 0; };
    const auto begun = std::find_if(complete.begin(), complete.end(), delivers);
    const int from = begun == complete.end() ? 1 : static_cast<int>(begun - complete.begin()) + 1;
    for (int dose = from; dose + rule.doses - 1 <= last; ++dose) {
        const Dose& first = *complete[dose - 1];
        const double end = complete[dose + rule.doses - 2]->cumulative, before = first.cumulative - first.mass;
        const double given = supply.until(first.startTime);  // powder that was there all the while
        if (end - before <= rule.threshold && given - end > rule.remaining * given) return dose;
    }
    return std::nullopt;
}

namespace {

/// Of a sphere, or of the room that a body takes.
struct Stretch {
    double low, high;  ///< [m, y]
    bool body = false;
};

/// The greatest gap below a sphere, seen from `floor` upwards: its lower and upper end.
std::pair<double, double> greatestGap(std::vector<Stretch> stretches, double floor) {
    std::sort(stretches.begin(), stretches.end(), [](const Stretch& a, const Stretch& b) { return a.low < b.low; });
    std::pair gap{floor, floor};
    double top = floor;
    for (const Stretch& s : stretches) {
        if (!s.body && s.low - top > gap.second - gap.first) gap = {top, s.low};
        top = std::max(top, s.high);
    }
    return gap;
}

}  // namespace

std::optional<Arch> archAbove(const geometry::Coil& coil, const Canister& canister, const Particles& particles,
                              const World& world, const BodyPoses& bodies) {
    const double a = meanActiveRadius(particles), diameter = 2 * a;
    if (!(diameter > 0)) return std::nullopt;
    const double slice = 2 * diameter, floor = -canister.width / 2;
    const double begin = std::max(coil.zStart, 0.0);
    const double end = std::min(coil.zStart + coil.length, canister.length);
    const int slices = static_cast<int>((end - begin) / slice);

    std::vector<std::vector<Stretch>> columns(std::max(slices, 0));
    double top = floor;
    for (std::size_t i = 0; i < particles.size(); ++i) {
        const Vec3& x = particles.position[i];
        const double place = std::floor((x.z - begin) / slice), r = particles.radius[i];
        if (particles.status[i] != Status::Active || std::abs(x.x) > coil.radius / 2) continue;
        if (place < 0 || place >= slices) continue;
        columns[static_cast<std::size_t>(place)].push_back({x.y - r, x.y + r});
        top = std::max(top, x.y + r);
    }
    const Box box{{-coil.radius / 2, floor, begin}, {coil.radius / 2, top, end}};
    const BodyRoom room(world, bodies, particles, box, a, 1.5 * a);
    const double step = a / 2;
    const int pieces = int(std::ceil((top - floor) / step));
    for (int i = 0; i < slices && !world.bodies.empty(); ++i)
        for (int k = 0; k < pieces; ++k) {
            const double y = floor + k * step;
            if (room.takes({0, y + step / 2, begin + (i + 0.5) * slice}))
                columns[std::size_t(i)].push_back({y, y + step, true});
        }
    Arch arch;
    for (int i = 0; i < slices; ++i) {
        const auto [low, high] = greatestGap(columns[i], floor);
        if (high - low < 2 * diameter || high < 0) continue;
        arch.length += slice;
        if (high - low > arch.height) {
            arch.height = high - low;
            arch.z = begin + (i + 0.5) * slice;
        }
    }
    return arch.length > 0 ? std::optional(arch) : std::nullopt;
}

}  // namespace vkdose
