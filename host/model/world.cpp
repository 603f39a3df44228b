#include "host/model/world.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <stdexcept>

#include "host/law/law.h"

namespace vkdose {

std::vector<Vec3> imageShifts(const Vec3& period) {
    std::vector<Vec3> shifts;
    for (int d = 0; d < 3; ++d) {
        if (period[d] == 0) continue;
        Vec3 shift(0);
        shift[d] = period[d];
        const std::vector<Vec3> former = shifts;
        for (const Vec3& other : former) shifts.insert(shifts.end(), {other + shift, other - shift});
        shifts.insert(shifts.end(), {shift, -shift});
    }
    return shifts;
}

std::vector<int> powdersOf(const World& world) {
    std::vector<int> powders;
    for (int m = 0; m < int(world.materials.size()); ++m)
        if (world.materials[std::size_t(m)].powder) powders.push_back(m);
    return powders;
}

std::vector<MaterialPair> occurringPairs(const World& world) {
    const std::vector<int> powders = powdersOf(world);
    std::set<int> others(powders.begin(), powders.end());
    for (const Wall& wall : world.walls) others.insert(wall.material);
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

double longestReach(const World& world, const ContactLaw& law, double largest) {
    double longest = 0;
    for (const MaterialPair& pair : occurringPairs(world))
        longest = std::max(longest, reachOf(law.of(pair), 2 * largest));
    return longest;
}

void checkMaterials(const World& world, const ContactLaw& law, const Particles& particles) {
    const auto known = [&](int m) { return m >= 0 && m < int(world.materials.size()); };
    const auto require = [](bool holds, const std::string& what) {
        if (!holds) throw std::logic_error(what);
    };
    require(int(world.materials.size()) <= kMostMaterials, fmt::format("more than {} materials", kMostMaterials));
    require(law.pairs.materials() >= int(world.materials.size()) && law.pairs.materials() <= kMostMaterials,
            "the contact law is not of the world's materials");
    for (std::size_t s = 0; s < world.walls.size(); ++s)
        require(known(world.walls[s].material), fmt::format("wall {} is of no material", s));
    for (const RigidBody& body : world.bodies)
        require(known(body.material), fmt::format("body \"{}\" is of no material", body.name));
    require(particles.material.size() == particles.size(), "not every particle has a material");
    for (std::size_t i = 0; i < particles.size(); ++i)
        require(known(particles.material[i]) && world.materials[particles.material[i]].powder,
                fmt::format("particle {} is of no powder", i));
}

std::string nameOf(const World& world, MaterialPair pair) {
    return fmt::format("{}-{}", world.materials.at(std::size_t(pair.a)).name,
                       world.materials.at(std::size_t(pair.b)).name);
}

std::vector<RigidBody> allBodies(const World& world) {
    std::vector<RigidBody> bodies = world.bodies;
    if (!world.coil) return bodies;
    RigidBody coil;
    coil.name = kCoilName;
    coil.shapes = {*world.coil};
    coil.course.motion = geometry::Turn{Vec3(0, 0, 1), Vec3(0), 1};  // a radian for each of the drive
    coil.clock = Clock::Drive;
    coil.material = kCoilMaterial;
    coil.surfaceMoves = world.coilSurfaceMoves;
    coil.curvature = world.coilWireCurved ? world.coil->wireRadius : 0;
    bodies.push_back(std::move(coil));
    return bodies;
}

std::vector<std::string> loadNames(const World& world) {
    std::vector<std::string> names;
    for (const RigidBody& body : world.bodies) names.push_back(body.name);
    if (world.coil) names.emplace_back(kCoilName);
    if (world.wallLoads)
        for (const Wall& wall : world.walls) names.push_back(wall.name);
    return names;
}

}  // namespace vkdose
