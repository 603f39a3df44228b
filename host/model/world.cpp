#include "host/model/world.h"

namespace vkdose {

std::vector<RigidBody> allBodies(const World& world) {
    std::vector<RigidBody> bodies = world.bodies;
    if (!world.coil) return bodies;
    RigidBody coil;
    coil.name = "coil";
    coil.shapes = {*world.coil};
    coil.course.motion = geometry::Turn{Vec3(0, 0, 1), Vec3(0), 1};  // a radian for each of the drive
    coil.clock = Clock::Drive;
    coil.kind = ContactClass::ParticleCoil;
    coil.surfaceMoves = world.coilSurfaceMoves;
    coil.curvature = world.coilWireCurved ? world.coil->wireRadius : 0;
    bodies.push_back(std::move(coil));
    return bodies;
}

}  // namespace vkdose
