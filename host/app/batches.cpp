#include "host/app/batches.h"

#include <algorithm>
#include <string>
#include <tuple>

#include "host/law/user_law.h"

namespace vkdose {

namespace {

/// The most canisters of this size, up to `most`, that fit the device; at least one.
std::size_t placesFor(const TableSizes& each, const DeviceRoom& room, std::size_t most) {
    std::size_t fits = 1, tooMany = most + 1;
    while (tooMany - fits > 1) {
        const std::size_t middle = (fits + tooMany) / 2;
        (fit(std::vector<TableSizes>(middle, each), room) ? fits : tooMany) = middle;
    }
    return fits;
}

}  // namespace

std::vector<Batch> batchesOf(std::vector<BatchMember> members, const DeviceRoom& room, std::size_t most) {
    const auto key = [](const BatchMember& m) {
        const TableSizes& t = m.tables;
        const std::string law = t.userLaw ? t.userLaw->hash : "";
        return std::tuple(t.surfaces, t.surfaceKinds, t.kindSet, t.energyBook, law, -double(t.allBytes()), m.number);
    };
    std::sort(members.begin(), members.end(), [&](const auto& a, const auto& b) { return key(a) < key(b); });
    std::vector<Batch> batches;
    for (auto first = members.begin(); first != members.end();) {
        TableSizes each = first->tables;
        const auto end = std::find_if(first, members.end(), [&](const BatchMember& m) {
            return !m.tables.shares(first->tables) || 2 * m.tables.allBytes() < first->tables.allBytes();
        });
        for (auto m = first; m != end; ++m) each.growTo(m->tables);
        std::sort(first, end, [](const BatchMember& a, const BatchMember& b) {
            return std::tuple(-a.steps, a.number) < std::tuple(-b.steps, b.number);
        });
        Batch& batch = batches.emplace_back();
        batch.places = placesFor(each, room, std::min(most, std::size_t(end - first)));
        for (; first != end; ++first) batch.members.push_back(first->number);
    }
    return batches;
}

}  // namespace vkdose
