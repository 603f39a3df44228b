#include "host/backend/vulkan/vulkan.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <stdexcept>

#include "host/backend/vulkan/pack.h"
#include "host/backend/vulkan/passes.h"
#include "host/backend/vulkan/snapshot.h"
#include "host/vk/copy_bandwidth.h"

namespace vkdose {

namespace {

const char* text(std::uint32_t error) {
    switch (error) {
        case gpu::kErrorRowFull:
            return "has more neighbours than a row holds: use a smaller skin or a narrower size distribution";
        case gpu::kErrorCrowded:
            return "has thousands of others around it, within the size of the largest: use a narrower size distribution "
                   "or a smaller skin";
        case gpu::kErrorTables:
            return "finds no room in the tables of neighbours and contacts, which are sized for a dense packing: use a "
                   "smaller skin";
        case gpu::kErrorNan:
            return "has a position or velocity that is not a number: the time step is too large or two particles "
                   "started in one place";
        case gpu::kErrorOverlap:
            return "is in an overlap deeper than the case allows (contact.max_overlap_ratio, of the smaller radius): use "
                   "a smaller time step or a stiffer k; if it is pinched between coil and wall, allow more";
        case gpu::kErrorLost:
            return "left the domain: enlarge the domain, or look for a gap between the surfaces";
        case gpu::kErrorTurns:
            return "touches more turns of the coil than there are slots: use a larger pitch";
        default:
            return "met the coil where the search for its closest point did not converge: report this case";
    }
}

class VulkanBackend final : public Backend {
  public:
    explicit VulkanBackend(const VulkanOptions& options) : options_(options), device_(options.device) {
        const VkPhysicalDeviceLimits& limits = device_.limits();
        const std::uint32_t most = std::min(limits.maxComputeWorkGroupInvocations, limits.maxComputeWorkGroupSize[0]);
        if (options_.workgroup > most)
            throw DeviceError(fmt::format("workgroups of {} exceed the {} invocations of {}", options_.workgroup, most,
                                          device_.info().name));
    }

    void load(const World& world, const Particles& particles) override;
    void setLaw(const ContactLaw& law) override {
        packLaw(law, member_);
        world_.law = law;
    }
    Sensors advance(std::uint32_t steps, double coilRate) override;
    Record snapshot() const override;
    void restore(const Record& record) override;
    Particles particles() const override;
    std::vector<Contact> contacts() const override;
    double coilAngle() const override { return angle_; }
    std::string description() const override { return "vulkan: " + device_.info().name; }
    const vk::Device& device() const { return device_; }
    VulkanProfile profile(std::uint32_t steps, double coilRate);

  private:
    void requireDispatch(std::uint32_t groups) const {
        const std::uint32_t most = device_.limits().maxComputeWorkGroupCount[0];
        if (groups > most)
            throw DeviceError(
                fmt::format("the particles need dispatches of {} workgroups, but {} allows {}: use fewer "
                            "particles or another device",
                            groups, device_.info().name, most));
    }
    void runBatch(std::uint32_t count, double coilRate, vk::Timestamps* times = nullptr);
    Sensors sense(std::uint32_t steps);
    EnergyBook readEnergy() const;
    void throwErrors(std::uint64_t firstStep) const;
    std::string nameParticle(std::uint32_t i) const;

