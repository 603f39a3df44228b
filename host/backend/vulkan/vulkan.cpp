#include "host/backend/vulkan/vulkan.h"

#include <stdexcept>

#include "host/backend/vulkan/rendezvous.h"
#include "host/core/error.h"

namespace vkdose {

namespace {

/// One canister of an ensemble.
class VulkanBackend final : public Backend {
    template <class Use>
    auto alone(Use use) const {
        requireLoaded();
        return ensemble_->alone(guest_, use);
    }

  public:
    VulkanBackend(std::shared_ptr<Rendezvous> ensemble, std::size_t guest)
        : ensemble_(std::move(ensemble)), guest_(guest) {}
    ~VulkanBackend() override {
        try {
            ensemble_->leave(guest_);
        } catch (...) {  // members that stay get the device's error
        }
    }
    VulkanBackend(const VulkanBackend&) = delete;
    VulkanBackend& operator=(const VulkanBackend&) = delete;

    void load(const World& world, const ContactLaw& law, const Particles& particles) override {
        loaded_ = false;
        ensemble_->load(guest_, world, law, particles);
        loaded_ = true;
        timeStep_ = world.timeStep;
        angle_ = 0;
    }
    void setLaw(const ContactLaw& law) override {
        alone([&](Ensemble& e, std::uint32_t member) { e.setLaw(member, law); });
    }
    void setGravity(const Vec3& gravity) override {
        alone([&](Ensemble& e, std::uint32_t member) { e.setGravity(member, gravity); });
    }
    void addParticles(std::size_t first, const std::vector<Vec3>& positions) override {
        alone([&](Ensemble& e, std::uint32_t member) { e.addParticles(member, first, positions); });
    }
    void setClocks(const std::vector<BodyClock>& clocks) override {
        requireLoaded();
        alone([&](Ensemble& e, std::uint32_t member) { e.setClocks(member, clocks); });
    }
    Sensors advance(std::uint32_t steps, double coilRate) override {
        requireLoaded();
        Sensors sensors = ensemble_->advance(guest_, steps, coilRate);
        angle_ += coilRate * timeStep_ * steps;  // a product, so that rounding does not pile up
        return sensors;
    }
    double particleStepsPerCall() const override {
        // A large card makes 1e8 to 3.6e9 a second, by the size of the bed; one within a processor some 1e8.
        return ensemble_->device().info().isGpu() ? 2e8 : Backend::particleStepsPerCall();
    }
    Record snapshot() const override {
        Record record = alone([](Ensemble& e, std::uint32_t member) { return e.snapshot(member); });
        record.putOne("coil_angle", angle_);
        return record;
    }
    void restore(const Record& record) override {
        const auto angle = record.one<double>("coil_angle");
        alone([&](Ensemble& e, std::uint32_t member) { e.restore(member, record); });
        angle_ = angle;
    }
    Particles particles() const override {
        return alone([](Ensemble& e, std::uint32_t member) { return e.particles(member); });
    }
    std::vector<FreeBody> freeBodies() const override {
        return alone([](Ensemble& e, std::uint32_t member) { return e.freeBodies(member); });
    }
    std::vector<Contact> contacts() const override {
        return alone([](Ensemble& e, std::uint32_t member) { return e.contacts(member); });
    }
    FieldPoints fields(const FieldRequest& request) override {
        return alone([&](Ensemble& e, std::uint32_t member) { return e.fields(member, request); });
    }
    double coilAngle() const override { return angle_; }
    std::string description() const override { return "vulkan: " + ensemble_->device().info().name; }

    double tableBytes() const {
        return alone([](Ensemble& e, std::uint32_t) { return double(e.tableBytes()); });
    }
    std::uint32_t refreshes() const {
        return alone([](Ensemble& e, std::uint32_t member) { return e.refreshes(member); });
    }
    ValidationReport validation() const {
        return ensemble_->alone(guest_, [](Ensemble& e, std::uint32_t) {
            return ValidationReport{e.device().validated(), e.device().validationMessages()};
        });
    }
    VulkanProfile profile(std::uint32_t steps, double coilRate) {
        VulkanProfile p = alone([&](Ensemble& e, std::uint32_t) { return e.profile(steps, coilRate); });
        angle_ += coilRate * timeStep_ * p.steps;
        return p;
    }

  private:
    void requireLoaded() const {
        if (!loaded_) throw RunError("the device holds no particles: the world could not be loaded");
    }

    std::shared_ptr<Rendezvous> ensemble_;
    std::size_t guest_;
    bool loaded_ = false;
    double timeStep_ = 0;
    double angle_ = 0;  // of the coil since load, for people
};

}  // namespace

VulkanEnsemble::VulkanEnsemble(const VulkanOptions& options) : rendezvous_(std::make_shared<Rendezvous>(options)) {}

std::unique_ptr<Backend> VulkanEnsemble::enter() {
    return std::make_unique<VulkanBackend>(rendezvous_, rendezvous_->enter());
}

std::vector<std::unique_ptr<Backend>> makeVulkanEnsemble(const VulkanOptions& options, std::size_t members) {
    VulkanEnsemble ensemble(options);
    std::vector<std::unique_ptr<Backend>> backends;
    while (backends.size() < members) backends.push_back(ensemble.enter());
    return backends;
}

std::unique_ptr<Backend> makeVulkanBackend(const VulkanOptions& options) {
    return VulkanEnsemble(options).enter();
}

VulkanProfile profile(Backend& backend, std::uint32_t steps, double coilRate) {
    auto* vulkan = dynamic_cast<VulkanBackend*>(&backend);
    if (vulkan == nullptr) throw std::invalid_argument("only a Vulkan backend has a profile");
    return vulkan->profile(steps, coilRate);
}

double tableBytes(const Backend& backend) {
    const auto* vulkan = dynamic_cast<const VulkanBackend*>(&backend);
    if (vulkan == nullptr) throw std::invalid_argument("only a Vulkan backend has tables on a device");
    return vulkan->tableBytes();
}

std::uint32_t refreshes(const Backend& backend) {
    const auto* vulkan = dynamic_cast<const VulkanBackend*>(&backend);
    if (vulkan == nullptr) throw std::invalid_argument("only a Vulkan backend makes contact lists");
    return vulkan->refreshes();
}

double stepBytes(double touching, double touchingWalls) {
    constexpr double kVector = 16, kIndex = 4;
    const double pairs = touching / 2;
    const double own = (2 * gpu::kFields + 7) * kVector;  // state in and out, range, anchors, low parts in and out
    const double gathered = (touching + touchingWalls) * (kIndex + 2 * kVector);
    const double pair =
        2 * kIndex + (2 * gpu::kFields + 2 * 2 + 3) * kVector;  // who, both states, history, what it exerts
    const double wall = 2 * kIndex + (gpu::kFields + 4 + 2 * 2 + 2) * kVector;  // ditto with the surface's parameters
    return own + gathered + pairs * pair + touchingWalls * wall;
}

ValidationReport validationReport(const Backend& backend) {
    const auto* vulkan = dynamic_cast<const VulkanBackend*>(&backend);
    if (vulkan == nullptr) return {};
    return vulkan->validation();
}

}  // namespace vkdose
