// Canisters that come to an ensemble while others go on in it.

#include <utility>

#include "host/backend/vulkan/ensemble.h"
#include "host/backend/vulkan/pack.h"
#include "host/backend/vulkan/snapshot.h"
#include "host/core/error.h"

namespace vkdose {

bool Ensemble::replace(std::uint32_t member, const Canister& canister) {
    MemberState m = newMember(canister);
    TableSizes needed = sizesOf(m, passes_->sizes.members, shape_);
    PackedBodies packed;
    const MemberState& former = members_[member];
    if (bodies_) {
        packed = packedBodies(m, needed);
        if (packed.table.size() > former.shapes) return false;
        m.shapes = former.shapes;
        m.block.bodies = gpu::uvec4(m.bodies.size(), former.block.bodies.y, 0, 0);
    }
    if (!passes_->sizes.holds(needed)) return false;
    std::swap(members_[member], m);
    if (!boundBatch()) {
        std::swap(members_[member], m);
        boundBatch();
        return false;
    }
    if (bodies_) bodies_->geometry.writeAll(packed.table, members_[member].block.bodies.y * sizeof(gpu::uvec4));
    const std::size_t share = passes_->sizes.share;
    std::vector<gpu::vec4> state(gpu::kFields * share);
    packState(members_[member].loaded, share, 0, state);
    // Both halves, because a restored state goes on in that of its number of steps, and needs the padding there.
    for (const std::uint32_t half : {0U, 1U}) writeState(*passes_, member, 0, state, half);
    passes_->reset(member);
    writeLows(*passes_, member, 0, members_[member].loaded);
    return true;
}

void Ensemble::enlarge(const std::vector<std::uint32_t>& stay, const std::vector<Canister>& beside) {
    std::vector<MemberState> members;
    std::vector<Record> states;
    std::vector<std::vector<float>> loads;  // on bodies, of calls that are not over
    for (const std::uint32_t index : stay) {
        states.push_back(snapshot(index));
        const std::vector<vk::Buffer::Part> rows = loadRows(index);
        std::vector<float>& values = loads.emplace_back(rows.size() * members_[index].loaded.size());
        passes_->bodyLoads.read(rows, values.data());
        members.push_back(members_[index]);
        members.back().made = 0;
    }
    for (const Canister& c : beside) members.push_back(newMember(c));
    make(planFor(std::move(members)));
    for (std::uint32_t m = 0; m < stay.size(); ++m) {
        restore(m, states[m]);
        const float* value = loads[m].data();
        for (const vk::Buffer::Part& row : loadRows(m)) {
            passes_->bodyLoads.write(row.offset, value, row.bytes);
            value += row.bytes / sizeof(float);
        }
    }
}

}  // namespace vkdose
