#include "host/backend/vulkan/passes.h"

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "spirv/passes.h"

namespace vkdose {

namespace {

constexpr VkDeviceSize kVec4 = 16;

struct Elements {
    VkDeviceSize state, rows, ranges, history, coilHistory, anchors, entries, books, forces, torques;
    explicit Elements(const TableSizes& s)
        : state(2ull * gpu::kFields * s.particles()),
          rows(1ull * s.members * (s.rowEntries + s.linkEntries)),
          ranges(2ull * s.particles()),
          history(std::max<VkDeviceSize>(1, 1ull * s.historyParts() * s.springSlots())),
          coilHistory(std::max<VkDeviceSize>(1, 1ull * s.coilHistoryRows() * s.particles())),
          anchors(2ull * s.particles()),
          entries(2ull * s.slots()),
          books(s.energyBook ? 1ull * gpu::kBookFields * (s.particles() + s.slots()) : 1),
          forces(s.forceEntries()),
          torques(2ull * s.slots()) {}
};

Access accessOn(const vk::Device& device, const TableSizes& s) {
    const Elements e(s);
    const VkDeviceSize most =
        std::max({e.state, e.rows, e.ranges, e.history, e.coilHistory, e.anchors, e.entries, e.forces, e.torques});
    const bool texel = s.texelReads && most <= device.limits().maxTexelBufferElements;
    return {texel, texel && device.hasInt64()};
}

/// The variants of one pass (shaders/passes.cmake), as far as it has them.
struct Variants {
    using Code = std::span<const std::uint32_t>;
    Code plain, texel, packed, energy, texelEnergy, packedEnergy;

