// Bodies that move freely: thrown, driven along a line, and on a hinge.

#include <fmt/format.h>

#include <cmath>

#include "host/verify/cases.h"
#include "host/verify/setups.h"

namespace vkdose::verify {

namespace {

/// Right-handed, oblique to all axes of the world.
struct Triad {
    Vec3 along, up, axis;
};

Triad oblique() {
    const Vec3 axis = glm::normalize(Vec3(1, -2, 2)), along = glm::normalize(glm::cross(Vec3(0, 1, 0.3), axis));
    return {along, glm::cross(axis, along), axis};
}

/// A ball of 2 kRadius at this place that turns on a hinge.
RigidBody ballAt(const Vec3& at, const geometry::Hinge& hinge) {
    RigidBody body = bodyOf({geometry::Ball{Vec3(0), 2 * kRadius}}, hinge);
    body.clock = Clock::Forces;
    body.course.start.origin = at;
    return body;
}

/// What the damped impact of a linear spring leaves of the relative speed.
double restitutionOf(double k, double gamma, double reduced) {
    const double zeta = gamma / (2 * std::sqrt(k * reduced));
    return std::exp(-kPi * zeta / std::sqrt(1 - zeta * zeta));
}

}  // namespace

// Two bodies that move freely. One meets a sphere at rest while both fall. Its impact leaves the share
// exp(-pi zeta/sqrt(1 - zeta^2)) of their relative speed, with zeta = gamma/(2 sqrt(k mu)) of the reduced mass mu, and
// keeps their momentum. The other falls alone.
void freeBall(Stage& stage) {
    const double k = 500, gamma = 0.03, speed = 0.5, dt = 1e-6, radius = 2 * kRadius;
    const double sphere = massOf(kRadius), ball = 3 * sphere, reduced = ball * sphere / (ball + sphere);
    const double restitution = restitutionOf(k, gamma, reduced);
    const Vec3 way = glm::normalize(Vec3(2, 1, -2)), thrown(0.3, 0.4, 0);
    RuledWorld world = space(spring(k, gamma), dt);
    world.gravity = Vec3(0, -kGravity, 0);
    const auto bodyAt = [&](const Vec3& at, const Vec3& velocity) {
        RigidBody body = bodyOf({geometry::Ball{Vec3(0), radius}}, geometry::Free{ball, velocity, {}});
        body.clock = Clock::Forces;
        body.course.start.origin = at;
        return body;
    };
    world.bodies = {bodyAt(Vec3(0), speed * way), bodyAt(Vec3(0, 20 * kRadius, 0), thrown)};
    world.bodies[0].name = "first";
    Particles one;
    one.add(1.01 * (radius + kRadius) * way, kRadius);
    Trial trial(stage, world, one);
    trial.advance(2000);  // the impact takes 420 of them
    const Vec3 fallen = trial.halfStep() * world.gravity, of = trial.now().velocity[0] - fallen;
    const FreeBody met = trial.freeBodies().at(0), alone = trial.freeBodies().at(1);
    const Tolerance damping{3e-3, "damping is first order in the time step: gamma dt/2m = 1.3e-3"};
    stage.check("speed that the ball gives to the sphere", "m/s", ball * (1 + restitution) / (ball + sphere) * speed,
                glm::dot(of, way), damping);
    stage.check("speed that is left to the ball", "m/s", (ball - restitution * sphere) / (ball + sphere) * speed,
                glm::dot(met.velocity - fallen, way), damping);
    stage.check("momentum that both gain beside their weight's", "kg m/s", 0,
                glm::length(ball * (met.velocity - fallen) + sphere * of - ball * speed * way),
                {2e-6, "rounding of a device's forces, in units of the ball's momentum", ball * speed});
    const double t = trial.time();
    stage.check("way of the ball that falls alone", "m", 0,
                glm::length(alone.shift - t * thrown - 0.5 * t * t * world.gravity),
                {1e-6, "rounding, in units of the way", t * glm::length(thrown)});
}

// Forces along their lines drive three bodies. One is damped: with the force F and the damping c its speed is
// F/c (1 - exp(-c t/m)). One comes to its stop. One is a lid that presses a sphere on a floor: at rest both contacts
// bear the force, the lid has sunk by two overlaps F/k, and its turn moves nothing, for nothing rubs.
void drivenBody(Stage& stage) {
    const double k = 500, gamma = 0.05, dt = 2e-6, force = 5e-3, mass = 1e-4, damping = 0.02, stop = 1.5e-3;
    const Vec3 way = glm::normalize(Vec3(2, 1, -2)), y(0, 1, 0);
    RuledWorld world = space(spring(k, gamma), dt);
    world.walls.push_back(geometry::Plane{Vec3(0), y});
    const auto driven = [&](const geometry::Shape& shape, const Vec3& at, const geometry::Free& free) {
        RigidBody body = bodyOf({shape}, free);
        body.name = fmt::format("driven-{}", world.bodies.size());
        body.clock = Clock::Forces;
        body.course.start.origin = at;
        world.bodies.push_back(body);
    };
    const geometry::Ball ball{Vec3(0), kRadius};
    geometry::Free damped{mass, Vec3(0), way, Vec3(0.1), {{0, force, 0}}};
    damped.damping = damping;
    geometry::Free stopped{mass, Vec3(0), way, Vec3(-0.1), {{0, force, 0}}};
    stopped.high = stop;
    const double turn = 2 * kPi;  // in a second
    geometry::Free lid{mass, Vec3(0), y, Vec3(0, 2 * kRadius, 0), {{0, -force, 0}, {1, -force, turn}}};
    lid.damping = 0.2;
    driven(ball, damped.through, damped);
    driven(ball, stopped.through, stopped);
    driven(geometry::Cone{Vec3(0), y, 0, 3 * kRadius, 0}, lid.through, lid);
    Particles one;
    one.add(Vec3(0, kRadius, 0), kRadius);
    Trial trial(stage, world, one);
    trial.advance(20'000);
    const std::vector<FreeBody> bodies = trial.freeBodies();
    const double t = trial.halfStep();
    stage.check("speed of a damped body", "m/s", force / damping * (1 - std::exp(-damping * t / mass)),
                glm::dot(bodies[0].velocity, way),
                {1e-6, "rounding; the step is of second order: (c dt/m)^2/12 = 1e-8"});
    stage.check("way to a stop", "m", stop, glm::dot(bodies[1].shift, way),
                {1e-4, "a device knows a place to less than kAtStop"});
    stage.check("speed at a stop", "m/s", 0, glm::length(bodies[1].velocity),
                {1e-9, "it stands, in units of the speed without a stop", force / mass * t});
    const Sensors last = trial.advance(1);
    stage.check("force that a lid bears", "N", force, last.bodies.at(2).force.y, {1e-4, "the rest of its swing"});
    stage.check("way of a lid onto a sphere", "m", -2 * force / k, bodies[2].shift.y,
                {1e-3, "rounding: a device adds overlaps to places of some millimetres"});
    stage.check("torque of a lid that turns without friction", "N m", 0, last.bodies.at(2).torque,
                {1e-6, "rounding, in units of the force times the radius", force * kRadius});
}

// A sphere strikes a ball that turns on a hinge at the arm L. The ball meets it as one of the mass I/L^2, and the
// moment of momentum about the hinge stays.
void hingedBall(Stage& stage) {
    const double k = 500, gamma = 0.03, speed = 0.5, dt = 1e-6, arm = 20e-3;
    const double sphere = massOf(kRadius), ball = 3 * sphere, reduced = ball * sphere / (ball + sphere);
    const double restitution = restitutionOf(k, gamma, reduced);
    const Triad t = oblique();
    geometry::Hinge hinge;
    hinge.axis = t.axis;
    hinge.through = Vec3(3e-3, -2e-3, 5e-3);
    hinge.inertia = ball * arm * arm;
    const Vec3 at = hinge.through + arm * t.along + 2e-3 * t.axis;
    RuledWorld world = space(spring(k, gamma), dt);
    world.bodies = {ballAt(at, hinge)};
    Particles one;
    one.add(at - 1.01 * (3 * kRadius) * t.up, kRadius, speed * t.up);
    Trial trial(stage, world, one);
    trial.advance(2000);  // the impact takes 420 of them
    const double rate = trial.freeBodies().at(0).rate;
    const Vec3 after = trial.now().velocity[0];
    const Tolerance damping{3e-3, "damping is first order in the time step: gamma dt/2m = 1.3e-3"};
    stage.check("speed that a ball on a hinge gives back", "m/s",
                (sphere - restitution * ball) / (ball + sphere) * speed, glm::dot(after, t.up),
                {2e-3, "damping is first order in the time step, in units of the speed before", speed});
    stage.check("speed that it takes", "m/s", sphere * (1 + restitution) / (ball + sphere) * speed, arm * rate,
                damping);
    const auto moment = [&](const Vec3& velocity) {
        return glm::dot(t.axis, glm::cross(trial.now().position[0] - hinge.through, sphere * velocity));
    };
    stage.check("moment of momentum about the hinge", "kg m2/s", arm * sphere * speed,
                moment(after) + hinge.inertia * rate, {2e-6, "rounding of a device's forces"});
}

// Torques drive bodies on hinges. One is damped: with the torque T and the damping c its rate is T/c (1 - exp(-c t/I)).
// One comes to its stop. One swings by its weight and keeps I w^2/2 + m g h. One is a lid that presses a sphere on a
// floor at the arm L and bears T/L; friction keeps the sphere from leaving the wedge.
void drivenHinge(Stage& stage) {
    const double k = 500, dt = 2e-6, torque = 2e-5, inertia = 2e-9, damping = 4e-7, stop = 2.5, arm = 10e-3;
    const Triad t = oblique();
    const Vec3 y(0, 1, 0), z(0, 0, 1);
    ContactParameters p = spring(k, 0.05);
    p.kt = 2.0 / 7 * k;
    p.mu = 0.5;
    RuledWorld world = space(p, dt);
    world.gravity = -kGravity * y;
    world.walls.push_back(geometry::Plane{Vec3(0), y});
    const auto hinged = [&](const Vec3& through, const Vec3& axis, double drive) {
        geometry::Hinge hinge;
        hinge.axis = axis;
        hinge.through = through;
        hinge.inertia = inertia;
        if (drive != 0) hinge.rows = {{0, drive}};
        return hinge;
    };
    geometry::Hinge damped = hinged(Vec3(0.1), t.axis, torque), stopped = hinged(Vec3(0.2), t.axis, -torque),
                    pendulum = hinged(Vec3(0.3), t.axis, 0), lid = hinged(2 * kRadius * y, z, -torque);
    damped.damping = damping;
    stopped.low = -stop;
    pendulum.mass = 1e-5;
    pendulum.centre = pendulum.through + arm * t.along + arm * t.axis;
    lid.damping = 1e-5;
    for (const geometry::Hinge& hinge : {damped, stopped, pendulum})
        world.bodies.push_back(ballAt(hinge.through + arm * t.along, hinge));
    RigidBody plate = bodyOf({geometry::Cone{Vec3(0), y, 0, 2 * arm, 0}}, lid);
    plate.clock = Clock::Forces;
    plate.course.start.origin = lid.through;
    world.bodies.push_back(plate);
    for (std::size_t b = 0; b < world.bodies.size(); ++b) world.bodies[b].name = fmt::format("hinged-{}", b);
    Particles one;
    one.add(Vec3(arm, kRadius, 0), kRadius);
    Trial trial(stage, world, one);
    trial.advance(20'000);
    const std::vector<FreeBody> bodies = trial.freeBodies();
    const double since = trial.halfStep();
    stage.check("rate of a damped hinge", "rad/s", torque / damping * (1 - std::exp(-damping * since / inertia)),
                bodies[0].rate, {1e-6, "rounding; the step is of second order: (c dt/I)^2/12 = 1e-8"});
    stage.check("turn to a stop", "rad", -stop, bodies[1].angle, {1e-6, "it stands nearer than kAtStop"});
    stage.check("rate at a stop", "rad/s", 0, bodies[1].rate,
                {1e-9, "it stands, in units of the rate without a stop", torque / inertia * since});
    // Its rate belongs to half a step before its angle.
    const double swung = bodies[2].angle - dt / 2 * bodies[2].rate, weight = pendulum.mass * kGravity * arm;
    const Vec3 way = arm * ((std::cos(swung) - 1) * t.along + std::sin(swung) * t.up);
    stage.check("energy of a pendulum", "J", 0,
                0.5 * inertia * bodies[2].rate * bodies[2].rate - pendulum.mass * glm::dot(world.gravity, way),
                {1e-6, "rounding; the step is of second order: (w dt)^2 = 2e-9; in units of its weight's", weight});
    const Sensors last = trial.advance(1);
    stage.check("force that a lid on a hinge bears", "N", torque / arm, last.bodies.at(3).force.y,
                {1e-3, "the lid is oblique by 8 um in 10 mm"});
    stage.check("torque that it bears", "N m", torque, last.bodies.at(3).torque, {1e-4, "the rest of its swing"});
}

}  // namespace vkdose::verify