    VulkanOptions options_;
    vk::Device device_;
    std::unique_ptr<Passes> passes_;
    World world_;
    Particles loaded_;
    gpu::Member member_{};
    std::uint32_t source_ = 0;  // half of the state that is current
    std::uint64_t step_ = 0;
    double angle_ = 0;          // of the coil since load, for people
    std::uint64_t turned_ = 0;  // the same for the device: exact, so that it matters not how steps are cut into batches
    std::uint32_t batch_ = 16;  // steps per submission, adapted to the device
};

void VulkanBackend::load(const World& world, const Particles& particles) {
    if (particles.size() == 0) throw RunError("there are no particles to simulate");
    member_ = packMember(world, particles);
    world_ = world;
    loaded_ = particles;
    TableSizes sizes =
        tableSizes(world, particles, member_, options_.workgroup, device_.limits().maxStorageBufferRange);
    sizes.texelReads = options_.reads == VulkanOptions::Reads::Automatic;
    requireDispatch(std::max({sizes.groups(), sizes.cells / sizes.workgroup + 1, sizes.slots() / sizes.workgroup}));
    passes_ = std::make_unique<Passes>(device_, sizes);
    passes_->state.writeAll(packState(particles, sizes.particles));
    passes_->reset();
    source_ = 0;
    step_ = 0;
    angle_ = 0;
    turned_ = 0;
}

Record VulkanBackend::snapshot() const {
    Record record;
    saveState(*passes_, loaded_.size(), source_, record);
    record.putOne("steps", step_);
    record.putOne("coil_angle", angle_);
    record.putOne("coil_phase", turned_);
    return record;
}

void VulkanBackend::restore(const Record& record) {
    const auto steps = record.one<std::uint64_t>("steps");
    const auto angle = record.one<double>("coil_angle");
    const auto phase = record.one<std::uint64_t>("coil_phase");
    restoreState(*passes_, loaded_.size(), record);
    source_ = 0;
    step_ = steps;
    angle_ = angle;
    turned_ = phase;
}

void VulkanBackend::runBatch(std::uint32_t count, double coilRate, vk::Timestamps* times) {
    const std::uint64_t perStep = turnsFixed(coilRate * world_.timeStep);
    packPhase(turnsFixed(world_.coil ? world_.coil->startAngle : 0.0) + turned_, perStep, member_);
    member_.coil.motion.x = float(coilRate);
    passes_->member.write(0, &member_, sizeof member_);
    vk::Commands commands(device_);
    commands.begin();
    if (times != nullptr) times->reset(commands);
    passes_->recordSteps(commands, 0, count, source_, step_ == 0, times);
    commands.hostBarrier();
    commands.submit();
    source_ = (source_ + count) % 2;
    turned_ += perStep * count;
    throwErrors(step_);
    step_ += count;
}

Sensors VulkanBackend::advance(std::uint32_t steps, double coilRate) {
    using clock = std::chrono::steady_clock;
    // Long submissions starve the display and trip watchdogs, short ones waste time on the fence: aim between.
    constexpr double kShortest = 0.05, kLongest = 0.25;
    constexpr std::uint32_t kMostSteps = 4096;
    const double angleBefore = angle_;
    for (std::uint32_t done = 0; done < steps;) {
        const std::uint32_t count = std::min(options_.batch > 0 ? options_.batch : batch_, steps - done);
        const auto start = clock::now();
        runBatch(count, coilRate);
        done += count;
        angle_ = angleBefore + coilRate * world_.timeStep * done;  // a product, so that rounding does not pile up
        const double seconds = std::chrono::duration<double>(clock::now() - start).count();
        if (count == batch_ && seconds < kShortest && batch_ < kMostSteps) batch_ *= 2;
        if (seconds > kLongest && batch_ > 1) batch_ /= 2;
    }
    return sense(steps);
}

VulkanProfile VulkanBackend::profile(std::uint32_t steps, double coilRate) {
    constexpr std::uint32_t kBatch = 32;
    const std::size_t kinds = Passes::kTimed.size();
    const auto lists = [&] { return passes_->control.readAll<gpu::Control>(1)[0].list; };
    VulkanProfile p;
    std::unique_ptr<vk::Timestamps> times;
    if (vk::Timestamps::available(device_)) {
        times = std::make_unique<vk::Timestamps>(device_, std::uint32_t(kBatch * kinds + 1));
        for (const char* name : Passes::kTimed) p.passes.push_back({name});
    }
    const gpu::uvec4 before = lists();
    const double angleBefore = angle_;
    for (; p.steps < steps; angle_ = angleBefore + coilRate * world_.timeStep * p.steps) {
        const std::uint32_t count = std::min(kBatch, steps - p.steps);
        runBatch(count, coilRate, times.get());
        p.steps += count;
        if (!times) continue;
        const std::vector<double> seconds = times->durations();
        for (std::size_t i = 0; i < seconds.size(); ++i) p.passes[i % kinds].seconds += seconds[i];
    }
    p.rebuilds = lists().y - before.y;
    p.refreshes = lists().w - before.w;
    const auto ranges = passes_->ranges.readAll<gpu::uvec4>(loaded_.size());
    for (const gpu::uvec4& range : ranges) p.listed += range.y;
    p.listed /= double(loaded_.size());
    p.tableBytes = double(passes_->bytes());
    p.copyBandwidth = vk::copyBandwidth(device_);
    p.texelReads = passes_->texelReads();
    return p;
}

Sensors VulkanBackend::sense(std::uint32_t steps) {
    vk::Commands commands(device_);
    commands.begin();
    if (step_ == 0) passes_->member.write(0, &member_, sizeof member_);
    passes_->recordSensing(commands, source_);
    const bool energy = world_.energyBook && step_ > 0;
    if (energy) passes_->recordEnergySensing(commands, source_, step_ == 1);
    commands.hostBarrier();
    commands.submit();
    Sensors s;
    for (const gpu::SensorRecord& r : passes_->sensors.readAll<gpu::SensorRecord>(passes_->sizes.groups())) {
        for (int region = 0; region < kRegions; ++region) {
            s.count[region] += r.count[region];
            s.mass[region] += double(r.mass[region]);
        }
        s.kineticEnergy += double(r.motion.x);
        s.rotationalEnergy += double(r.motion.y);
        s.throatMomentumZ += double(r.motion.z);
        s.coilTorque += double(r.motion.w);
        s.maxOverlapRatio = std::max(s.maxOverlapRatio, double(r.extremes.x));
    }
    s.coilTorque = steps > 0 ? s.coilTorque / steps : 0.0;
    if (energy) s.energy = readEnergy();
    s.rebuilds = passes_->control.readAll<gpu::Control>(1)[0].list.y;
    return s;
}

EnergyBook VulkanBackend::readEnergy() const {
    EnergyBook b;
    for (const gpu::EnergyRecord& r : passes_->energies.readAll<gpu::EnergyRecord>(passes_->sizes.groups())) {
        b.plastic += double(r.normal.x);
        b.adhesive += double(r.normal.y);
        b.viscous += double(r.normal.z);
        b.numerical += double(r.normal.w);
        b.sliding += double(r.sliders.x);
        b.rolling += double(r.sliders.y);
        b.torsion += double(r.sliders.z);
        b.coilWork += double(r.sliders.w);
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
    }
    return b;
}

std::string VulkanBackend::nameParticle(std::uint32_t i) const {
    const Particles now = particles();
    const Vec3& x = now.position[i];
    return fmt::format("particle {} (radius {:.6g} m) at ({:.6g}, {:.6g}, {:.6g}) m", i, now.radius[i], x.x, x.y, x.z);
}

void VulkanBackend::throwErrors(std::uint64_t firstStep) const {
    const gpu::uvec4 error = passes_->control.readAll<gpu::Control>(1)[0].error;
    if (error.x == gpu::kEmpty) return;
    const std::uint64_t step = firstStep + error.x;
    throw RunError(fmt::format("{} {} (step {}, t = {:.6g} s)", nameParticle(error.z), text(error.y), step,
                               double(step) * world_.timeStep));
}

Particles VulkanBackend::particles() const {
    const std::size_t slots = passes_->sizes.particles;
    return unpackState(passes_->state.readAll<gpu::vec4>(gpu::kFields * slots, source_ * gpu::kFields * slots * 16),
                       slots, loaded_);
}

std::vector<Contact> VulkanBackend::contacts() const {
    const TableSizes& t = passes_->sizes;
    std::vector<Contact> contacts;
    const auto add = [&](ContactClass kind, std::uint32_t i, std::uint32_t other, const gpu::vec4& a,
                         const gpu::vec4& b) {
        contacts.push_back({kind, i, other, double(a.w), Vec3(glm::vec3(a)), Vec3(glm::vec3(b)), double(b.w)});
    };
    for (const SlotContact& c : touchingSlots(*passes_))
        add(c.pair ? ContactClass::ParticleParticle : ContactClass::ParticleWall, c.particle, c.other, c.history[0],
            c.history[1]);
    if (t.coilSlots > 0) {
        const std::size_t n = t.particles, parts = t.historyParts();
        const auto coil = passes_->coilHistory.readAll<gpu::vec4>(t.coilHistoryRows() * n);
        for (std::uint32_t i = 0; i < loaded_.size(); ++i)
            for (std::uint32_t turn = 0; turn < gpu::kMaxTurns; ++turn)
                if (coil[gpu::kMaxTurns * parts * n + i][int(turn)] != gpu::kNoTurn)
                    add(ContactClass::ParticleCoil, i, turn, coil[turn * parts * n + i],
                        coil[(turn * parts + 1) * n + i]);
    }
    std::stable_sort(contacts.begin(), contacts.end(),
                     [](const Contact& a, const Contact& b) { return a.particle < b.particle; });
    return contacts;
}

}  // namespace

std::unique_ptr<Backend> makeVulkanBackend(const VulkanOptions& options) {
    return std::make_unique<VulkanBackend>(options);
}

VulkanProfile profile(Backend& backend, std::uint32_t steps, double coilRate) {
    auto* vulkan = dynamic_cast<VulkanBackend*>(&backend);
    if (vulkan == nullptr) throw std::invalid_argument("only a Vulkan backend has a profile");
    return vulkan->profile(steps, coilRate);
}

double stepBytes(double touching, double touchingWalls) {
    constexpr double kVector = 16, kIndex = 4;
    const double pairs = touching / 2;
    const double own = (2 * gpu::kFields + 3) * kVector;  // state in and out, range, anchors
    const double gathered = (touching + touchingWalls) * (kIndex + 2 * kVector);
    const double pair =
        2 * kIndex + (2 * gpu::kFields + 2 * 2 + 3) * kVector;  // who, both states, history, what it exerts
    const double wall = 2 * kIndex + (gpu::kFields + 4 + 2 * 2 + 2) * kVector;  // ditto with the surface's parameters
    return own + gathered + pairs * pair + touchingWalls * wall;
}

ValidationReport validationReport(const Backend& backend) {
    const auto* vulkan = dynamic_cast<const VulkanBackend*>(&backend);
    if (vulkan == nullptr) return {};
    return {vulkan->device().validated(), vulkan->device().validationMessages()};
}

}  // namespace vkdose
