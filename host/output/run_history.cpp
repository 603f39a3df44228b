#include "host/output/run_history.h"

#include <cmath>

namespace vkdose {

std::vector<DoseArch> archesAtDoseEnds(const Frames& frames, const Case& c, const std::vector<Dose>& doses) {
    std::vector<DoseArch> arches;
    if (!c.world.coil || !c.canister || frames.entries().empty()) return arches;
    const double reach = c.frames.interval / 2 * (1 + 1e-9);  // half way between two frames counts
    for (const Dose& d : doses) {
        const double planned = d.startTime + c.schedule.rotateTime + c.schedule.restTime;
        const double end = std::isfinite(d.endTime) ? d.endTime : planned;  // an older table does not tell it
        const FrameEntry& entry = frames.entries()[nearestOf(frames.entries(), end)];
        if (!d.complete || std::abs(entry.time - end) > reach) continue;
        const Frame frame = frames.read(entry);
        const BodyPoses bodies = bodyPoses(c.world, frame.time, frame.coilAngle, frame.bodiesMoved);
        arches.push_back(
            {d.index, entry.time, archAbove(*c.world.coil, *c.canister, frame.particles, c.world, bodies)});
    }
    return arches;
}

RunHistory historyOf(const std::filesystem::path& folder, const Case& c, const RunResult& result) {
    RunHistory history;
    const Table series = Table::salvage(folder / "timeseries.csv");
    if (series.rows() > 0) history.outlet = outletFlow(flowSamples(series), result.ledger.filledMass());
    history.arches = archesAtDoseEnds(Frames(folder), c, result.doses);
    history.measures = measuresOf(folder, c, result);
    return history;
}

}  // namespace vkdose
