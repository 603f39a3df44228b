#include "host/sim/expected_steps.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vkdose {

namespace {

/// For `doses` doses to a mass, which take as long as those before them (before the first: as expected).
std::uint64_t stepsToMass(const Case& c, const Timeline& timeline, const RunResult& soFar, double doses) {
    if (soFar.doses.empty()) return static_cast<std::uint64_t>(soFar.derived.steps);
    const double settled = timeline.time(timeline.settleSteps());
    const double each = (soFar.doses.back().endTime - settled) / static_cast<double>(soFar.doses.size());
    const double time = std::min(settled + doses * each, c.schedule.stop.endTime);
    return static_cast<std::uint64_t>(time / c.world.timeStep);
}

}  // namespace

std::uint64_t expectedSteps(const Case& c, const Timeline& timeline, const RunResult& soFar) {
    if (!timeline.hasDoses()) return timeline.stepsUntilDose(0);
    double done = 0, dosed = 0;
    for (const Dose& d : soFar.doses) {
        done += 1;
        dosed += d.mass;
    }
    const double perDose = dosed > 0 ? dosed / done : soFar.derived.massPerDose;
    const StopRule& rule = c.schedule.stop;
    double doses = static_cast<double>(rule.maxDoses);
    if (perDose > 0) {
        const double left = soFar.ledger.filledMass() - soFar.dosedWhileSettling - dosed;
        doses = std::min(doses, done + std::max(1.0, std::ceil(left / perDose)));
    }
    const bool unknown =
        perDose <= 0 && rule.maxDoses == std::numeric_limits<int>::max() && !std::isfinite(rule.endTime);
    if (unknown) return 0;
    return c.schedule.targetMass > 0 ? stepsToMass(c, timeline, soFar, doses) : timeline.stepsUntilDose(doses);
}

}  // namespace vkdose
