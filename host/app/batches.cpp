#include "host/app/batches.h"

#include <algorithm>
#include <tuple>

namespace vkdose {

std::vector<std::vector<int>> batchesOf(std::vector<BatchMember> members, const DeviceRoom& room, std::size_t most) {
    const auto key = [](const BatchMember& m) {
        const TableSizes& t = m.tables;
        return std::tuple(t.surfaces, t.surfaceKinds, t.kindSet, t.energyBook, -m.steps, m.number);
    };
    std::sort(members.begin(), members.end(), [&](const auto& a, const auto& b) { return key(a) < key(b); });
    std::vector<std::vector<int>> batches;
    std::vector<TableSizes> together;
    for (const BatchMember& m : members) {
        const bool alike = !together.empty() && together.front().shares(m.tables) && together.size() < most;
        together.push_back(m.tables);
        if (!alike || !fit(together, room)) {
            together = {m.tables};
            batches.emplace_back();
        }
        batches.back().push_back(m.number);
    }
    return batches;
}

}  // namespace vkdose
