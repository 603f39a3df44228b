#include "host/backend/reference/free_motion.h"

#include <cmath>
#include <optional>
#include <utility>
#include <variant>

namespace vkdose::reference {

namespace {

/// The change of a speed that a kick makes against damping, which takes the share `damped` of the speed if that is
/// small. It acts at the mean of the velocities before and after, so that it takes energy at any size.
template <class Speed>
Speed gained(const Speed& kick, const Speed& speed, double damped) {
    return (kick - damped * speed) / (1 + damped / 2);
}

/// `drive` [N].
void shift(const geometry::Free& motion, const World& world, const Vec3& load, double drive, double kick,
           FreeBody& free) {
    Vec3 push = kick * (load / motion.mass + world.gravity);
    if (motion.line) push = (glm::dot(push, *motion.line) + kick * drive / motion.mass) * *motion.line;
    free.velocity += gained(push, free.velocity, kick * motion.damping / motion.mass);
    if (motion.line) {
        const double speed = glm::dot(free.velocity, *motion.line);
        const double stopped =
            geometry::stoppedAt(motion.low, motion.high, glm::dot(free.shift, *motion.line), speed, world.timeStep);
        if (stopped != speed) free.velocity = stopped * *motion.line;
    }
    free.shift += world.timeStep * free.velocity;
}

/// `load`, `drive` [N m].
void turn(const geometry::Hinge& motion, const World& world, double load, double drive, double kick, FreeBody& free) {
    const glm::dvec2 weight = motion.weight(world.gravity);
    const double torque = load + weight.x * std::cos(free.angle) + weight.y * std::sin(free.angle) + drive;
    free.rate += gained(kick * torque / motion.inertia, free.rate, kick * motion.damping / motion.inertia);
    free.rate = geometry::stoppedAt(motion.low, motion.high, free.angle, free.rate, world.timeStep);
    free.angle += world.timeStep * free.rate;
}

}  // namespace

void moveFreeBodies(const World& world, const Loads& loads, std::uint64_t step, const std::vector<BodyClock>& clocks,
                    std::vector<FreeBody>& bodies) {
    for (std::size_t b = 0; b < bodies.size(); ++b) {
        const RigidBody& body = world.bodies[b];
        if (!body.movesFreely()) continue;
        const double kick = body.kickOf(step, world.timeStep);
        if (kick == 0) continue;
        const BodyClock clock = clockOf(clocks, b);
        const double drive =
            body.driveOf(static_cast<double>(step) * world.timeStep,
                         clock.runs ? std::optional(static_cast<double>(clock.steps) * world.timeStep) : std::nullopt);
        const BodyLoad& load = loads.bodies[b];
        if (const geometry::Hinge* hinge = body.hinge())
            turn(*hinge, world, load.torque, drive, kick, bodies[b]);
        else
            shift(std::get<geometry::Free>(body.course.motion), world, load.force, drive, kick, bodies[b]);
    }
}

void saveFreeBodies(const std::vector<FreeBody>& bodies, Record& record) {
    std::vector<double> shifts, velocities, angles, rates;
    for (const FreeBody& body : bodies) {
        shifts.insert(shifts.end(), {body.shift.x, body.shift.y, body.shift.z});
        velocities.insert(velocities.end(), {body.velocity.x, body.velocity.y, body.velocity.z});
        angles.push_back(body.angle);
        rates.push_back(body.rate);
    }
    record.put("body_shift", std::move(shifts));
    record.put("body_velocity", std::move(velocities));
    record.put("body_angle", std::move(angles));
    record.put("body_rate", std::move(rates));
}

void restoreFreeBodies(const Record& record, std::vector<FreeBody>& bodies) {
    const auto &shifts = record.get<double>("body_shift", 3 * bodies.size()),
               &velocities = record.get<double>("body_velocity", 3 * bodies.size()),
               &angles = record.get<double>("body_angle", bodies.size()),
               &rates = record.get<double>("body_rate", bodies.size());
    for (std::size_t b = 0; b < bodies.size(); ++b)
        bodies[b] = {Vec3(shifts[3 * b], shifts[3 * b + 1], shifts[3 * b + 2]),
                     Vec3(velocities[3 * b], velocities[3 * b + 1], velocities[3 * b + 2]), angles[b], rates[b]};
}

}  // namespace vkdose::reference