    Code pick(const Access& access, bool wantsEnergy) const {
        if (access.packedStores) return wantsEnergy ? packedEnergy : packed;
        if (access.texelReads) return wantsEnergy ? texelEnergy : texel;
        return wantsEnergy ? energy : plain;
    }
};

const Variants kBin{bin_spv, bin_texel_spv, bin_texel_spv, bin_spv, bin_texel_spv, bin_texel_spv};
const Variants kNeighbours{neighbours_spv, neighbours_texel_spv, neighbours_texel_spv,
                           neighbours_spv, neighbours_texel_spv, neighbours_texel_spv};
const Variants kNear{near_spv,        near_texel_spv,        near_texel_spv,
                     near_energy_spv, near_texel_energy_spv, near_texel_energy_spv};
const Variants kLink{link_spv,        link_texel_spv,        link_texel_spv,
                     link_energy_spv, link_texel_energy_spv, link_texel_energy_spv};
const Variants kPairs{pairs_spv,        pairs_texel_spv,        pairs_packed_spv,
                      pairs_energy_spv, pairs_texel_energy_spv, pairs_packed_energy_spv};
const Variants kSurfaces{surfaces_spv,        surfaces_texel_spv,        surfaces_packed_spv,
                         surfaces_energy_spv, surfaces_texel_energy_spv, surfaces_packed_energy_spv};
const Variants kCoil{coil_spv,        coil_texel_spv,        coil_packed_spv,
                     coil_energy_spv, coil_texel_energy_spv, coil_packed_energy_spv};
const Variants kMove{move_spv,        move_texel_spv,        move_packed_spv,
                     move_energy_spv, move_texel_energy_spv, move_packed_energy_spv};

}  // namespace

TableBytes tableBytes(const TableSizes& s) {
    const Elements e(s);
    const std::uint64_t records = 1ull * s.members * s.groups();
    TableBytes bytes;
    for (const std::uint64_t table :
         {e.state * kVec4, e.rows * 4, e.ranges * kVec4, e.history * kVec4, e.coilHistory * kVec4,
          s.members * sizeof(gpu::Member), sizeof(gpu::Dispatches) + s.members * sizeof(gpu::Control),
          (VkDeviceSize(s.members) * s.cells + s.particles()) * 4, e.anchors * kVec4,
          records * sizeof(gpu::SensorRecord), e.entries * 8, e.books * kVec4, records * sizeof(gpu::EnergyRecord),
          e.forces * kVec4, e.torques * kVec4, e.history * kVec4}) {
        bytes.all += table;
        bytes.longest = std::max(bytes.longest, table);
    }
    return bytes;
}

Passes::Passes(const vk::Device& device, const TableSizes& s) : Passes(device, s, accessOn(device, s)) {}

Passes::Passes(const vk::Device& device, const TableSizes& s, const Access& access)
    : state(device, "the particle state", Elements(s).state * kVec4, access.view(VK_FORMAT_R32G32B32A32_SFLOAT)),
      rows(device, "the neighbour rows", Elements(s).rows * 4, access.view(VK_FORMAT_R32_UINT)),
      ranges(device, "the ranges of rows", Elements(s).ranges * kVec4, access.view(VK_FORMAT_R32G32B32A32_UINT)),
      history(device, "the contact history", Elements(s).history * kVec4, access.view(VK_FORMAT_R32G32B32A32_SFLOAT)),
      coilHistory(device, "the coil's contact history", Elements(s).coilHistory * kVec4,
                  access.view(VK_FORMAT_R32G32B32A32_SFLOAT)),
      member(device, "the parameters", s.members * sizeof(gpu::Member), access.view(VK_FORMAT_R32G32B32A32_SFLOAT)),
      control(device, "the control block", sizeof(gpu::Dispatches) + s.members * sizeof(gpu::Control)),
      cells(device, "the cell table", (VkDeviceSize(s.members) * s.cells + s.particles()) * 4),
      anchors(device, "the anchors", Elements(s).anchors * kVec4, access.view(VK_FORMAT_R32G32B32A32_SFLOAT)),
      sensors(device, "the sensors", sizeof(gpu::SensorRecord) * s.members * s.groups()),
      entries(device, "the contact lists", Elements(s).entries * 8, access.view(VK_FORMAT_R32G32_UINT)),
      books(device, "the energy book", Elements(s).books * kVec4),
      energies(device, "the energy records", sizeof(gpu::EnergyRecord) * s.members * s.groups()),
      forces(device, "the contact forces", Elements(s).forces * kVec4, access.view(VK_FORMAT_R32G32B32A32_SFLOAT)),
      torques(device, "the contact torques", Elements(s).torques * kVec4, access.view(VK_FORMAT_R32G32B32A32_SFLOAT)),
      carried(device, "the carried history", Elements(s).history * kVec4),
      sizes(s),
      access_(access),
      bindings_(device,
                {&state, &rows, &ranges, &history, &coilHistory, &member, &control, &cells, &anchors, &sensors,
                 &entries, &books, &energies, &forces, &torques, &carried},
                access.texelReads ? std::vector<const vk::Buffer*>{&state, &rows, &ranges, &history, &coilHistory,
                                                                   &member, &anchors, &entries, &forces, &torques}
                                  : std::vector<const vk::Buffer*>{},
                sizeof(gpu::StepPush)),
      clear_(device, bindings_, clear_spv, constants(s)),
      bin_(device, bindings_, kBin.pick(access, s.energyBook), constants(s)),
      neighbours_(device, bindings_, kNeighbours.pick(access, s.energyBook), constants(s)),
      near_(device, bindings_, kNear.pick(access, s.energyBook), constants(s)),
      link_(device, bindings_, kLink.pick(access, s.energyBook), constants(s)),
      commitLists_(device, bindings_, commit_lists_spv, constants(s)),
      pairs_(device, bindings_, kPairs.pick(access, s.energyBook), constants(s)),
      surfaces_(device, bindings_, kSurfaces.pick(access, s.energyBook), constants(s)),
      coil_(device, bindings_, kCoil.pick(access, s.energyBook), constants(s)),
      move_(device, bindings_, kMove.pick(access, s.energyBook), constants(s)),
      decide_(device, bindings_, decide_spv, constants(s)),
      sense_(device, bindings_, sense_spv, constants(s)),
      senseEnergy_(device, bindings_, sense_energy_spv, constants(s)) {}

std::array<std::uint32_t, 7> Passes::constants(const TableSizes& s) {
    return {s.workgroup, s.surfaces, s.surfaceKinds, s.kindSet, s.members, s.mostGroups, s.front};
}

void Passes::reset() {
    const std::vector<gpu::uvec4> none(2ull * sizes.particles(), gpu::uvec4(0U));
    ranges.writeAll(none);
    if (sizes.coilSlots > 0) {
        const std::vector<gpu::vec4> angles(sizes.particles(), gpu::vec4(gpu::kNoTurn));
        coilHistory.writeAll(angles, kVec4 * (sizes.coilHistoryRows() - 1) * sizes.particles());
    }
    gpu::Control fresh{};
    fresh.call = fresh.error = gpu::uvec4(gpu::kEmpty);
    fresh.wanted = gpu::uvec4(1, 1, 0, 0);
    control.writeAll(std::vector<gpu::Control>(sizes.members, fresh), controlOffset(0));
    setLive(sizes.members);
}

void Passes::setLive(std::uint32_t live) {
    const auto groups = [&](std::uint32_t n) { return gpu::uvec4(sizes.inRow(n), live, sizes.layers(n), 0); };
    // Every step may ask for everything once more; from then on it is as many as there is work for.
    gpu::Dispatches d{};
    for (gpu::Dispatch& step : d.step) {
        step.cells = groups((sizes.cells + sizes.workgroup - 1) / sizes.workgroup);
        step.particles = step.refresh = groups(sizes.groups());
        step.settle = gpu::uvec4(1, 1, 1, 0);
    }
    d.pairs = groups(sizes.pairSlots / sizes.workgroup);
    d.surfaces = groups(sizes.surfaceSlots / sizes.workgroup);
    d.coil = groups(sizes.coilSlots / sizes.workgroup);
    control.write(0, &d, sizeof d);
    live_ = live;
}

std::vector<gpu::Control> Passes::controls() const {
    return control.readAll<gpu::Control>(sizes.members, controlOffset(0));
}

gpu::Control Passes::controlOf(std::uint32_t m) const {
    return control.readAll<gpu::Control>(1, controlOffset(m))[0];
}

void Passes::setControl(std::uint32_t m, const gpu::Control& c) {
    control.write(controlOffset(m), &c, sizeof c);
}

VkDeviceSize Passes::bytes() const {
    VkDeviceSize sum = 0;
    for (const vk::Buffer* b : {&state, &rows, &ranges, &history, &coilHistory, &member, &control, &cells, &anchors,
                                &sensors, &entries, &books, &energies, &forces, &torques, &carried})
        sum += b->size();
    return sum;
}

gpu::StepPush Passes::push(std::uint32_t step, std::uint32_t source, bool opening) const {
    gpu::StepPush p{};
    p.stepInBatch = step;
    p.source = source;
    p.opening = opening ? 1u : 0u;
    p.live = live_;
    p.particles = sizes.particles();
    p.share = sizes.share;
    p.cellMask = sizes.cells - 1;
    p.rowEntries = sizes.rowEntries;
    p.linkEntries = sizes.linkEntries;
    p.pairSlots = sizes.pairSlots;
    p.surfaceSlots = sizes.surfaceSlots;
    p.coilSlots = sizes.coilSlots;
    return p;
}

void Passes::recordSteps(vk::Commands& commands, std::uint32_t first, std::uint32_t count, std::uint32_t source,
                         bool opening, vk::Timestamps* times) const {
    const VkCommandBuffer c = commands.handle();
    bindings_.bind(c);
    if (times != nullptr) times->mark(commands);
    for (std::uint32_t n = first; n < first + count; ++n, source = 1 - source, opening = false) {
        const gpu::StepPush p = push(n, source, opening);
        bindings_.push(c, &p);
        // How many workgroups, the device decides: none for a rebuild or a refresh that no particle asked for.
        const VkDeviceSize step = offsetof(gpu::Dispatches, step) + source * sizeof(gpu::Dispatch);
        const struct {
            const vk::Pipeline& pass;
            VkDeviceSize arguments;
        } decided[] = {{clear_, step + offsetof(gpu::Dispatch, cells)},
                       {bin_, step + offsetof(gpu::Dispatch, particles)},
                       {neighbours_, step + offsetof(gpu::Dispatch, particles)},
                       {near_, step + offsetof(gpu::Dispatch, refresh)},
                       {link_, step + offsetof(gpu::Dispatch, refresh)},
                       {commitLists_, step + offsetof(gpu::Dispatch, settle)},
                       {pairs_, offsetof(gpu::Dispatches, pairs)},
                       {surfaces_, offsetof(gpu::Dispatches, surfaces)},
                       {coil_, offsetof(gpu::Dispatches, coil)}};
        for (const auto& d : decided) {
            d.pass.bind(c);
            commands.dispatchIndirect(control.handle(), d.arguments);
            commands.barrier();
            if (times != nullptr) times->mark(commands);
        }
        const struct {
            const vk::Pipeline& pass;
            std::uint32_t groups, rows;
        } fixed[] = {{move_, sizes.groups(), live_}, {decide_, 1, 1}};
        for (const auto& f : fixed) {
            f.pass.bind(c);
            commands.dispatch(sizes.inRow(f.groups), f.rows, sizes.layers(f.groups));
            commands.barrier();
            if (times != nullptr) times->mark(commands);
        }
    }
}

void Passes::recordSensing(vk::Commands& commands, std::uint32_t source, std::uint32_t row) const {
    const VkCommandBuffer c = commands.handle();
    bindings_.bind(c);
    gpu::StepPush p = push(0, source, false);
    p.firstRow = row;
    bindings_.push(c, &p);
    sense_.bind(c);
    commands.dispatch(sizes.inRow(sizes.groups()), 1, sizes.layers(sizes.groups()));
    commands.barrier();
}

void Passes::recordEnergySensing(vk::Commands& commands, std::uint32_t source, bool opening, std::uint32_t row) const {
    const VkCommandBuffer c = commands.handle();
    bindings_.bind(c);
    gpu::StepPush p = push(0, source, opening);
    p.firstRow = row;
    bindings_.push(c, &p);
    senseEnergy_.bind(c);
    commands.dispatch(sizes.inRow(sizes.groups()), 1, sizes.layers(sizes.groups()));
    commands.barrier();
}

}  // namespace vkdose
