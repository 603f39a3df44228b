// What an ensemble tells of its canisters: sensors, fields, particles, contacts, and the profile of its passes.

#include <algorithm>
#include <span>

#include "host/backend/vulkan/ensemble.h"
#include "host/backend/vulkan/pack.h"
#include "host/backend/vulkan/snapshot.h"
#include "host/core/error.h"
#include "host/vk/copy_bandwidth.h"

namespace vkdose {

namespace {

/// The sums over a member's groups.
Sensors sensorsOf(std::span<const gpu::GroupRecord> groups, const Vec3& period) {
    Sensors s;
    glm::dvec2 through(0);
    for (const gpu::GroupRecord& group : groups) {
        const gpu::SensorRecord& r = group.sensors;
        for (int region = 0; region < kRegions; ++region) {
            s.count[region] += r.count[region];
            s.mass[region] += double(r.mass[region]);
        }
        s.kineticEnergy += double(r.motion.x);
        s.rotationalEnergy += double(r.motion.y);
        s.throatMomentumZ += double(r.motion.z);
        s.maxOverlapRatio = std::max(s.maxOverlapRatio, double(r.extremes.x));
        through += glm::dvec2(double(r.extremes.y), double(r.extremes.z));
    }
    s.through = fromKept(through, period);
    return s;
}

EnergyBook energyOf(std::span<const gpu::GroupRecord> groups) {
    EnergyBook b;
    for (const gpu::GroupRecord& group : groups) {
        const gpu::EnergyRecord& r = group.energy;
        b.plastic += double(r.normal.x);
        b.adhesive += double(r.normal.y);
        b.viscous += double(r.normal.z);
        b.numerical += double(r.normal.w);
        b.sliding += double(r.sliders.x);
        b.rolling += double(r.sliders.y);
        b.torsion += double(r.sliders.z);
        b.loaded += double(r.flow.x);
        b.left += double(r.flow.y);
        b.kinetic += double(r.flow.z);
        b.rotational += double(r.flow.w);
        b.elasticNormal += double(r.elastic.x);
        b.elasticSliding += double(r.elastic.y);
        b.elasticRolling += double(r.elastic.z);
        b.elasticTorsion += double(r.elastic.w);
        b.momentum += Vec3(glm::vec3(r.momentum));
        b.potential += double(r.momentum.w);
        b.angularMomentum += Vec3(glm::vec3(r.angular));
        b.bodyWork += double(r.angular.w);
    }
    return b;
}

}  // namespace

VulkanProfile Ensemble::profile(std::uint32_t steps, double coilRate) {
    constexpr std::uint32_t kBatch = 32;
    VulkanProfile p;
    std::unique_ptr<PassTimes> times;
    if (vk::Timestamps::available(device_)) {
        times = std::make_unique<PassTimes>(device_, Passes::mostDispatches(kBatch));
        for (const char* name : Passes::names()) p.passes.push_back({name});
    }
    const gpu::uvec4 before = passes_->controlOf(0).list;
    while (p.steps < steps) {
        const std::uint32_t count = std::min(kBatch, steps - p.steps);
        runBatch(count, {coilRate}, times.get());
        if (failure(0)) throw RunError(*failure(0));
        p.steps += count;
    }
    for (std::size_t n = 0; n < p.passes.size(); ++n) p.passes[n].seconds = times->seconds(n);
    const gpu::uvec4 after = passes_->controlOf(0).list;
    p.rebuilds = after.y - before.y;
    p.refreshes = after.w - before.w;
    const std::size_t n = members_[0].loaded.size();
    for (const gpu::uvec4& range : passes_->ranges.readAll<gpu::uvec4>(n)) p.listed += range.y;
    p.listed /= double(n);
    p.tableBytes = double(passes_->bytes());
    p.copyBandwidth = vk::copyBandwidth(device_);
    p.texelReads = passes_->access.texelReads;
    return p;
}

std::vector<Sensors> Ensemble::sense(const std::vector<Look>& looks) {
    const std::uint32_t groups = passes_->sizes.groups();
    const VkDeviceSize recordBytes = sizeof(gpu::GroupRecord) * groups;
    const auto booked = [](const MemberState& m) { return m.world.energyBook && m.step > 0; };
    vk::Commands commands(device_);
    commands.begin();
    std::vector<vk::Buffer::Part> parts;
    for (const Look& look : looks) {
        const MemberState& m = members_[look.member];
        passes_->recordSensing(commands, m.row);
        if (booked(m)) passes_->recordEnergySensing(commands, m.step == 1, m.row);
        parts.push_back({recordBytes * look.member, recordBytes});
    }
    commands.hostBarrier();
    commands.submit();
    std::vector<gpu::GroupRecord> records(groups * looks.size());
    passes_->records.read(parts, records.data());
    const std::vector<gpu::Control> controls = passes_->allControls();
    std::vector<std::vector<BodyLoad>> loads = takeLoads(looks);
    std::vector<Sensors> all;
    for (std::size_t n = 0; n < looks.size(); ++n) {
        const MemberState& m = members_[looks[n].member];
        const std::span<const gpu::GroupRecord> own(records.data() + groups * n, groups);
        Sensors& s = all.emplace_back(sensorsOf(own, m.world.period));
        s.bodies = std::move(loads[n]);
        if (booked(m)) s.energy = energyOf(own);
        if (m.world.coil) {  // the last of allBodies
            const BodyLoad& coil = s.bodies.at(m.bodies.size() - 1);
            s.coilTorque = coil.torque;
            if (s.energy) {
                s.energy->coilWork = coil.work;
                s.energy->bodyWork -= s.energy->coilWork;
            }
        }
        s.rebuilds = controls[looks[n].member].list.y;
    }
    return all;
}

FieldPoints Ensemble::fields(std::uint32_t member, const FieldRequest& request) {
    if (const std::optional<std::string> fault = faultOf(request)) throw RunError(*fault);
    if (!fieldPasses_ || !fieldPasses_->holds(request))
        fieldPasses_ = std::make_unique<FieldPasses>(device_, *passes_, request.grid.points());
    const MemberState& m = members_[member];
    const std::vector<double>& radii = m.loaded.radius;
    return fieldPasses_->compute(request, {m.row, *std::max_element(radii.begin(), radii.end())});
}

Particles Ensemble::particles(std::uint32_t member) const {
    const TableSizes& t = passes_->sizes;
    std::vector<gpu::vec4> share;
    for (std::uint32_t couple = 0; couple < gpu::kFields / 2; ++couple) {
        const std::uint64_t row = members_[member].half() * (gpu::kFields / 2) + couple;
        const auto part = passes_->state.readAll<gpu::vec4>(
            2ULL * t.share, 2 * (row * t.particles() + std::uint64_t(member) * t.share) * sizeof(gpu::vec4));
        share.insert(share.end(), part.begin(), part.end());
    }
    const Particles& loaded = members_[member].loaded;
    const std::uint64_t lows = passes_->at.speedLowIndex(std::uint64_t(member) * t.share, 0);
    Particles now = unpackState(share, passes_->anchors.readAll<gpu::vec4>(2 * loaded.size(), lows * sizeof(gpu::vec4)),
                                t.share, loaded, members_[member].world.period);
    if (!t.properties()) return now;
    const std::uint64_t own = passes_->at.propertyIndex(std::uint64_t(member) * t.share, 0);
    unpackProperties(passes_->forces.readAll<gpu::vec4>(2 * loaded.size(), own * sizeof(gpu::vec4)), now);
    return now;
}

std::vector<Contact> Ensemble::contacts(std::uint32_t member) const {
    std::vector<Contact> contacts;
    const auto add = [&](ContactClass kind, std::uint32_t i, std::uint32_t other, const gpu::vec4& a,
                         const gpu::vec4& b, const gpu::vec4& force) {
        contacts.push_back(
            {kind, i, other, double(a.w), Vec3(glm::vec3(a)), Vec3(glm::vec3(b)), double(b.w), Vec3(glm::vec3(force))});
    };
    for (const SlotContact& c : touchingSlots(*passes_, member))
        add(c.pair ? ContactClass::ParticleParticle : ContactClass::ParticleWall, c.particle, c.other, c.history[0],
            c.history[1], c.force);
    for (const PlaceContact& c : touchingPlaces(*passes_, member)) {
        const MemberState& m = members_[member];
        add(classAtWall(m.bodies.at(c.body).material), c.particle, std::uint32_t(m.world.walls.size() + c.body),
            c.history[0], c.history[1], c.force);
    }
    std::stable_sort(contacts.begin(), contacts.end(),
                     [](const Contact& a, const Contact& b) { return a.particle < b.particle; });
    return contacts;
}

}  // namespace vkdose
