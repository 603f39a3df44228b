#include "host/model/world.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace vkdose {

std::vector<int> powdersOf(const World& world) {
    std::vector<int> powders;
    for (int m = 0; m < int(world.materials.size()); ++m)
        if (world.materials[std::size_t(m)].powder) powders.push_back(m);
    return powders;
}

std::vector<MaterialPair> occurringPairs(const World& world) {
    const std::vector<int> powders = powdersOf(world);
    std::set<int> others(powders.begin(), powders.end());
    for (std::size_t s = 0; s < world.surfaces.size(); ++s) others.insert(world.materialOf(s));
    for (const RigidBody& body : world.bodies) others.insert(body.material);
    if (world.coil) others.insert(kCoilMaterial);
    std::vector<MaterialPair> pairs;
    for (const int powder : powders)
        for (const int other : others) {
            const bool listed = other < powder && world.materials[std::size_t(other)].powder;
            if (!listed) pairs.push_back({powder, other});
        }
    return pairs;
}

std::string nameOf(const World& world, MaterialPair pair) {
    return fmt::format("{}-{}", world.materials.at(std::size_t(pair.a)).name,
                       world.materials.at(std::size_t(pair.b)).name);
}

std::vector<RigidBody> allBodies(const World& world) {
    std::vector<RigidBody> bodies = world.bodies;
    if (!world.coil) return bodies;
    RigidBody coil;
    coil.name = "coil";
    coil.shapes = {*world.coil};
    coil.course.motion = geometry::Turn{Vec3(0, 0, 1), Vec3(0), 1};  // a radian for each of the drive
    coil.clock = Clock::Drive;
    coil.material = kCoilMaterial;
    coil.surfaceMoves = world.coilSurfaceMoves;
    coil.curvature = world.coilWireCurved ? world.coil->wireRadius : 0;
    bodies.push_back(std::move(coil));
    return bodies;
}

}  // namespace vkdose
