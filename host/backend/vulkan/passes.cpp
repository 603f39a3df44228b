#include "host/backend/vulkan/passes.h"

#include <algorithm>
#include <array>
#include <span>
#include <utility>
#include <vector>

#include "host/backend/vulkan/pass_code.h"
#include "host/backend/vulkan/store_trial.h"
#include "spirv/passes.h"

namespace vkdose {

glm::uvec2 addressWords(const vk::Buffer& table) {
    return {std::uint32_t(table.address()), std::uint32_t(table.address() >> 32)};
}

namespace {

Access accessOn(const vk::Device& device, const TableSizes& s, const BodyTables* bodies) {
    std::uint64_t most = 0;  // vectors of a table that has a view
    if (bodies != nullptr) most = std::max(bodies->geometry.size(), bodies->motions.size()) / sizeof(gpu::vec4);
    for (const TableShape& table : TableCounts(s).shapes())
        if (table.view != VK_FORMAT_UNDEFINED) most = std::max(most, table.texels);
    const bool texel = s.texelReads && most <= device.limits().maxTexelBufferElements;
    const bool tooLong = s.longestBytes() > device.limits().maxStorageBufferRange;
    const bool addressed = device.hasAddresses() && (s.addressed || tooLong);
    return {texel, texel && !addressed && storesFasterPacked(device), addressed};
}

/// The macros that choose the variant of a pass (shaders/passes.cmake).
unsigned macrosFor(const Access& access, const TableSizes& s) {
    return (access.texelReads ? spirv::TEXEL_READS : 0) | (access.packedStores ? spirv::PACKED_STORES : 0) |
           (s.energyBook ? spirv::ENERGY_BOOK : 0) | (s.bodies > 0 ? spirv::WITH_BODIES : 0);
}

/// The number of workgroups of a pass of a step.
enum class Extent {
    OfDevice,   ///< the device decides: `arguments` are in gpu::Dispatches
    Particles,  ///< those of all live members
    Bodies,     ///< one for each body of all live members
    One,
};

struct StepPass {
    const char* name;
    std::span<const vk::Variant> variants;
    Extent extent;
    VkDeviceSize arguments = 0;
    bool readsBodies = false;  ///< binds the tables of shaders/shared/body_tables.h, if there are bodies
    bool forBodies = false;    ///< has nothing to do without bodies
    std::uint32_t needs = 0;   ///< has nothing to do without all of these bits of TableSizes::shapeKinds
    bool knowsLaw = false;     ///< knows the law, or what contacts remember
    bool moves = false;        ///< adds up what a law lets flow
    bool oneFace = false;      ///< takes the sorted slots near one face
};

constexpr std::uint32_t kMeshes = 1U << gpu::kShapeMesh;

/// A stride: `decide`, the passes that make new lists, then steps of the other passes.
constexpr std::array kPasses{
    StepPass{.name = "decide", .variants = spirv::decide, .extent = Extent::One, .readsBodies = true},
    StepPass{.name = "clear",
             .variants = spirv::clear,
             .extent = Extent::OfDevice,
             .arguments = offsetof(gpu::Dispatches, heads)},
    StepPass{.name = "bin",
             .variants = spirv::bin,
             .extent = Extent::OfDevice,
             .arguments = offsetof(gpu::Dispatches, particles)},
    StepPass{.name = "neighbours",
             .variants = spirv::neighbours,
             .extent = Extent::OfDevice,
             .arguments = offsetof(gpu::Dispatches, particles)},
    StepPass{.name = "near",
             .variants = spirv::near,
             .extent = Extent::OfDevice,
             .arguments = offsetof(gpu::Dispatches, refresh),
             .readsBodies = true,
             .knowsLaw = true},
    StepPass{.name = "parts",
             .variants = spirv::parts,
             .extent = Extent::OfDevice,
             .arguments = offsetof(gpu::Dispatches, parts),
             .readsBodies = true,
             .forBodies = true,
             .needs = kMeshes},
    StepPass{.name = "link",
             .variants = spirv::link,
             .extent = Extent::OfDevice,
             .arguments = offsetof(gpu::Dispatches, refresh),
             .knowsLaw = true},
    StepPass{.name = "commit_lists",
             .variants = spirv::commit_lists,
             .extent = Extent::OfDevice,
             .arguments = offsetof(gpu::Dispatches, settle)},
    StepPass{.name = "pairs",
             .variants = spirv::pairs,
             .extent = Extent::OfDevice,
             .arguments = offsetof(gpu::Dispatches, pairs),
             .knowsLaw = true},
    StepPass{.name = "surfaces",
             .variants = spirv::surfaces,
             .extent = Extent::OfDevice,
             .arguments = offsetof(gpu::Dispatches, surfaces),
             .knowsLaw = true},
    StepPass{.name = "faces",
             .variants = spirv::bodies,
             .extent = Extent::OfDevice,
             .arguments = offsetof(gpu::Dispatches, faces),
             .readsBodies = true,
             .forBodies = true,
             .needs = kMeshes | gpu::kSortedSlots,
             .knowsLaw = true,
             .oneFace = true},
    StepPass{.name = "bodies",
             .variants = spirv::bodies,
             .extent = Extent::OfDevice,
             .arguments = offsetof(gpu::Dispatches, bodies),
             .readsBodies = true,
             .forBodies = true,
             .knowsLaw = true},
    StepPass{.name = "free_bodies",
             .variants = spirv::free_bodies,
             .extent = Extent::Bodies,
             .readsBodies = true,
             .forBodies = true,
             .needs = gpu::kFreeBodies},
    StepPass{.name = "move", .variants = spirv::move, .extent = Extent::Particles, .moves = true},
};
constexpr std::size_t kDecide = 0, kFirstOfStep = 8, kMove = kPasses.size() - 1, kFree = kMove - 1;

}  // namespace

vk::Buffer Tables::make(const vk::Device& device, const TableSizes& sizes, const Access& access, std::size_t number) {
    const TableShape table = TableCounts(sizes).shapes()[number];
    return {device, table.title, table.bytes, access.texelReads ? table.view : VK_FORMAT_UNDEFINED,
            access.addressed ? vk::Reach::Addressed : vk::Reach::Bound};
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

namespace {

/// The format of a view of so many vectors, if the device can have it.
VkFormat viewOf(const vk::Device& device, std::size_t vectors, VkFormat format) {
    return vectors <= device.limits().maxTexelBufferElements ? format : VK_FORMAT_UNDEFINED;
}

}  // namespace

BodyTables::BodyTables(const vk::Device& device, const std::vector<gpu::uvec4>& shapes, std::size_t motionCount,
                       std::size_t slots)
    : geometry(device, "the shapes of the bodies", shapes.size() * sizeof(gpu::uvec4),
               viewOf(device, shapes.size(), VK_FORMAT_R32G32B32A32_UINT)),
      nearby(device, "the triangles near each particle",
             std::max<std::size_t>(1, slots) * gpu::kNearbyWords * sizeof(std::uint32_t)),
      motions(device, "the motions of the bodies", motionCount * sizeof(gpu::BodyMotion),
              viewOf(device, motionCount * gpu::kMotionVectors, VK_FORMAT_R32G32B32A32_SFLOAT)) {
    geometry.writeAll(shapes);
}

std::vector<const vk::Buffer*> with(const BodyTables& bodies, std::vector<const vk::Buffer*> tables) {
#define TABLE(number, name, element, count, title) tables[number] = &bodies.name;
#include "shaders/shared/body_tables.h"
    return tables;
}

PassTimes::PassTimes(const vk::Device& device, std::uint32_t most)
    : times_(device, most + 1), seconds_(kPasses.size()) {}

void PassTimes::begin(vk::Commands& commands) {
    times_.reset(commands);
    marked_.clear();
    times_.mark(commands);
}

void PassTimes::mark(vk::Commands& commands, std::size_t n) {
    times_.mark(commands);
    marked_.push_back(n);
}

void PassTimes::add() {
    const std::vector<double> durations = times_.durations();
    for (std::size_t k = 0; k < durations.size(); ++k) seconds_[marked_[k]] += durations[k];
}

Passes::Passes(const vk::Device& device, const TableSizes& s, const BodyTables* bodyTables)
    : Tables(device, s, accessOn(device, s, bodyTables)),
      bodies(bodyTables),
      bindings_(device, all(), sizeof(gpu::StepPush)),
      validated_(device.validated()),
      sense_(device, bindings_, codeOf("sense", spirv::sense, false), constants(s)),
      senseEnergy_(device, bindings_, codeOf("sense_energy", spirv::sense_energy, false), constants(s)) {
    if (bodies != nullptr)
        bodyBindings_ = std::make_unique<vk::BindingSet>(device, with(*bodies, all()), sizeof(gpu::StepPush));
    for (const StepPass& pass : kPasses) {
        std::optional<vk::Pipeline>& made = passes_.emplace_back();
        if (pass.forBodies && !bodyBindings_) continue;  // drivers take their time with it
        if ((s.shapeKinds & pass.needs) != pass.needs) continue;
        made.emplace(
            device, pass.readsBodies && bodyBindings_ ? *bodyBindings_ : bindings_,
            codeOf(pass.oneFace ? "bodies" : pass.name, pass.variants, pass.knowsLaw || (pass.moves && s.properties())),
            constants(s, pass.oneFace));
    }
}

std::span<const std::uint32_t> Passes::codeOf(const char* name, std::span<const vk::Variant> variants,
                                              bool knowsLaw) const {
    const UserLaw* law = knowsLaw ? sizes.userLaw.get() : nullptr;
    return passCode(name, variants, {macrosFor(access, sizes), law, access.addressed});
}

std::vector<const char*> Passes::names() {
    std::vector<const char*> names;
    for (const StepPass& pass : kPasses) names.push_back(pass.name);
    return names;
}

std::array<std::uint32_t, 17> Passes::constants(const TableSizes& s, bool oneFace) {
    return {s.workgroup, s.surfaces, s.surfaceKinds, s.kindSet,   s.members,        s.mostGroups,
            s.front,     s.bodies,   s.shapeKinds,   s.laws,      s.mostPlaces,     s.powders,
            s.manyWalls, s.outlets,  s.periods,      s.wallLoads, oneFace ? 1U : 0U};
}

namespace {

/// Of a member that has made no step.
gpu::Control freshControl() {
    gpu::Control fresh{};
    fresh.call = fresh.error = gpu::uvec4(gpu::kEmpty);
    fresh.wanted = gpu::uvec4(0, 0, 1, 1);
    return fresh;
}

}  // namespace

void Passes::reset() {
    const std::vector<gpu::uvec4> none((sizes.bodies > 0 ? 3ULL : 2ULL) * sizes.particles(), gpu::uvec4(0U));
    ranges.writeAll(none);
    anchors.writeAll(std::vector<gpu::vec4>(2ULL * sizes.particles(), gpu::vec4(0.0f)),
                     at.speedLowIndex(0, 0) * sizeof(gpu::vec4));
    controls.writeAll(std::vector<gpu::Control>(sizes.members, freshControl()), controlOffset(0));
    setLive(sizes.members);
}

void Passes::reset(std::uint32_t member) {
    const std::uint64_t first = std::uint64_t(member) * sizes.share;
    const auto clear = [first, this](vk::Buffer& table, std::uint64_t count, VkDeviceSize element, auto place) {
        std::vector<vk::Buffer::Part> parts;
        for (std::uint64_t row = 0; row < count; ++row)
            parts.push_back({place(row, first) * element, sizes.share * element});
        table.clear(parts);
    };
    clear(ranges, sizes.bodies > 0 ? 3 : 2, sizeof(gpu::uvec4),
          [&](std::uint64_t row, std::uint64_t i) { return row * sizes.particles() + i; });
    anchors.clear({{at.speedLowIndex(first, 0) * sizeof(gpu::vec4), 2ULL * sizes.share * sizeof(gpu::vec4)}});
    // What is summed since the last sensing.
    clear(bodyLoads, std::uint64_t(gpu::kBodyLoads) * sizes.loaded(), sizeof(float),
          [&](std::uint64_t row, std::uint64_t i) { return at.bodyLoadIndex(row, i); });
    clear(books, sizes.energyBook ? gpu::kBookFields : 0, sizeof(gpu::vec4),
          [&](std::uint64_t row, std::uint64_t i) { return at.bookIndex(row, i); });
    setControl(member, freshControl());
}

void Passes::setLive(std::uint32_t live) {
    const auto groups = [&](std::uint32_t n) { return gpu::uvec4(sizes.inRow(n), live, sizes.layers(n), 0); };
    // The largest numbers of workgroups. The device sets the number from the work there is.
    gpu::Dispatches d{};
    d.heads = groups((sizes.cells + sizes.workgroup - 1) / sizes.workgroup);
    d.particles = d.refresh = groups(sizes.groups());
    d.parts = d.bodies = d.faces = groups(sizes.bodySlots / sizes.workgroup);
    d.settle = gpu::uvec4(1, 1, 1, 0);
    d.pairs = groups(sizes.pairSlots / sizes.workgroup);
    d.surfaces = groups(sizes.surfaceSlots / sizes.workgroup);
    const std::vector<const vk::Buffer*> tables = all();
    for (std::size_t n = 0; n < tables.size(); ++n) d.tables[n] = gpu::uvec4(addressWords(*tables[n]), 0, 0);
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

gpu::StepPush Passes::push(std::uint32_t step, bool opening) const {
    gpu::StepPush p{};
    p.stepInStride = step;
    p.opening = opening ? 1u : 0u;
    p.live = live_;
    p.particles = sizes.particles();
    p.share = sizes.share;
    p.cellMask = sizes.cells - 1;
    p.rowEntries = sizes.rowEntries;
    p.linkEntries = sizes.linkEntries;
    p.pairSlots = sizes.pairSlots;
    p.surfaceSlots = sizes.surfaceSlots;
    p.bodySlots = sizes.bodySlots;
    return p;
}

void Passes::record(vk::Commands& commands, std::size_t n) const {
    if (!passes_[n]) return;
    const StepPass& pass = kPasses[n];
    const bool ofBodies = pass.readsBodies && bodyBindings_ != nullptr;
    if (ofBodies) bodyBindings_->bind(commands.handle());
    passes_[n]->bind(commands.handle());
    switch (pass.extent) {
        case Extent::OfDevice:
            commands.dispatchIndirect(controls.handle(), pass.arguments);
            break;
        case Extent::Particles:
            commands.dispatch(sizes.inRow(sizes.groups()), live_, sizes.layers(sizes.groups()));
            break;
        case Extent::Bodies:
            commands.dispatch(sizes.bodies, live_, 1);
            break;
        case Extent::One:
            commands.dispatch(1, 1, 1);
    }
    if (ofBodies) bindings_.bind(commands.handle());
}

std::uint32_t Passes::mostDispatches(std::uint32_t count) {
    const std::uint32_t strides = (count + gpu::kStride - 1) / gpu::kStride + 1;  // the first may be short
    return std::uint32_t(1 + strides * kFirstOfStep + count * (kPasses.size() - kFirstOfStep));
}

void Passes::recordSteps(vk::Commands& commands, std::uint32_t count, bool opening, std::uint32_t late,
                         PassTimes* times) const {
    const VkCommandBuffer c = commands.handle();
    bindings_.bind(c);
    if (times != nullptr) times->begin(commands);
    const auto pushStep = [&](std::uint32_t step, bool first) {
        const gpu::StepPush p = push(step, first);
        bindings_.push(c, &p);
    };
    const auto one = [&](std::size_t n, bool waits) {
        record(commands, n);
        if (waits || times != nullptr) commands.barrier();
        if (times != nullptr) times->mark(commands, n);
    };
    pushStep(0, false);
    one(kDecide, true);
    for (std::uint32_t done = 0; done < count;) {
        const std::uint32_t stride = std::min(gpu::kStride - std::exchange(late, 0U), count - done);
        for (std::uint32_t step = 0; step < stride; ++step) {
            pushStep(step, opening && done + step == 0);
            if (step == 0)
                for (std::size_t n = kDecide + 1; n < kFirstOfStep; ++n)
                    if (passes_[n]) one(n, true);
            // Contacts of different kinds have different parts of the tables, and need not wait for one another. Nor
            // need particles and bodies that move. The validation layer knows whole tables only, so with it they do.
            for (std::size_t n = kFirstOfStep; n < kFree; ++n) one(n, n + 1 == kFree || validated_);
            if (passes_[kFree]) one(kFree, validated_);
            one(kMove, true);
        }
        pushStep(stride, false);
        one(kDecide, true);
        done += stride;
    }
}

void Passes::recordSensing(vk::Commands& commands, std::uint32_t row) const {
    const VkCommandBuffer c = commands.handle();
    bindings_.bind(c);
    gpu::StepPush p = push(0, false);
    p.firstRow = row;
    bindings_.push(c, &p);
    sense_.bind(c);
    commands.dispatch(sizes.inRow(sizes.groups()), 1, sizes.layers(sizes.groups()));
    commands.barrier();
}

void Passes::recordEnergySensing(vk::Commands& commands, bool opening, std::uint32_t row) const {
    const VkCommandBuffer c = commands.handle();
    bindings_.bind(c);
    gpu::StepPush p = push(0, opening);
    p.firstRow = row;
    bindings_.push(c, &p);
    senseEnergy_.bind(c);
    commands.dispatch(sizes.inRow(sizes.groups()), 1, sizes.layers(sizes.groups()));
    commands.barrier();
}

}  // namespace vkdose
