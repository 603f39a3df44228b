#include "host/bench/workloads.h"

#include <memory>
#include <utility>

#include "geometry/coil_mesh.h"
#include "host/bench/packing.h"

namespace vkdose::bench {

namespace {

constexpr std::uint64_t kSeed = 1;
constexpr double kTimeStep = 2.26e-6;  // the paper's [s]
constexpr double kSkin = 0.75e-3;      // 0.6 of the mean radius, as a case has it by default [m]
constexpr double kFallSpeed = 0.1;     // about that of the coil's rim [m/s]
/// The contacts of a list of particles start without history. They find it in this number of steps (9 ms for the
/// paper's case), in which sound crosses the bed some ten times.
constexpr std::uint32_t kReliefSteps = 4000;

/// The paper's parameters (physics.md), friction limited as in cases/paper-48g.toml.
RuledWorld paperWorld() {
    ContactParameters p;
    const double k = 24067;
    p.k1 = 0.2 * k;
    p.k2Max = k;
    p.kc = 0.873 * k;
    p.plasticityDepth = 0.05;
    p.gamma = 0.0827;
    p.kt = p.kr = 0.286 * k;
    p.gammaT = p.gammaR = 0.286 * p.gamma;
    p.mu = p.muR = 0.5;
    RuledWorld world;
    world.law.pairs.fill(p);
    world.law.limitFriction(CoulombLimit::Absolute);
    world.density() = 1427;
    world.timeStep = kTimeStep;
    world.skin = kSkin;
    return world;
}

/// A tile takes a second's work, so all boxes are made of the same one.
const Packing& tile() {
    static const Packing relaxed = relaxedTile(kSeed);
    return relaxed;
}

Workload boxOf(const Packing& packing) {
    Workload w{paperWorld(), packing.particles, 0, 200};
    // The packing is at rest with these.
    ContactParameters& wall = w.world.law.of(ContactClass::ParticleWall);
    wall.k1 *= 2;
    wall.k2Max *= 2;
    const Vec3 low(0), high = packing.size;
    for (glm::length_t axis = 0; axis < 3; ++axis) {
        Vec3 normal(0);
        normal[axis] = 1;
        w.world.walls.push_back(geometry::Plane{low, normal});
        w.world.walls.push_back(geometry::Plane{high, -normal});
    }
    w.world.gravity = Vec3(0);
    w.world.domain = {low - Vec3(kRadiusMax), high + Vec3(kRadiusMax)};
    return w;
}

Workload box(int nx, int ny, int nz) {
    return boxOf(tiled(tile(), nx, ny, nz));
}

/// A tile in its walls, around a coil of triangles that rests. The coil is about as large as the paper's.
Workload boxWithMesh() {
    const Vec3 size = tile().size;
    geometry::Coil coil;
    coil.radius = 10e-3;
    coil.wireRadius = 1e-3;
    coil.pitch = 9e-3;
    coil.length = 30e-3;
    coil.zStart = (size.z - coil.length) / 2;
    Workload w = boxOf(relaxedAround(coil, kSeed));
    constexpr int kAround = 16, kPerTurn = 94;  // 10,000 triangles
    RigidBody body;
    body.name = "coil";
    body.course.start.origin = Vec3(size.x / 2, size.y / 2, 0);
    body.shapes = {std::make_shared<const geometry::MeshSurface>(
        geometry::makeMesh(geometry::soupOf(geometry::coilMesh(coil, kAround, kPerTurn), "coil")).mesh,
        (kRadiusMax + kSkin) * (1 + 1e-12))};
    w.world.bodies.push_back(std::move(body));
    return w;
}

Workload freeFall() {
    const Packing& packing = tile();
    Workload w{paperWorld(), {}, 0, 64};
    // The distances are tripled, so that nothing touches and no list reaches anyone. All fall at one speed: with
    // gravity the rows would be rebuilt more often the longer it runs.
    for (std::size_t i = 0; i < packing.particles.size(); ++i)
        w.particles.add(3.0 * packing.particles.position[i], packing.particles.radius[i], Vec3(0, -kFallSpeed, 0));
    w.world.gravity = Vec3(0);
    return w;
}

Workload bedOf(const Case& c, double coilRate) {
    return {{c.world, c.dosingLaw}, insertParticles(c).particles, coilRate, kReliefSteps};
}

}  // namespace

std::vector<Plan> plans(const std::optional<Case>& bed) {
    std::vector<Plan> all;
    all.push_back({"free-fall", true, freeFall});
    if (bed) {
        all.push_back({bed->name + "-rest", true, [c = *bed] { return bedOf(c, 0); }});
        all.push_back({bed->name + "-turning", true, [c = *bed] {
                           return bedOf(
                               c, c.world.coil ? geometry::conveyingRate(*c.world.coil, c.schedule.coilSpeed) : 0.0);
                       }});
    }
    all.push_back({"bed-3k", true, [] { return box(1, 1, 1); }});
    all.push_back({"bed-3k-mesh", false, boxWithMesh, false, "bed-3k"});
    all.push_back({"bed-27k", false, [] { return box(2, 2, 2); }});
    all.push_back({"bed-100k", false, [] { return box(3, 5, 2); }});
    all.push_back({"bed-300k", false, [] { return box(5, 6, 3); }});
    all.push_back({"bed-1M", false, [] { return box(6, 10, 5); }});
    all.push_back({"bed-4M", false, [] { return box(10, 12, 10); }, true});
    return all;
}

}  // namespace vkdose::bench
