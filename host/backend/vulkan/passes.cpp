#include "host/backend/vulkan/passes.h"

#include <array>
#include <span>

#include "bin.spv.h"
#include "clear.spv.h"
#include "commit.spv.h"
#include "neighbours.spv.h"
#include "neighbours_energy.spv.h"
#include "sense.spv.h"
#include "sense_energy.spv.h"
#include "step.spv.h"
#include "step_energy.spv.h"
#include "step_texel.spv.h"
#include "step_texel_energy.spv.h"

namespace vkdose {

namespace {

constexpr VkDeviceSize kVec4 = 16;

struct Elements {
    VkDeviceSize state, rows, history, wallHistory, books;
    explicit Elements(const TableSizes& s)
        : state(2ull * gpu::kFields * s.particles),
          rows(2ull * s.rowWidth * s.particles),
          history(2ull * s.rowWidth * s.historyParts() * s.particles),
          wallHistory((1ull * s.historyParts() * s.wallSlots() + 1) * s.particles),
          books(s.energyBook ? 1ull * gpu::kBookFields * s.particles : 1) {}
};

bool viewsFit(const vk::Device& device, const TableSizes& s) {
    const Elements e(s);
    const VkDeviceSize limit = device.limits().maxTexelBufferElements;
    return s.texelReads && e.state <= limit && e.rows <= limit && e.history <= limit && e.wallHistory <= limit;
}

VkFormat viewFormat(bool texel, VkFormat format) {
    return texel ? format : VK_FORMAT_UNDEFINED;
}

std::array<std::uint32_t, 4> constants(const TableSizes& s) {
    return {s.workgroup, 1u, s.surfaces, s.surfaceKinds};
}

std::span<const std::uint32_t> stepCode(bool texel, bool energy) {
    using Code = std::span<const std::uint32_t>;
    if (energy) return texel ? Code(step_texel_energy_spv) : Code(step_energy_spv);
    return texel ? Code(step_texel_spv) : Code(step_spv);
}

std::span<const std::uint32_t> neighboursCode(bool energy) {
    using Code = std::span<const std::uint32_t>;
    return energy ? Code(neighbours_energy_spv) : Code(neighbours_spv);
}

}  // namespace

Passes::Passes(const vk::Device& device, const TableSizes& s)
    : state(device, "the particle state", Elements(s).state * kVec4,
            viewFormat(viewsFit(device, s), VK_FORMAT_R32G32B32A32_SFLOAT)),
      rows(device, "the neighbour rows", Elements(s).rows * 4, viewFormat(viewsFit(device, s), VK_FORMAT_R32_UINT)),
      marks(device, "the touch marks", s.particles * kVec4),
      history(device, "the contact history", Elements(s).history * kVec4,
              viewFormat(viewsFit(device, s), VK_FORMAT_R32G32B32A32_SFLOAT)),
      wallHistory(device, "the wall history", Elements(s).wallHistory * kVec4,
                  viewFormat(viewsFit(device, s), VK_FORMAT_R32G32B32A32_SFLOAT)),
      members(device, "the members", sizeof(gpu::Member)),
      control(device, "the control block", sizeof(gpu::Control)),
      cells(device, "the cell table", (VkDeviceSize(s.cells) + s.particles) * 4),
      anchors(device, "the anchors", s.particles * kVec4),
      sensors(device, "the sensors", s.groups() * sizeof(gpu::SensorRecord)),
      groupMember(device, "the workgroups' members", s.groups() * 4ull),
      books(device, "the energy book", Elements(s).books * kVec4),
      energies(device, "the energy records", s.groups() * sizeof(gpu::EnergyRecord)),
      sizes(s),
      texel_(viewsFit(device, s)),
      bindings_(device,
                {&state, &rows, &marks, &history, &wallHistory, &members, &control, &cells, &anchors, &sensors,
                 &groupMember, &books, &energies},
                texel_ ? std::vector<const vk::Buffer*>{&state, &rows, &history, &wallHistory}
                       : std::vector<const vk::Buffer*>{},
                sizeof(gpu::StepPush)),
      clear_(device, bindings_, clear_spv, constants(s)),
      bin_(device, bindings_, bin_spv, constants(s)),
      neighbours_(device, bindings_, neighboursCode(s.energyBook), constants(s)),
      commit_(device, bindings_, commit_spv, constants(s)),
      step_(device, bindings_, stepCode(texel_, s.energyBook), constants(s)),
      sense_(device, bindings_, sense_spv, constants(s)),
      senseEnergy_(device, bindings_, sense_energy_spv, constants(s)) {}

VkDeviceSize Passes::bytes() const {
    VkDeviceSize sum = 0;
    for (const vk::Buffer* b : {&state, &rows, &marks, &history, &wallHistory, &members, &control, &cells, &anchors,
                                &sensors, &groupMember, &books, &energies})
        sum += b->size();
    return sum;
}

gpu::StepPush Passes::push(std::uint32_t step, std::uint32_t source, bool opening) const {
    gpu::StepPush p{};
    p.stepInBatch = step;
    p.source = source;
    p.opening = opening ? 1u : 0u;
    p.particles = sizes.particles;
    p.rowWidth = sizes.rowWidth;
    p.cellMask = sizes.cells - 1;
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
        // The rebuild: zero workgroups each unless the step before asked for it.
        const struct {
            const vk::Pipeline& pass;
            VkDeviceSize arguments;
        } rebuild[] = {{clear_, offsetof(gpu::Control, cells)},
                       {bin_, offsetof(gpu::Control, particles)},
                       {neighbours_, offsetof(gpu::Control, particles)},
                       {commit_, offsetof(gpu::Control, single)}};
        for (const auto& r : rebuild) {
            r.pass.bind(c);
            commands.dispatchIndirect(control.handle(), r.arguments);
            commands.barrier();
            if (times != nullptr) times->mark(commands);
        }
        step_.bind(c);
        commands.dispatch(sizes.groups());
        commands.barrier();
        if (times != nullptr) times->mark(commands);
    }
}

void Passes::recordSensing(vk::Commands& commands, std::uint32_t source) const {
    const VkCommandBuffer c = commands.handle();
    bindings_.bind(c);
    const gpu::StepPush p = push(0, source, false);
    bindings_.push(c, &p);
    sense_.bind(c);
    commands.dispatch(sizes.groups());
    commands.barrier();
}

void Passes::recordEnergySensing(vk::Commands& commands, std::uint32_t source, bool opening) const {
    const VkCommandBuffer c = commands.handle();
    bindings_.bind(c);
    const gpu::StepPush p = push(0, source, opening);
    bindings_.push(c, &p);
    senseEnergy_.bind(c);
    commands.dispatch(sizes.groups());
    commands.barrier();
}

}  // namespace vkdose
