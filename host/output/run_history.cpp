#include "host/output/run_history.h"

#include <cmath>

namespace vkdose {

std::vector<DoseArch> archesAtDoseEnds(const Frames& frames, const Case& c, const std::vector<Dose>& doses) {
    std::vector<DoseArch> arches;
    if (!c.world.coil || !c.canister || frames.entries().empty()) return arches;
    const double reach = c.frames.interval / 2 * (1 + 1e-9);  // half way between two frames counts
    for (const Dose& d : doses) {
        if (!d.complete) continue;
        const FrameEntry& entry = frames.entries()[nearestOf(frames.entries(), d.endTime)];
        if (std::abs(entry.time - d.endTime) > reach) continue;
        const Frame frame = frames.read(entry);
        const BodyPoses bodies = bodyPoses(c.world, frame.time, frame.coilAngle, frame.bodiesMoved);
        arches.push_back(
            {d.index, entry.time, archAbove(*c.world.coil, *c.canister, frame.particles, c.world, bodies)});
    }
    return arches;
}

std::vector<FlowSample> flowIn(const std::filesystem::path& folder) {
    const Table series = Table::salvage(folder / "timeseries.csv");
    return series.rows() > 0 ? flowSamples(series) : std::vector<FlowSample>();
}

RunHistory historyOf(const std::filesystem::path& folder, const Case& c, const RunResult& result) {
    RunHistory history;
    if (const std::vector<FlowSample> samples = flowIn(folder); !samples.empty()) {
        history.outlet = outletFlow(samples, result.ledger.filledMass());
        history.rate = massRate(samples, windowRuleOf(c));
        history.cycles = cyclesOf(samples, cycleRuleOf(c));
    }
    history.arches = archesAtDoseEnds(Frames(folder), c, result.doses);
    history.measures = measuresOf(folder, c, result);
    return history;
}

}  // namespace vkdose
