#pragma once
// Worlds and particles that the law tests share.

#include <cmath>
#include <memory>

#include "host/backend/reference/reference.h"
#include "host/model/world.h"

namespace vkdose::test {

// The mean sphere of the paper and the parameters its oracle rows were made with (SI).
inline constexpr double kRadius = 1.25e-3;
inline constexpr double kDensity = 1427;
inline constexpr double kK2Max = 24067;
inline constexpr double kK1 = 4813.4;
inline constexpr double kGravity = 9.81;

/// Of closed forms in double precision: a few rounding errors of the largest value in sight.
inline constexpr double kRounding = 1e-12;

inline double massOf(double radius) {
    return kDensity * 4.0 / 3.0 * kPi * radius * radius * radius;
}

/// All forces on, no torsion; `kcRatio` = k_c / k2Max.
inline ContactParameters paperParameters(double kcRatio = 0, double mu = 0.5, double muR = 0.5) {
    ContactParameters p;
    p.k1 = kK1;
    p.k2Max = kK2Max;
    p.kc = kcRatio * kK2Max;
    p.plasticityDepth = 0.05;
    p.gamma = 0.0827;
    p.kt = p.kr = 6883.162;
    p.gammaT = p.gammaR = 0.0236522;
    p.mu = mu;
    p.muR = muR;
    return p;
}

/// A linear spring without damping and friction.
inline ContactParameters spring(double k) {
    ContactParameters p;
    p.k1 = p.k2Max = k;
    return p;
}

inline ContactLaw lawOf(const ContactParameters& p, CoulombLimit limit = CoulombLimit::Absolute,
                        RollingLever lever = RollingLever::Full) {
    ContactLaw law;
    law.pairs.fill(p);
    law.limitFriction(limit);
    law.rollingLever = lever;
    return law;
}

/// Empty space without gravity, 2 m wide.
inline RuledWorld freeWorld(const ContactParameters& p, double timeStep) {
    RuledWorld world;
    world.law = lawOf(p);
    world.gravity = Vec3(0);
    world.density() = kDensity;
    world.timeStep = timeStep;
    world.skin = 0.1e-3;
    return world;
}

/// The same with the plane y = 0 below.
inline RuledWorld planeWorld(const ContactParameters& p, double timeStep) {
    RuledWorld world = freeWorld(p, timeStep);
    world.walls.push_back(geometry::Plane{Vec3(0), Vec3(0, 1, 0)});
    return world;
}

/// Advances a backend step by step and offers velocities at full steps: the mean of the half steps around them.
class Stepper {
  public:
    Stepper(const RuledWorld& world, const Particles& particles) : backend_(makeReferenceBackend()), now_(particles) {
        backend_->load(world, particles);
    }

    /// One step. Afterwards `full` is the state at the step's start, `now` the one at its end (velocities half a step
    /// back).
    void step(double coilRate = 0) {
        full_ = now_;
        backend_->advance(1, coilRate);
        const Particles next = backend_->particles();
        for (std::size_t i = 0; i < next.size(); ++i) {
            // The loaded velocity already belongs to the full step 0.
            if (steps_ > 0) {
                full_.velocity[i] = (now_.velocity[i] + next.velocity[i]) / 2.0;
                full_.spin[i] = (now_.spin[i] + next.spin[i]) / 2.0;
            }
        }
        kick_ = next.velocity[0] - now_.velocity[0];
        now_ = next;
        ++steps_;
    }

    const Particles& full() const { return full_; }
    const Particles& now() const { return now_; }
    /// Change of particle 0's velocity in the step: force on it over mass times dt (dt/2 in the first step).
    const Vec3& kick() const { return kick_; }
    int steps() const { return steps_; }
    bool touching() const { return !backend_->contacts().empty(); }
    Backend& backend() { return *backend_; }

  private:
    std::unique_ptr<Backend> backend_;
    Particles now_, full_;
    Vec3 kick_{0};
    int steps_ = 0;
};

}  // namespace vkdose::test
