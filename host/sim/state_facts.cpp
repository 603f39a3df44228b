#include "host/sim/state_facts.h"

namespace vkdose {

StateFacts factsOf(const Record& run) {
    const auto& progress = run.get<std::uint64_t>("progress", 5);
    StateFacts facts;
    facts.radii = run.get<double>("radius");
    facts.step = progress[0];
    facts.active = progress[1];
    facts.dosing = progress[2] != 0;
    facts.settled = facts.dosing || run.arrays().contains("settling_counts");
    facts.sinceSample = progress[3] != 0;
    return facts;
}

}  // namespace vkdose
