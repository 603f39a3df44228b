#pragma once
// A backend without physics: it writes down what it is asked to do and doses particles when the test says so.

#include <algorithm>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "host/backend/backend.h"
#include "host/core/error.h"
#include "host/sim/runner.h"

namespace vkdose::test {

class FakeBackend : public Backend {
  public:
    struct Call {
        std::uint64_t firstStep;
        std::uint32_t steps;
        double rate;
        double kc;       ///< adhesion stiffness in force
        double gravity;  ///< along y, in force [m/s2]
    };

    /// How many particles are dosed after so many steps; the others are in the canister.
    std::function<std::uint64_t(std::uint64_t step)> dosed = [](std::uint64_t) { return 0; };
    /// Torque on the coil about +z during the step that follows `step` finished ones.
    std::function<double(std::uint64_t step)> torque = [](std::uint64_t) { return 0.0; };
    /// Last chance to spoil the sensors.
    std::function<void(std::uint64_t step, Sensors&)> spoil = [](std::uint64_t, Sensors&) {};
    std::optional<std::uint64_t> runErrorAt;
    std::optional<std::uint64_t> deviceErrorAt;
    double particleMass = 1e-3;
    double perCall = 4e6;  ///< particleStepsPerCall

    /// The value of every point of a field after so many steps.
    std::function<FieldPoint(std::uint64_t step)> field = [](std::uint64_t) { return FieldPoint{}; };

    std::vector<Call> calls;
    std::vector<BodyClock> clocks;  ///< as they were set last
    int fieldCalls = 0;
    int loads = 0;
    std::uint64_t step = 0;

    void load(const World& world, const ContactLaw& law, const Particles& particles) override {
        ++loads;
        world_ = {world, law};
        particles_ = particles;
    }
    void setLaw(const ContactLaw& law) override { world_.law = law; }
    void setGravity(const Vec3& gravity) override { world_.gravity = gravity; }
    void addParticles(std::size_t first, const std::vector<Vec3>& positions) override {
        for (std::size_t k = 0; k < positions.size(); ++k) {
            particles_.position.at(first + k) = positions[k];
            particles_.status[first + k] = Status::Active;
        }
    }
    void setClocks(const std::vector<BodyClock>& now) override { clocks = now; }

    double particleStepsPerCall() const override { return perCall; }
    Sensors advance(std::uint32_t steps, double rate) override {
        if (runErrorAt && step >= *runErrorAt) throw RunError("particle 3 is gone (step 7)");
        if (deviceErrorAt && step >= *deviceErrorAt) throw DeviceError("device lost");
        calls.push_back({step, steps, rate, world_.law.of(ContactClass::ParticleParticle).kc, world_.gravity.y});
        double impulse = 0;
        for (std::uint64_t s = step; s < step + steps; ++s) impulse += torque(s);
        step += steps;
        angle_ += rate * world_.timeStep * steps;
        Sensors s;
        const auto there = std::count(particles_.status.begin(), particles_.status.end(), Status::Active);
        s.count = {static_cast<std::uint64_t>(there) - dosed(step), 0, dosed(step), 0};
        for (std::size_t r = 0; r < kRegions; ++r) s.mass[r] = particleMass * static_cast<double>(s.count[r]);
        s.coilTorque = impulse / steps;
        s.bodies.resize(loadNames(world_).size());
        s.maxOverlapRatio = static_cast<double>(step % 100) / 1000;
        spoil(step, s);
        return s;
    }

    Record snapshot() const override {
        Record record;
        record.putOne("step", step);
        record.putOne("angle", angle_);
        std::vector<std::uint64_t> status;
        for (const Status s : particles_.status) status.push_back(static_cast<std::uint64_t>(s));
        record.put("status", std::move(status));
        return record;
    }
    void restore(const Record& record) override {
        step = record.one<std::uint64_t>("step");
        angle_ = record.one<double>("angle");
        const auto& status = record.get<std::uint64_t>("status", particles_.size());
        for (std::size_t i = 0; i < status.size(); ++i) particles_.status[i] = static_cast<Status>(status[i]);
    }

    Particles particles() const override { return particles_; }
    std::vector<Contact> contacts() const override {
        Contact one;  // tells when it was asked for
        one.maxOverlap = static_cast<double>(step);
        return {one};
    }
    FieldPoints fields(const FieldRequest& request) override {
        ++fieldCalls;
        return FieldPoints(request.grid.points(), field(step));
    }
    double coilAngle() const override { return angle_; }
    std::string description() const override { return "fake"; }

  private:
    RuledWorld world_;
    Particles particles_;
    double angle_ = 0;
};

/// Keeps everything it is told.
struct Notebook : RunObserver {
    std::vector<Sample> samples;
    std::vector<Dose> doses;
    std::vector<Progress> progress;
    std::vector<Frame> frames;
    bool wantsFrames = true;
    void onSample(const Sample& s) override { samples.push_back(s); }
    void onDose(const Dose& d) override { doses.push_back(d); }
    void onProgress(const Progress& p) override { progress.push_back(p); }
    void onFrame(const Frame& f) override { frames.push_back(f); }
    bool storesFrames() const override { return wantsFrames; }
};

/// Keeps the checkpoints as well.
struct CheckpointKeeper : Notebook {
    std::vector<RunCheckpoint> kept;
    void onCheckpoint(const RunCheckpoint& c, double) override { kept.push_back(c); }
    bool storesCheckpoints() const override { return true; }
};

/// Settle 100 steps, then rotate 50 / rest 20; sensors every 30 steps; a left-handed coil unless told otherwise.
inline Case smallCase() {
    Case c;
    c.name = "fake";
    c.world.timeStep = 1e-3;
    c.world.density() = 1000;
    c.dosingLaw.of(ContactClass::ParticleParticle).kc = 7;
    c.settlingLaw.of(ContactClass::ParticleParticle).kc = 3;
    geometry::Coil coil{};
    coil.radius = 0.01;
    coil.pitch = 0.01;
    coil.wireRadius = 0.001;
    coil.length = 0.05;
    coil.hand = -1;
    c.world.coil = coil;
    c.schedule.settleTime = 0.1;
    c.schedule.rotateTime = 0.05;
    c.schedule.restTime = 0.02;
    c.schedule.coilSpeed = 4;
    c.schedule.stop.kind = StopRule::Kind::None;
    c.schedule.stop.maxDoses = 3;
    c.sensorInterval = 0.03;
    return c;
}

/// `n` equal particles of 1 g; the fake does not care where they are.
inline Insertion smallFilling(std::size_t n = 10) {
    Insertion filled;
    for (std::size_t i = 0; i < n; ++i) filled.particles.add(Vec3(0.01 * static_cast<double>(i), 0, 0), 1e-3);
    filled.mass = 1e-3 * static_cast<double>(n);
    filled.targetMass = filled.mass;
    return filled;
}

inline RunResult play(const Case& c, FakeBackend& backend, Notebook& notebook, bool stopNow = false) {
    const std::atomic<bool> stop{stopNow};
    Derived derived;
    derived.massPerDose = 2e-3;
    return runFilled(c, smallFilling(), derived, backend, notebook, stop);
}

}  // namespace vkdose::test
