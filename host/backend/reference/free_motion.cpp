#include "host/backend/reference/free_motion.h"

#include <optional>
#include <variant>

namespace vkdose::reference {

void moveFreeBodies(const World& world, const Loads& loads, std::uint64_t step, const std::vector<BodyClock>& clocks,
                    std::vector<FreeBody>& bodies) {
    for (std::size_t b = 0; b < bodies.size(); ++b) {
        const RigidBody& body = world.bodies[b];
        if (!body.movesFreely()) continue;
        const double kick = body.kickOf(step, world.timeStep);
        if (kick == 0) continue;
        const auto& motion = std::get<geometry::Free>(body.course.motion);
        FreeBody& free = bodies[b];
        Vec3 push = kick * (loads.bodies[b].force / motion.mass + world.gravity);
        if (motion.line) {
            const BodyClock clock = clockOf(clocks, b);
            const double force = body.drivingForce(
                static_cast<double>(step) * world.timeStep,
                clock.runs ? std::optional(static_cast<double>(clock.steps) * world.timeStep) : std::nullopt);
            push = (glm::dot(push, *motion.line) + kick * force / motion.mass) * *motion.line;
        }
        // The damping acts at the mean of the velocities before and after, so that it takes energy at any size.
        const double damped = kick * motion.damping / motion.mass;
        free.velocity += (push - damped * free.velocity) / (1 + damped / 2);
        if (motion.line) {
            const double speed = glm::dot(free.velocity, *motion.line);
            const double stopped = motion.stopped(glm::dot(free.shift, *motion.line), speed, world.timeStep);
            if (stopped != speed) free.velocity = stopped * *motion.line;
        }
        free.shift += world.timeStep * free.velocity;
    }
}

}  // namespace vkdose::reference
