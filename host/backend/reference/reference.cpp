#include "host/backend/reference/reference.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "host/backend/reference/forces.h"
#include "host/backend/reference/free_motion.h"
#include "host/backend/reference/neighbours.h"
#include "host/backend/reference/properties.h"
#include "host/core/error.h"
#include "host/law/law_checks.h"
#include "host/law/user_law_state.h"

namespace vkdose {

namespace {

using reference::Deepest;
using reference::Drive;
using reference::Forces;
using reference::Loads;
using reference::Neighbours;

bool finite(const Vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// In directions that repeat, any place is.
bool inside(const World& world, const Vec3& x) {
    for (int d = 0; d < 3; ++d)
        if (world.period[d] == 0 && !(x[d] >= world.domain.low[d] && x[d] <= world.domain.high[d])) return false;
    return true;
}

std::string nameOf(const Deepest& deepest, const World& world) {
    if (deepest.kind == ContactClass::ParticleParticle)
        return fmt::format("particles {} and {}", deepest.particle, deepest.other);
    if (deepest.other < world.walls.size()) {
        const std::string& name = world.walls[deepest.other].name;
        return fmt::format("particle {} and wall {}", deepest.particle,
                           name.empty() ? fmt::format("{}", deepest.other) : fmt::format("\"{}\"", name));
    }
    const std::size_t body = deepest.other - world.walls.size();
    if (body == world.bodies.size()) return fmt::format("particle {} and the coil", deepest.particle);
    return fmt::format("particle {} and body \"{}\"", deepest.particle, world.bodies[body].name);
}

class ReferenceBackend final : public Backend {
  public:
    void load(const World& world, const ContactLaw& law, const Particles& particles) override {
        try {
            forces_.follow(law);
        } catch (const LawRefused& refused) {
            throw RunError(fmt::format("{}:{}: {}: {}", law.user->file, refused.fault.line, refused.fault.problem,
                                       refused.fault.remedy));
        }
        checkMaterials(world, law, particles);
        world_ = {world, law};
        particles_ = particles;
        forces_.reset(particles.size(), world);
        loads_ = {};
        reach_ = reachIn(law);
        neighbours_.reset(world.skin, reach_, 0, world.period);
        if (world.repeats()) particles_.gone.assign(particles.size(), glm::ivec3(0));
        steps_ = 0;
        angle_ = 0;
        clocks_.clear();
        free_ = freeAtStart(world.bodies);
        book_ = {};
    }

    void setLaw(const ContactLaw& law) override {
        checkMaterials(world_, law, particles_);
        if (reachIn(law) > reach_) throw RunError(kReachesFarther);
        world_.law = law;
    }
    void setGravity(const Vec3& gravity) override { world_.gravity = gravity; }
    void addParticles(std::size_t first, const std::vector<Vec3>& positions) override;
    void setClocks(const std::vector<BodyClock>& clocks) override { clocks_ = clocks; }

    Sensors advance(std::uint32_t steps, double coilRate) override;

    Record snapshot() const override;
    void restore(const Record& record) override;

    Particles particles() const override { return particles_; }
    std::vector<FreeBody> freeBodies() const override;
    std::vector<Contact> contacts() const override { return forces_.contacts(); }
    FieldPoints fields(const FieldRequest& request) override {
        if (const std::optional<std::string> fault = faultOf(request)) throw RunError(*fault);
        return reference::coarseGrain(request, world_, particles_, loads_.branches);
    }
    double coilAngle() const override { return angle_; }
    std::string description() const override { return "reference"; }

  private:
    void step(double coilRate);
    void move(std::size_t i, double kick);
    void settleStatus(std::size_t i);
    void bookStep(bool opening);
    void refuseDeepOverlap() const;
    Sensors sense() const;

    /// Kinetic, rotational and potential energy of a particle at the full step that was made last (EnergyBook) [J].
    struct Mechanical {
        double kinetic, rotational, potential;
        double sum() const { return kinetic + rotational + potential; }
    };
    Mechanical mechanicalEnergy(std::size_t i) const;
    EnergyBook senseEnergy() const;

    double reachIn(const ContactLaw& law) const { return longestReach(world_, law, largestRadius(particles_)); }
    double mass(std::size_t i) const {
        return world_.density(particles_.material[i]) * (4.0 / 3.0) * kPi * particles_.radius[i] *
               particles_.radius[i] * particles_.radius[i];
    }
    std::string when() const {
        return fmt::format("step {} (t = {:.6g} s)", steps_, static_cast<double>(steps_) * world_.timeStep);
    }

    RuledWorld world_;
    Particles particles_;
    double reach_ = 0;  ///< how far beyond touch a contact may hold [m]
    Neighbours neighbours_;
    Forces forces_;
    Loads loads_;
    Particles before_;  ///< state before the last step; velocities are half a step before its forces; for the book
    EnergyBook book_;   ///< losses and works of the call so far
    std::uint64_t steps_ = 0;        ///< since load
    double angle_ = 0;               ///< of the coil since load [rad]
    std::vector<BodyClock> clocks_;  ///< of bodies that move in phases; empty: they stand
    std::vector<FreeBody> free_;     ///< of the world's bodies those that move freely
    std::string lost_;               ///< the first loss of the step, as an error message
};

Record ReferenceBackend::snapshot() const {
    const auto flat = [](const std::vector<Vec3>& vectors) {
        std::vector<double> values;
        for (const Vec3& v : vectors) values.insert(values.end(), {v.x, v.y, v.z});
        return values;
    };
    std::vector<std::uint32_t> status;
    for (const Status s : particles_.status) status.push_back(static_cast<std::uint32_t>(s));
    Record record;
    record.put("position", flat(particles_.position));
    record.put("velocity", flat(particles_.velocity));
    record.put("spin", flat(particles_.spin));
    record.put("status", std::move(status));
    reference::saveProperties(particles_, record);
    if (world_.repeats()) {
        std::vector<Vec3> gone;
        for (const glm::ivec3& g : particles_.gone) gone.emplace_back(g);
        record.put("periods_gone", flat(gone));
    }
    record.putOne(kSnapshotSteps, steps_);
    record.putOne("coil_angle", angle_);
    record.putOne("rebuilds", neighbours_.builds());
    record.put("list_anchor", flat(neighbours_.anchors()));
    if (moveFreely(world_.bodies)) reference::saveFreeBodies(free_, record);
    putLaw(world_.law.user, record);
    forces_.save(record);
    return record;
}

void ReferenceBackend::restore(const Record& record) {
    const std::size_t n = particles_.size();
    requireLaw(world_.law.user, record);
    const auto vectors = [&](const char* name, std::vector<Vec3>& to) {
        const auto& values = record.get<double>(name, 3 * to.size());
        for (std::size_t i = 0; i < to.size(); ++i) to[i] = Vec3(values[3 * i], values[3 * i + 1], values[3 * i + 2]);
    };
    vectors("position", particles_.position);
    vectors("velocity", particles_.velocity);
    vectors("spin", particles_.spin);
    const auto& status = record.get<std::uint32_t>("status", n);
    for (std::size_t i = 0; i < n; ++i) particles_.status[i] = static_cast<Status>(status[i]);
    reference::restoreProperties(record, particles_);
    if (world_.repeats()) {
        std::vector<Vec3> gone(n);
        vectors("periods_gone", gone);
        for (std::size_t i = 0; i < n; ++i) particles_.gone[i] = glm::ivec3(gone[i]);
    }
    if (moveFreely(world_.bodies)) reference::restoreFreeBodies(record, free_);
    steps_ = record.one<std::uint64_t>(kSnapshotSteps);
    angle_ = record.one<double>("coil_angle");
    neighbours_.reset(world_.skin, reach_, 0, world_.period);
    const auto builds = record.one<std::uint64_t>("rebuilds");
    std::vector<Vec3> anchors(record.get<double>("list_anchor").empty() ? 0 : n);
    vectors("list_anchor", anchors);
    neighbours_.restore(particles_, anchors, builds);
    book_ = {};
    loads_ = {};
    forces_.reset(n, world_);
    forces_.restore(record);
}

void ReferenceBackend::addParticles(std::size_t first, const std::vector<Vec3>& positions) {
    for (std::size_t k = 0; k < positions.size(); ++k) {
        particles_.position.at(first + k) = positions[k];
        particles_.velocity[first + k] = velocityOfRest(world_.timeStep, world_.gravity, steps_);
        particles_.status[first + k] = Status::Active;
    }
    neighbours_.reset(world_.skin, reach_, neighbours_.builds(), world_.period);
}

Sensors ReferenceBackend::advance(std::uint32_t steps, double coilRate) {
    double deepest = 0;
    std::vector<BodyLoad> bodies(loadNames(world_).size());
    const double start = angle_;
    book_ = {};
    for (std::uint32_t n = 0; n < steps; ++n) {
        step(coilRate);
        angle_ = start + coilRate * world_.timeStep * (n + 1);  // a product, so that rounding does not pile up
        for (std::size_t b = 0; b < bodies.size(); ++b) {
            bodies[b].force += loads_.bodies[b].force / double(steps);
            bodies[b].torque += loads_.bodies[b].torque / double(steps);
            bodies[b].work += loads_.bodies[b].work;
        }
        deepest = std::max(deepest, loads_.deepest.ratio);
    }
    Sensors sensors = sense();
    if (world_.coil) sensors.coilTorque = bodies[world_.bodies.size()].torque;  // the last of allBodies
    sensors.bodies = std::move(bodies);
    sensors.maxOverlapRatio = deepest;
    if (world_.energyBook && steps_ > 0) sensors.energy = senseEnergy();
    return sensors;
}

/// One step of the leapfrog, as backend.h describes it.
void ReferenceBackend::step(double coilRate) {
    const bool opening = steps_ == 0;
    const double dt = world_.timeStep;
    neighbours_.update(particles_);
    const std::vector<FreeBody> free = freeBodies();
    forces_.evaluate(world_, particles_, neighbours_,
                     Drive{angle_, coilRate, static_cast<double>(steps_) * dt, clocks_, free}, opening ? 0 : dt,
                     loads_);
    refuseDeepOverlap();
    if (world_.energyBook) before_ = particles_;
    reference::moveFreeBodies(world_, loads_, steps_, clocks_, free_);

    ++steps_;
    advanceClocks(clocks_, 1);
    lost_.clear();
    for (std::size_t i = 0; i < particles_.size(); ++i) {
        if (particles_.status[i] != Status::Active) continue;
        move(i, opening ? dt / 2 : dt);
        settleStatus(i);
    }
    if (world_.energyBook) bookStep(opening);
    if (!lost_.empty()) throw RunError(lost_);
}

void ReferenceBackend::move(std::size_t i, double kick) {
    const double m = mass(i);
    const double inertia = 0.4 * m * particles_.radius[i] * particles_.radius[i];
    particles_.velocity[i] += kick * (loads_.force[i] / m + world_.gravity);
    particles_.spin[i] += kick / inertia * loads_.torque[i];
    if (!loads_.flows.empty())
        for (std::size_t k = 0; k < kMostLawProperties; ++k)
            particles_.properties[i][k] += world_.timeStep * loads_.flows[i][k];
    Vec3& x = particles_.position[i];
    x += world_.timeStep * particles_.velocity[i];
    for (int d = 0; d < 3; ++d) {
        if (world_.period[d] == 0) continue;
        const int gone = x[d] >= world_.domain.high[d] ? 1 : x[d] < world_.domain.low[d] ? -1 : 0;
        x[d] -= gone * world_.period[d];
        particles_.gone[i][d] += gone;
    }
}

std::vector<FreeBody> ReferenceBackend::freeBodies() const {
    if (!moveFreely(world_.bodies)) return {};
    std::vector<FreeBody> bodies = free_;
    for (std::size_t b = 0; b < bodies.size(); ++b)
        if (steps_ < world_.bodies[b].firstFreeStep(world_.timeStep)) {
            bodies[b].velocity = Vec3(0);
            bodies[b].rate = 0;
        }
    return bodies;
}

/// Takes a particle out of the motion if it is dosed or lost.
void ReferenceBackend::settleStatus(std::size_t i) {
    const Vec3& x = particles_.position[i];
    const bool broken = !finite(x) || !finite(particles_.velocity[i]) || !finite(particles_.spin[i]);
    if (!broken && world_.doses(x)) {
        particles_.status[i] = Status::Dosed;
    } else if (broken || !inside(world_, x)) {
        particles_.status[i] = Status::Lost;
        if (lost_.empty())
            lost_ = fmt::format(
                "particle {} {} in {}, at ({:.6g}, {:.6g}, {:.6g}) m: {}", i,
                broken ? "is no longer finite" : "left the domain", when(), x.x, x.y, x.z,
                broken ? world_.law.user
                             ? fmt::format("let the law {} answer finite numbers, or use a smaller time step",
                                           world_.law.user->name)
                             : "use a smaller time step"
                       : "close the boundaries around it (canister.lid = true if it flew out at the top), give the "
                         "domain more room there (domain.low, domain.high) or use a smaller time step");
    }
}

/// Adds the energies that contacts booked in this step, the energy that came with the load, and the energy that left
/// with particles.
void ReferenceBackend::bookStep(bool opening) {
    const EnergyBook& step = loads_.energy;
    book_.plastic += step.plastic;
    book_.adhesive += step.adhesive;
    book_.viscous += step.viscous;
    book_.sliding += step.sliding;
    book_.rolling += step.rolling;
    book_.torsion += step.torsion;
    book_.numerical += step.numerical;
    book_.coilWork += step.coilWork;
    book_.bodyWork += step.bodyWork;
    book_.left += step.left;
    book_.loaded += step.loaded;
    for (std::size_t i = 0; i < particles_.size(); ++i) {
        if (before_.status[i] != Status::Active) continue;
        if (opening) {
            // The opening step made half a kick from v(0) to v(1/2). v(-1/2) is as far from v(0) on the other side.
            before_.velocity[i] = 2.0 * before_.velocity[i] - particles_.velocity[i];
            before_.spin[i] = 2.0 * before_.spin[i] - particles_.spin[i];
            book_.loaded += mechanicalEnergy(i).sum();
        }
        if (particles_.status[i] != Status::Active) book_.left += mechanicalEnergy(i).sum();
    }
}

ReferenceBackend::Mechanical ReferenceBackend::mechanicalEnergy(std::size_t i) const {
    const double m = mass(i), a = particles_.radius[i];
    return {0.5 * m * glm::dot(before_.velocity[i], particles_.velocity[i]),
            0.5 * (0.4 * m * a * a) * glm::dot(before_.spin[i], particles_.spin[i]),
            -m * glm::dot(world_.gravity, unfolded(world_, before_, i))};
}

EnergyBook ReferenceBackend::senseEnergy() const {
    EnergyBook book = book_;
    book.elasticNormal = loads_.energy.elasticNormal;
    book.elasticSliding = loads_.energy.elasticSliding;
    book.elasticRolling = loads_.energy.elasticRolling;
    book.elasticTorsion = loads_.energy.elasticTorsion;
    for (std::size_t i = 0; i < particles_.size(); ++i) {
        if (particles_.status[i] != Status::Active) continue;
        const Mechanical energy = mechanicalEnergy(i);
        book.kinetic += energy.kinetic;
        book.rotational += energy.rotational;
        book.potential += energy.potential;
        const double m = mass(i), a = particles_.radius[i];
        book.momentum += m * particles_.velocity[i];
        book.angularMomentum +=
            m * glm::cross(particles_.position[i], particles_.velocity[i]) + (0.4 * m * a * a) * particles_.spin[i];
    }
    return book;
}

void ReferenceBackend::refuseDeepOverlap() const {
    const Deepest& deepest = loads_.deepest;
    if (deepest.ratio > world_.maxOverlapRatio)
        throw RunError(
            fmt::format("{} overlap by {:.1f} % of the smaller radius in {}, more than the {:.0f} % a contact "
                        "law covers: use a smaller time step or stiffer contacts (k1, k2)",
                        nameOf(deepest, world_), 100 * deepest.ratio, when(), 100 * world_.maxOverlapRatio));
}

Sensors ReferenceBackend::sense() const {
    Sensors sensors;
    for (std::size_t i = 0; i < particles_.size(); ++i) {
        const Status status = particles_.status[i];
        if (status == Status::Waiting) continue;
        Region region = particles_.position[i].z > world_.throatZ ? Region::Throat : Region::Canister;
        if (status == Status::Dosed) region = Region::Dosed;
        if (status == Status::Lost) region = Region::Lost;
        sensors.count[static_cast<std::size_t>(region)] += 1;
        sensors.mass[static_cast<std::size_t>(region)] += mass(i);
        if (!particles_.gone.empty())
            for (int d = 0; d < 3; ++d) sensors.through[std::size_t(d)] += mass(i) * particles_.gone[i][d];
        if (status != Status::Active) continue;

        const double m = mass(i), a = particles_.radius[i];
        const Vec3 &v = particles_.velocity[i], &w = particles_.spin[i];
        sensors.kineticEnergy += 0.5 * m * glm::dot(v, v);
        sensors.rotationalEnergy += 0.5 * (0.4 * m * a * a) * glm::dot(w, w);
        if (region == Region::Throat) sensors.throatMomentumZ += m * v.z;
    }
    sensors.rebuilds = neighbours_.builds();
    return sensors;
}

}  // namespace

std::unique_ptr<Backend> makeReferenceBackend() {
    return std::make_unique<ReferenceBackend>();
}

}  // namespace vkdose
