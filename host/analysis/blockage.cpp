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
    for (int dose = 1; dose + rule.doses - 1 <= last; ++dose) {
        const Dose& first = *complete[dose - 1];
        const double end = complete[dose + rule.doses - 2]->cumulative, before = first.cumulative - first.mass;
        const double given = supply.until(first.startTime);  // powder that was there all the while
        if (end - before <= rule.threshold && given - end > rule.remaining * given) return dose;
    }
    return std::nullopt;
}

namespace {

using Stretch = std::pair<double, double>;  ///< from bottom to top of a sphere [m, y]

/// The greatest gap between the stretches, seen from `floor` upwards: its lower and upper end.
Stretch greatestGap(std::vector<Stretch> stretches, double floor) {
    std::sort(stretches.begin(), stretches.end());
    Stretch gap{floor, floor};
    double top = floor;
    for (const auto& [low, high] : stretches) {
        if (low - top > gap.second - gap.first) gap = {top, low};
        top = std::max(top, high);
    }
    return gap;
}

}  // namespace

std::optional<Arch> archAbove(const geometry::Coil& coil, const Canister& canister, const Particles& particles) {
    const double diameter = 2 * meanActiveRadius(particles);
    if (!(diameter > 0)) return std::nullopt;
    const double slice = 2 * diameter;
    const double begin = std::max(coil.zStart, 0.0);
    const double end = std::min(coil.zStart + coil.length, canister.length);
    const int slices = static_cast<int>((end - begin) / slice);

    std::vector<std::vector<Stretch>> columns(std::max(slices, 0));
    for (std::size_t i = 0; i < particles.size(); ++i) {
        const Vec3& x = particles.position[i];
        const double place = std::floor((x.z - begin) / slice);
        if (particles.status[i] != Status::Active || std::abs(x.x) > coil.radius / 2) continue;
        if (place >= 0 && place < slices)
            columns[static_cast<std::size_t>(place)].emplace_back(x.y - particles.radius[i], x.y + particles.radius[i]);
    }
    Arch arch;
    for (int i = 0; i < slices; ++i) {
        const auto [low, high] = greatestGap(columns[i], -canister.width / 2);
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
