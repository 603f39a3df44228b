#include "host/verify/setups.h"

#include "geometry/mesh_file.h"
#include "geometry/mesh_surface.h"

namespace vkdose::verify {

double massOf(double radius) {
    return kDensity * (4.0 / 3.0) * kPi * radius * radius * radius;
}

double inertiaOf(double radius) {
    return 0.4 * massOf(radius) * radius * radius;
}

ContactParameters spring(double k, double gamma) {
    ContactParameters p;
    p.k1 = p.k2Max = k;
    p.gamma = gamma;
    return p;
}

ContactLaw lawOf(const ContactParameters& p) {
    ContactLaw law;
    law.pairs.fill(p);
    return law;
}

RuledWorld space(const ContactParameters& p, double timeStep) {
    RuledWorld world;
    world.law = lawOf(p);
    world.gravity = Vec3(0);
    world.density() = kDensity;
    world.timeStep = timeStep;
    world.skin = kRadius / 10;
    return world;
}

geometry::Shape meshOf(const std::vector<geometry::Triangle>& triangles) {
    return std::make_shared<const geometry::MeshSurface>(
        geometry::makeMesh(geometry::soupOf(triangles, "verify"), 1e-9).mesh, 1.5 * kRadius);
}

RigidBody bodyOf(std::vector<geometry::Shape> shapes, geometry::Motion motion) {
    RigidBody body;
    body.name = "body";
    body.shapes = std::move(shapes);
    body.course.motion = std::move(motion);
    return body;
}

RuledWorld floor(const ContactParameters& p, double timeStep, double gravity, double tilt) {
    RuledWorld world = space(p, timeStep);
    world.gravity = gravity * Vec3(std::sin(tilt), -std::cos(tilt), 0);
    world.walls.push_back(geometry::Plane{Vec3(0), Vec3(0, 1, 0)});
    return world;
}

Trial::Trial(Stage& stage, const RuledWorld& world, const Particles& particles)
    : backend_(&stage.backend()), now_(particles), timeStep_(world.timeStep) {
    backend_->load(world, particles);
}

Sensors Trial::advance(std::uint64_t steps, double coilRate) {
    Sensors sensors = backend_->advance(static_cast<std::uint32_t>(steps), coilRate);
    if (sensors.energy) energy_.add(*sensors.energy);
    steps_ += steps;
    now_ = backend_->particles();
    return sensors;
}

Sensors Trial::advanceTo(double seconds, double coilRate) {
    const auto target = static_cast<std::uint64_t>(std::llround(seconds / timeStep_));
    return advance(target > steps_ ? target - steps_ : 0, coilRate);
}

SlippingImpact slippingImpact(Stage& stage, RuledWorld world, double radius, double along, double towards,
                              double restitution, std::uint64_t steps) {
    world.energyBook = true;
    world.walls.push_back(geometry::Plane{Vec3(0), Vec3(0, 1, 0)});
    Particles sphere;
    sphere.add(Vec3(0, radius, 0), radius, Vec3(along, -towards, 0));
    Trial trial(stage, world, sphere);
    trial.advance(steps);
    const double mass = sphereMass(world.density(), radius);
    const double lost = world.law.of(ContactClass::ParticleWall).mu * (1 + restitution) * towards;
    const double slowed = 0.5 * mass * (along * along - (along - lost) * (along - lost));
    const double spun = 0.5 * 2.5 * mass * lost * lost;
    return {trial.energy(), 0.5 * mass * (along * along + towards * towards),
            0.5 * mass * towards * towards * (1 - restitution * restitution), slowed - spun};
}

}  // namespace vkdose::verify
