#include "host/backend/vulkan/passes.h"

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "spirv/passes.h"

namespace vkdose {

namespace {

Access accessOn(const vk::Device& device, const TableSizes& s, const BodyTables* bodies) {
    std::uint64_t most = bodies != nullptr ? bodies->geometry.size() / sizeof(gpu::uvec4) : 0;
    for (const TableShape& table : TableCounts(s).shapes())
        if (table.view != VK_FORMAT_UNDEFINED) most = std::max(most, table.texels);
    const bool texel = s.texelReads && most <= device.limits().maxTexelBufferElements;
    return {texel, texel && device.hasInt64()};
}

/// The macros that choose the variant of a pass (shaders/passes.cmake).
unsigned macrosFor(const Access& access, const TableSizes& s) {
    return (access.texelReads ? spirv::TEXEL_READS : 0) | (access.packedStores ? spirv::PACKED_STORES : 0) |
           (s.energyBook ? spirv::ENERGY_BOOK : 0) | (s.bodies > 0 ? spirv::WITH_BODIES : 0);
}

/// The number of workgroups of a pass of a step.
enum class Extent {
    OfStep,     ///< the device decides for each step: `arguments` are in its gpu::Dispatch
    OfLists,    ///< the device decides at every refresh: `arguments` are in gpu::Dispatches
    Particles,  ///< those of all live members
    One,
};

struct StepPass {
    const char* name;
    std::span<const vk::Variant> variants;
    Extent extent;
    VkDeviceSize arguments = 0;
    bool readsBodies = false;  ///< binds the tables of shaders/shared/body_tables.h, if there are bodies
    bool forBodies = false;    ///< has nothing to do without bodies
};

/// A step: each pass waits for the one before.
constexpr std::array kStep{
    StepPass{"clear", spirv::clear, Extent::OfStep, offsetof(gpu::Dispatch, cells)},
    StepPass{"bin", spirv::bin, Extent::OfStep, offsetof(gpu::Dispatch, particles)},
    StepPass{"neighbours", spirv::neighbours, Extent::OfStep, offsetof(gpu::Dispatch, particles)},
    StepPass{"near", spirv::near, Extent::OfStep, offsetof(gpu::Dispatch, refresh), true},
    StepPass{"link", spirv::link, Extent::OfStep, offsetof(gpu::Dispatch, refresh)},
    StepPass{"commit_lists", spirv::commit_lists, Extent::OfStep, offsetof(gpu::Dispatch, settle)},
    StepPass{"pairs", spirv::pairs, Extent::OfLists, offsetof(gpu::Dispatches, pairs)},
    StepPass{"surfaces", spirv::surfaces, Extent::OfLists, offsetof(gpu::Dispatches, surfaces)},
    StepPass{"coil", spirv::coil, Extent::OfLists, offsetof(gpu::Dispatches, coil)},
    StepPass{"bodies", spirv::bodies, Extent::OfLists, offsetof(gpu::Dispatches, bodies), true, true},
    StepPass{"move", spirv::move, Extent::Particles},
    StepPass{"decide", spirv::decide, Extent::One},
};

}  // namespace

vk::Buffer Tables::make(const vk::Device& device, const TableSizes& sizes, const Access& access, std::size_t number) {
    const TableShape table = TableCounts(sizes).shapes()[number];
    return {device, table.title, table.bytes, access.texelReads ? table.view : VK_FORMAT_UNDEFINED};
}

Tables::Tables(const vk::Device& device, const TableSizes& s, const Access& a)
    : sizes(s),
      at(s),
      access(a)
#define TABLE(number, name, element, count, title) , name(make(device, s, a, number))
#include "shaders/shared/tables.h"
{
}

std::vector<const vk::Buffer*> Tables::all() const {
    return {
#define TABLE(number, name, element, count, title) &(name),
#include "shaders/shared/tables.h"
    };
}

VkDeviceSize Tables::bytes() const {
    VkDeviceSize sum = 0;
    for (const vk::Buffer* table : all()) sum += table->size();
    return sum;
}

BodyTables::BodyTables(const vk::Device& device, const std::vector<gpu::uvec4>& shapes, std::size_t motionCount,
                       std::size_t slots)
    : geometry(
          device, "the shapes of the bodies", shapes.size() * sizeof(gpu::uvec4),
          shapes.size() <= device.limits().maxTexelBufferElements ? VK_FORMAT_R32G32B32A32_UINT : VK_FORMAT_UNDEFINED),
      nearby(device, "the triangles near each particle",
             std::max<std::size_t>(1, slots) * gpu::kNearbyWords * sizeof(std::uint32_t)),
      motions(device, "the motions of the bodies", motionCount * sizeof(gpu::BodyMotion)) {
    geometry.writeAll(shapes);
}

std::vector<const vk::Buffer*> with(const BodyTables& bodies, std::vector<const vk::Buffer*> tables) {
#define TABLE(number, name, element, count, title) tables[number] = &bodies.name;
#include "shaders/shared/body_tables.h"
    return tables;
}

Passes::Passes(const vk::Device& device, const TableSizes& s, const BodyTables* bodyTables)
    : Tables(device, s, accessOn(device, s, bodyTables)),
      bodies(bodyTables),
      bindings_(device, all(), sizeof(gpu::StepPush)),
      sense_(device, bindings_, vk::pick(spirv::sense, macrosFor(access, s)), constants(s)),
      senseEnergy_(device, bindings_, vk::pick(spirv::sense_energy, macrosFor(access, s)), constants(s)) {
    if (bodies != nullptr)
        bodyBindings_ = std::make_unique<vk::BindingSet>(device, with(*bodies, all()), sizeof(gpu::StepPush));
    for (const StepPass& pass : kStep) {
        std::optional<vk::Pipeline>& made = step_.emplace_back();
        if (pass.forBodies && !bodyBindings_) continue;  // drivers take their time with it
        made.emplace(device, pass.readsBodies && bodyBindings_ ? *bodyBindings_ : bindings_,
                     vk::pick(pass.variants, macrosFor(access, s)), constants(s));
    }
}

std::vector<const char*> Passes::stepNames() {
    std::vector<const char*> names;
    for (const StepPass& pass : kStep) names.push_back(pass.name);
    return names;
}

std::array<std::uint32_t, 9> Passes::constants(const TableSizes& s) {
    return {s.workgroup,  s.surfaces, s.surfaceKinds, s.kindSet,   s.members,
            s.mostGroups, s.front,    s.bodies,       s.shapeKinds};
}

void Passes::reset() {
    const std::vector<gpu::uvec4> none((sizes.bodies > 0 ? 3ULL : 2ULL) * sizes.particles(), gpu::uvec4(0U));
    ranges.writeAll(none);
    if (sizes.coilSlots > 0) {
        const std::vector<gpu::vec4> angles(sizes.particles(), gpu::vec4(gpu::kNoTurn));
        coilHistory.writeAll(angles, sizeof(gpu::vec4) * at.wireAngleIndex(0));
    }
    gpu::Control fresh{};
    fresh.call = fresh.error = gpu::uvec4(gpu::kEmpty);
    fresh.wanted = gpu::uvec4(1, 1, 0, 0);
    controls.writeAll(std::vector<gpu::Control>(sizes.members, fresh), controlOffset(0));
    setLive(sizes.members);
}

void Passes::setLive(std::uint32_t live) {
    const auto groups = [&](std::uint32_t n) { return gpu::uvec4(sizes.inRow(n), live, sizes.layers(n), 0); };
    // The first time, every step dispatches the largest number of workgroups. After that the device sets the number
    // from the work there is.
    gpu::Dispatches d{};
    for (gpu::Dispatch& step : d.step) {
        step.cells = groups((sizes.cells + sizes.workgroup - 1) / sizes.workgroup);
        step.particles = step.refresh = groups(sizes.groups());
        step.settle = gpu::uvec4(1, 1, 1, 0);
    }
    d.pairs = groups(sizes.pairSlots / sizes.workgroup);
    d.surfaces = groups(sizes.surfaceSlots / sizes.workgroup);
    d.coil = groups(sizes.coilSlots / sizes.workgroup);
    d.bodies = groups(sizes.bodySlots / sizes.workgroup);
    controls.write(0, &d, sizeof d);
    live_ = live;
}

std::vector<gpu::Control> Passes::allControls() const {
    return controls.readAll<gpu::Control>(sizes.members, controlOffset(0));
}

gpu::Control Passes::controlOf(std::uint32_t m) const {
    return controls.readAll<gpu::Control>(1, controlOffset(m))[0];
}

void Passes::setControl(std::uint32_t m, const gpu::Control& c) {
    controls.write(controlOffset(m), &c, sizeof c);
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
    p.bodySlots = sizes.bodySlots;
    return p;
}

void Passes::dispatch(vk::Commands& commands, std::size_t n, std::uint32_t source) const {
    const StepPass& pass = kStep[n];
    switch (pass.extent) {
        case Extent::OfStep:
            commands.dispatchIndirect(
                controls.handle(), offsetof(gpu::Dispatches, step) + source * sizeof(gpu::Dispatch) + pass.arguments);
            return;
        case Extent::OfLists:
            commands.dispatchIndirect(controls.handle(), pass.arguments);
            return;
        case Extent::Particles:
            commands.dispatch(sizes.inRow(sizes.groups()), live_, sizes.layers(sizes.groups()));
            return;
        case Extent::One:
            commands.dispatch(1, 1, 1);
    }
}

void Passes::recordSteps(vk::Commands& commands, std::uint32_t first, std::uint32_t count, std::uint32_t source,
                         bool opening, vk::Timestamps* times) const {
    const VkCommandBuffer c = commands.handle();
    bindings_.bind(c);
    if (times != nullptr) times->mark(commands);
    for (std::uint32_t n = first; n < first + count; ++n, source = 1 - source, opening = false) {
        const gpu::StepPush p = push(n, source, opening);
        bindings_.push(c, &p);
        for (std::size_t k = 0; k < kStep.size(); ++k) {
            const bool ofBodies = kStep[k].readsBodies && bodyBindings_ != nullptr;
            if (ofBodies) bodyBindings_->bind(c);
            if (step_[k]) {
                step_[k]->bind(c);
                dispatch(commands, k, source);
                commands.barrier();
            }
            if (ofBodies) bindings_.bind(c);
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
