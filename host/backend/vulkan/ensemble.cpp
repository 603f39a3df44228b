#include "host/backend/vulkan/ensemble.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "host/backend/vulkan/pack.h"
#include "host/backend/vulkan/snapshot.h"
#include "host/core/error.h"
#include "host/law/law.h"
#include "host/law/user_law_state.h"
#include "host/model/user_law_trial.h"

namespace vkdose {

namespace {

static_assert(gpu::kRegionCanister == std::uint32_t(Region::Canister) &&
              gpu::kRegionThroat == std::uint32_t(Region::Throat) &&
              gpu::kRegionDosed == std::uint32_t(Region::Dosed) && gpu::kRegionLost == std::uint32_t(Region::Lost));

const char* text(std::uint32_t error) {
    switch (error) {
        case gpu::kErrorRowFull:
            return "has more neighbours than a row holds: use a smaller skin or a narrower size distribution";
        case gpu::kErrorCrowded:
            return "has thousands of others around it, within the size of the largest: use a narrower size "
                   "distribution or a smaller skin";
        case gpu::kErrorTables:
            return "finds no room in the tables of neighbours and contacts, which are sized for a dense packing: use a "
                   "smaller skin";
        case gpu::kErrorNan:
            return "has a position or velocity that is not a number: the time step is too large or two particles "
                   "started in one place";
        case gpu::kErrorOverlap:
            return "is in an overlap deeper than the case allows (contact.max_overlap_ratio, of the smaller radius): "
                   "use a smaller time step or a stiffer k; if a body pinches it, allow more";
        case gpu::kErrorLost:
            return "left the domain: close the boundaries around it (canister.lid = true if it flew out at the top), "
                   "give the domain more room there (domain.low, domain.high) or use a smaller time step";
        case gpu::kErrorFeatures:
            return "touches one body in more than four places, or more than 128 facets of its mesh at once: use "
                   "smaller spheres, a smoother body, a coarser mesh, or --backend reference";
        case gpu::kErrorForce:
            return "pushes a body that moves freely harder than the device can add up: give the body more mass, or use "
                   "a smaller time step";
        case gpu::kErrorLists:
            return "has other contacts in one pass than in another, which is a fault of the device or of this program: "
                   "use another device or --backend reference, and report this case";
        default:
            return "has an error that this program does not know: report this case";
    }
}

/// The same under a user's law, which may be at fault itself.
std::string text(std::uint32_t error, const UserLaw* law) {
    if (law != nullptr && error == gpu::kErrorNan)
        return fmt::format(
            "has a position or velocity that is not a number: the law {} answered something that is not a number, a "
            "stiffness that is not > 0 or is far above that of its trial, or a damping or pull that is not >= 0; or "
            "the time step is too large, or two particles started in one place",
            law->name);
    if (law != nullptr && error == gpu::kErrorOverlap)
        return fmt::format(
            "is in an overlap deeper than the case allows (contact.max_overlap_ratio, of the smaller radius): let the "
            "law {} push harder, let its stiffness be no less than the slope of its force, or use a smaller time "
            "step; if a body pinches the particle, allow more",
            law->name);
    if (law != nullptr && error == gpu::kErrorLost)
        return fmt::format("{}; if the law {} flung it out, let its stiffness be no less than the slope of its force",
                           text(error), law->name);
    return text(error);
}

}  // namespace

Ensemble::Ensemble(const VulkanOptions& options) : options_(options), device_(options.device) {
    const VkPhysicalDeviceLimits& limits = device_.limits();
    const std::uint32_t most = std::min(limits.maxComputeWorkGroupInvocations, limits.maxComputeWorkGroupSize[0]);
    if (options_.workgroup > most)
        throw DeviceError(fmt::format("workgroups of {} exceed the {} invocations of {}", options_.workgroup, most,
                                      device_.info().name));
    if (options_.addressed && !device_.hasAddresses())
        throw DeviceError(fmt::format("{} gives no addresses of buffers to shaders", device_.info().name));
}

Ensemble::MemberState Ensemble::newMember(const Canister& c) {
    if (c.particles.size() == 0) throw RunError("there are no particles to simulate");
    MemberState m;
    m.world = c.world;
    m.bodies = allBodies(c.world);
    m.loaded = c.particles;
    m.userLaw = c.law.user;
    m.block = packMember(c.world, c.law, c.particles);
    return m;
}

TableSizes Ensemble::sizesOf(const MemberState& m, std::uint32_t members, const DeviceShape& shape) {
    return tableSizes(m.world, Crowd(m.loaded), m.block, shape, members, m.userLaw);
}

Ensemble::Plan Ensemble::planFor(std::vector<MemberState> members) const {
    const VkPhysicalDeviceLimits& limits = device_.limits();
    if (members.size() > limits.maxComputeWorkGroupCount[1])
        throw DeviceError(fmt::format("{} canisters at once; {} allows {}", members.size(), device_.info().name,
                                      limits.maxComputeWorkGroupCount[1]));
    const std::uint32_t mostGroups = std::min(options_.mostGroups, limits.maxComputeWorkGroupCount[0]);
    Plan plan;
    const auto sizesWithin = [&](VkDeviceSize range) {
        plan.shape = {options_.workgroup, mostGroups, range};
        std::vector<TableSizes> rooms;
        for (const MemberState& m : members) rooms.push_back(sizesOf(m, std::uint32_t(members.size()), plan.shape));
        return roomForAll(rooms);
    };
    plan.sizes = sizesWithin(limits.maxStorageBufferRange);
    // Tables that are bound are the faster ones, so that only beds that they do not hold are reached by address.
    if (plan.sizes.longestBytes() > limits.maxStorageBufferRange) plan.sizes = sizesWithin(device_.longestBuffer());
    plan.sizes.addressed = options_.addressed;
    // A view is for memory that nothing writes meanwhile. The passes of contacts read and write their histories, and on
    // a GPU a read through a view may see a store that stands behind it in the same invocation.
    plan.sizes.texelReads = options_.reads == VulkanOptions::Reads::Automatic && device_.info().type == "CPU";
    plan.members = std::move(members);
    packAllBodies(plan);
    return plan;
}

void Ensemble::make(Plan plan) {
    recorded_.clear();
    fieldPasses_.reset();
    passes_.reset();  // the former tables make room for the new ones
    bodies_.reset();
    members_ = std::move(plan.members);
    shape_ = plan.shape;
    makeBodies(plan);
    try {
        passes_ = std::make_unique<Passes>(device_, plan.sizes, bodies_.get());
    } catch (const LawError& error) {
        const LawFault& first = error.faults.front();
        throw RunError(fmt::format("{}:{}: {}", plan.sizes.userLaw->name, first.line, first.problem));
    }
    const TableSizes& sizes = passes_->sizes;
    std::vector<gpu::vec4> half(std::size_t(gpu::kFields) * sizes.particles());
    for (std::uint32_t m = 0; m < members_.size(); ++m)
        packState(members_[m].loaded, sizes.share, std::size_t(m) * sizes.share, half);
    // Both halves, because a restored state goes on in that of its number of steps, and needs the padding there.
    passes_->state.writeAll(half);
    passes_->state.writeAll(half, half.size() * sizeof(gpu::vec4));
    passes_->reset();
    for (std::uint32_t m = 0; m < members_.size(); ++m) writeLows(*passes_, m, 0, members_[m].loaded);
    std::vector<std::uint32_t> all(members_.size());
    std::iota(all.begin(), all.end(), 0U);
    setLive(all);
}

void Ensemble::load(const std::vector<Canister>& canisters) {
    std::vector<MemberState> members;
    for (const Canister& c : canisters) members.push_back(newMember(c));
    make(planFor(std::move(members)));
}

void Ensemble::setLive(const std::vector<std::uint32_t>& members) {
    live_ = members;
    recorded_.clear();
    for (std::uint32_t row = 0; row < live_.size(); ++row) {
        members_[live_[row]].row = row;
        members_[row].block.roster.x = live_[row];
    }
    passes_->setLive(std::uint32_t(live_.size()));
    writeBlocks();
}

void Ensemble::writeBlocks() {
    std::vector<gpu::Member> blocks;
    for (const MemberState& m : members_) blocks.push_back(m.block);
    passes_->members.writeAll(blocks);
}

void Ensemble::setLaw(std::uint32_t member, const ContactLaw& law) {
    MemberState& m = members_[member];
    checkMaterials(m.world, law, m.loaded);
    if (float(longestReach(m.world, law, largestRadius(m.loaded))) > reachOf(m.block)) throw RunError(kReachesFarther);
    packLaw(law, m.block);
}

void Ensemble::setGravity(std::uint32_t member, const Vec3& gravity) {
    MemberState& m = members_[member];
    m.world.gravity = gravity;
    packGravity(m.world, m.block);
}

void Ensemble::addParticles(std::uint32_t member, std::size_t first, const std::vector<Vec3>& positions) {
    const MemberState& m = members_[member];
    Particles added;
    for (std::size_t k = 0; k < positions.size(); ++k)
        added.add(positions[k], m.loaded.radius.at(first + k),
                  velocityOfRest(m.world.timeStep, m.world.gravity, m.step), Vec3(0), m.loaded.material[first + k]);
    if (!m.loaded.properties.empty()) {
        const auto own = m.loaded.properties.begin() + std::ptrdiff_t(first);
        added.properties.assign(own, own + std::ptrdiff_t(positions.size()));
    }
    writeParticles(*passes_, member, first, added, m.half());
}

void Ensemble::setClocks(std::uint32_t member, const std::vector<BodyClock>& clocks) {
    members_[member].clocks = clocks;
}

Record Ensemble::snapshot(std::uint32_t member) const {
    const MemberState& m = members_[member];
    Record record;
    saveState(*passes_, member, m.loaded.size(), m.half(), record);
    record.putOne(kSnapshotSteps, m.step);
    putLaw(passes_->sizes.userLaw, record);
    record.putOne("drive", std::uint64_t(m.drive));
    saveFree(m, record);
    return record;
}

void Ensemble::restore(std::uint32_t member, const Record& record) {
    MemberState& m = members_[member];
    const auto step = record.one<std::uint64_t>(kSnapshotSteps);
    const auto drive = std::int64_t(record.one<std::uint64_t>("drive"));
    requireLaw(passes_->sizes.userLaw, record);
    restoreState(*passes_, member, m.loaded.size(), std::uint32_t(step), record);
    restoreFree(record, step, m);
    m.drive = drive;
    m.step = step;
    m.made = std::uint32_t(step);
}

void Ensemble::runBatch(std::uint32_t count, const std::vector<double>& coilRates, PassTimes* times) {
    bool opening = false;
    for (const std::uint32_t index : live_) {
        MemberState& m = members_[index];
        m.block.choices.y = m.step == 0 ? 1.0f : 0.0f;
        m.block.roster.y = m.made;
        m.block.roster.z = m.made + count;
        opening = opening || m.step == 0;
    }
    writeMotions(count, coilRates);
    writeBlocks();
    for (std::uint32_t left = count; left > 0; opening = false) {
        const std::uint32_t before = left;
        left = submit(left, opening, times);
        if (times != nullptr) times->add();
        if (left >= before) throw std::logic_error("a batch of steps does not come to its end");
    }
    for (const std::uint32_t index : live_) {
        MemberState& m = members_[index];
        m.drive += drivePerStep(coilRates[index], m.world.timeStep) * count;
        advanceClocks(m.clocks, count);
        m.step += count;
        readFree(m, count);
    }
}

std::uint32_t Ensemble::submit(std::uint32_t count, bool opening, PassTimes* times) {
    // Nothing in a recording tells when its steps are made. So a long one is kept, for whole strides; beyond the end of
    // the batch no member makes a step.
    constexpr std::uint32_t kLong = 8 * gpu::kStride;
    constexpr std::size_t kMostRecordings = 8;
    const auto record = [&](vk::Commands& commands, std::uint32_t steps, std::uint32_t late) {
        commands.begin();
        passes_->recordSteps(commands, steps, opening, late, times);
        commands.hostBarrier();
    };
    // A member whose strides begin at other steps than those of the recording makes some of its steps a submission
    // later.
    const std::uint32_t late = members_[live_.front()].late();
    if (opening || times != nullptr || count < kLong) {
        vk::Commands commands(device_);
        record(commands, count, late);
        commands.submit();
    } else {
        const std::uint32_t steps = (late + count + gpu::kStride - 1) / gpu::kStride * gpu::kStride;
        if (recorded_.size() >= kMostRecordings && !recorded_.contains(steps)) recorded_.clear();
        const auto [place, added] = recorded_.try_emplace(steps, device_);
        if (added) record(place->second, steps, 0);
        place->second.submit();
    }
    const std::vector<gpu::Control> controls = passes_->allControls();
    std::uint32_t left = 0;
    for (const std::uint32_t index : live_) {
        MemberState& m = members_[index];
        m.made = controls[index].steps.x;
        const gpu::uvec4& error = controls[index].error;
        if (error.x == gpu::kEmpty)
            left = std::max(left, m.block.roster.z - m.made);
        else if (!m.failure)
            keepError(index, error);
    }
    return left;
}

void Ensemble::advance(std::uint32_t steps, const std::vector<double>& coilRates) {
    for (std::uint32_t done = 0; done < steps;) {
        std::uint32_t asked = std::min(options_.batch > 0 ? options_.batch : pace_.count(), steps - done);
        if (bodies_) asked = std::min(asked, mostBatch_);
        // For speed alone: no batch ends within a stride for no reason.
        std::uint32_t count = asked;
        const std::uint32_t over = (members_[live_.front()].made + count) % gpu::kStride;
        if (options_.batch == 0 && done + count < steps && over < count) count -= over;
        pace_.begin();
        runBatch(count, coilRates);
        done += count;
        if (std::all_of(live_.begin(), live_.end(), [&](std::uint32_t m) { return failure(m).has_value(); })) return;
        pace_.end(asked);
    }
}

void Ensemble::keepError(std::uint32_t member, const gpu::uvec4& error) {
    MemberState& m = members_[member];
    const std::uint32_t i = error.z - member * passes_->sizes.share;
    const Particles now = particles(member);
    const Vec3& x = now.position[i];
    const std::uint64_t step = m.step + error.x;
    m.failure = fmt::format("particle {} (radius {:.6g} m) at ({:.6g}, {:.6g}, {:.6g}) m {} (step {}, t = {:.6g} s)", i,
                            now.radius[i], x.x, x.y, x.z, text(error.y, passes_->sizes.userLaw.get()), step,
                            double(step) * m.world.timeStep);
}

}  // namespace vkdose
