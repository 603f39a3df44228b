// What the backend senses in its calls, joined to samples.
#include <algorithm>
#include <cmath>
#include <limits>

#include "host/sim/run_loop.h"

namespace vkdose {

double RunLoop::driveImpulse(const Sensors& s, std::uint64_t n) const {
    const auto steps = static_cast<double>(n);
    double impulse = s.coilTorque * steps;
    const std::vector<RigidBody>& bodies = case_.world.bodies;
    for (std::size_t b = 0; b < bodies.size(); ++b) {
        if (bodies[b].clock != Clock::Drive) continue;
        if (stretch_.rate != 0)
            impulse -= s.bodies[b].work / (stretch_.rate * case_.world.timeStep);
        else if (const auto* turn = std::get_if<geometry::Turn>(&bodies[b].course.motion))
            impulse += s.bodies[b].torque * turn->rate * steps;  // held, the drive still bears the load
    }
    return impulse;
}

void RunLoop::gather(const Sensors& s, std::uint64_t n) {
    if (s.energy) {
        if (!energy_) energy_.emplace();
        energy_->add(*s.energy);
    }
    if (s.maxOverlapRatio > result_.maxOverlapRatio) {
        result_.maxOverlapRatio = s.maxOverlapRatio;
        result_.maxOverlapTime = timeline_.time(step_);
    }
    const double impulse = driveImpulse(s, n);
    const double overlap = gathered_ > 0 ? std::max(now_.maxOverlapRatio, s.maxOverlapRatio) : s.maxOverlapRatio;
    now_ = s;
    now_.maxOverlapRatio = overlap;
    varied_ = gathered_ > 0 && (varied_ || stretch_.rate != rate_);
    rate_ = stretch_.rate;
    powerSum_ = gathered_ > 0 ? powerSum_ - impulse * rate_ : -impulse * rate_;
    gathered_ += n;
    impulse_ += impulse;
    const bool rotates = stretch_.phase == Phase::Rotate;
    loads_.add(s.bodies, n, rotates);
    if (rotates) book_.turn(impulse, n, stretch_.rate);
}

void RunLoop::sample() {
    if (gathered_ == 0) return;
    Sample s;
    s.step = step_;
    s.time = timeline_.time(step_);
    s.phase = stretch_.phase;
    s.dose = stretch_.dose;
    s.coilAngle = backend_.coilAngle();
    s.sensors = now_;
    s.sensors.coilTorque = impulse_ / static_cast<double>(gathered_);
    s.coilTorque = driveTorque(s.sensors.coilTorque);
    const double speed = stretch_.phase == Phase::Reverse ? -std::abs(rate_) : std::abs(rate_);
    s.coilPower = varied_ ? powerSum_ / static_cast<double>(gathered_) : s.coilTorque * speed;
    const double throat = mass(now_, Region::Throat);
    s.outletVelocity = throat > 0 ? now_.throatMomentumZ / throat : std::numeric_limits<double>::quiet_NaN();
    s.energy = energy_;
    s.bodies = loads_.take(gathered_, case_.world.timeStep);
    s.free = freePlaces();
    if (!regions_.empty() || !powders_.empty()) {
        const Particles particles = backend_.particles();
        regions_.look(particles, bodyPoses(case_.world, s.time, s.coilAngle, moved()));
        powders_.look(particles);
    }
    s.regions = regions_.samples();
    s.powders = powders_.places();
    gathered_ = 0;
    impulse_ = 0;
    observer_.onSample(s);
    result_.ledger.close(s.sensors, s.time);  // after the observer, so that a bad ledger is on record
    result_.last = s;
}

}  // namespace vkdose
