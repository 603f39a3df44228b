// Many spheres at rest. The law is one linear spring, so that the normal force of a contact is k times its overlap.

#include <algorithm>
#include <cmath>

#include "host/core/random.h"
#include "host/verify/cases.h"
#include "host/verify/setups.h"

namespace vkdose::verify {

namespace {

constexpr double kStiffness = 300;  // soft, so that steps are long and overlaps are well above rounding [N/m]
constexpr double kStep = 2e-5;      // 1/30 of the half period of a sphere on the floor [s]

ContactParameters grain(double mu, double rollingFriction) {
    ContactParameters p = spring(kStiffness, 0.06);
    p.mu = mu;
    p.kt = 0.286 * kStiffness;
    p.gammaT = 0.006;
    p.muR = rollingFriction;
    p.kr = 0.1 * kStiffness;
    p.gammaR = 0.002;
    return p;
}

}  // namespace

// Sphere i of n, counted from the floor with i from 0, carries the weight of the spheres above it and its own: n - i in
// all. The contact below it is therefore pressed in by (n - i) m g/k.
void column(Stage& stage) {
    const int n = 6;
    Particles stack;
    for (int i = 0; i < n; ++i) stack.add(Vec3(0, kRadius * (2 * i + 1), 0), kRadius);
    Trial trial(stage, floor(grain(0.5, 0), kStep), stack);
    trial.advanceTo(0.3);
    const double one = massOf(kRadius) * kGravity / kStiffness;
    double below = -kRadius;  // the floor acts as a sphere's upper end at y = 0
    for (int i = 0; i < n; ++i) {
        const double y = trial.now().position[i].y;
        const double overlap = below + 2 * kRadius - y;
        below = y;
        stage.check(i == 0 ? "overlap with the floor"
                           : "overlap of spheres " + std::to_string(i) + " and " + std::to_string(i + 1),
                    "m", (n - i) * one, overlap,
                    {5e-4, "remaining motion, rounding, in units of one sphere's share", one});
    }
}

namespace {

/// Floor y = 0 and four walls around a square of twice `half`.
std::vector<Wall> boxAround(double half) {
    return {geometry::Plane{Vec3(0), Vec3(0, 1, 0)}, geometry::Plane{Vec3(-half, 0, 0), Vec3(1, 0, 0)},
            geometry::Plane{Vec3(half, 0, 0), Vec3(-1, 0, 0)}, geometry::Plane{Vec3(0, 0, -half), Vec3(0, 0, 1)},
            geometry::Plane{Vec3(0, 0, half), Vec3(0, 0, -1)}};
}

/// Spheres of 0.8 to 1.2 mean radii on a grid of `side` x `layers` x `side` sites, 2.5 radii apart, shifted a little.
Particles grid(int side, int layers) {
    Particles p;
    std::uint64_t draw = 0;
    const auto random = [&] { return uniforms(11, Stream::Jitter, draw++)[0]; };
    const double pitch = 2.5 * kRadius;
    for (int y = 0; y < layers; ++y)
        for (int x = 0; x < side; ++x)
            for (int z = 0; z < side; ++z) {
                const Vec3 site(x - 0.5 * (side - 1), y + 0.5, z - 0.5 * (side - 1));
                const double radius = static_cast<double>(static_cast<float>(kRadius * (0.8 + 0.4 * random())));
                p.add(pitch * site + 0.04 * kRadius * (Vec3(random(), random(), random()) - 0.5), radius);
            }
    return p;
}

double weightOf(const Particles& p) {
    double mass = 0;
    for (const double radius : p.radius) mass += massOf(radius);
    return mass * kGravity;
}

/// Force of every surface on the particles at rest. These are spring forces, because there is no velocity to damp.
std::vector<Vec3> reactions(const RuledWorld& world, Trial& trial) {
    const ContactParameters& law = world.law.of(ContactClass::ParticleWall);
    std::vector<Vec3> force(world.walls.size(), Vec3(0));
    for (const Contact& c : trial.contacts()) {
        if (c.kind != ContactClass::ParticleWall) continue;
        const geometry::Closest at =
            geometry::closestPoint(world.walls[c.other].shape, trial.now().position[c.particle]);
        const double overlap = trial.now().radius[c.particle] - at.distance;
        force[c.other] += law.k1 * overlap * at.normal - law.kt * c.sliding;
    }
    return force;
}

/// Part of Lucy's kernel of width `width` around `y` that lies above `level`.
double shareAbove(double y, double level, double width) {
    const double s = std::clamp((y - level) / width, -1.0, 1.0), a = std::abs(s);
    return 0.5 + s * (1 - 2 * a * a + 2 * a * a * a - 0.6 * a * a * a * a) / 0.8;
}

/// The force that the powder bears at height `level` [N], in two ways: from the coarse-grained contact stress, and from
/// the weight above less the part of it that the walls carry. Both are smeared out alike.
struct Borne {
    double stress, weight;
};
Borne borneAt(Stage& stage, const RuledWorld& world, Trial& trial, double half, double level) {
    FieldRequest request;
    request.kernel = Kernel::Lucy;
    request.width = 4 * kRadius;
    request.contactStress = true;
    // The grid has a single cell from wall to wall, and room for every kernel below and above. `level` is in the middle
    // of a cell.
    const double h = request.width / 20, margin = half + kRadius;
    request.grid = {Vec3(-margin, level - 100.5 * h, -margin), Vec3(margin, level + 300.5 * h, margin), {1, 401, 1}};
    Borne borne{stage.backend().fields(request)[100].contactStress[1].y * 4 * margin * margin, 0};
    const Particles& p = trial.now();
    for (std::size_t i = 0; i < p.size(); ++i)
        borne.weight += massOf(p.radius[i]) * kGravity * shareAbove(p.position[i].y, level, request.width);
    for (const Contact& c : trial.contacts()) {
        if (c.kind != ContactClass::ParticleWall) continue;
        const double y = geometry::closestPoint(world.walls[c.other].shape, p.position[c.particle]).point.y;
        borne.weight -= c.force.y * shareAbove(y, level, request.width);
    }
    return borne;
}

}  // namespace

// Floor and walls together bear the weight, and opposite walls push alike. Without friction the floor bears it all.
// With friction the walls carry a part (Janssen), so that the floor bears less. The stress at half height bears the
// weight above, less the part of it that the walls carry.
void bedWeight(Stage& stage) {
    const double half = 2.6 * kRadius;
    for (const double mu : {0.0, 0.5}) {
        RuledWorld world = floor(grain(mu, 0), kStep);
        world.walls = boxAround(half);
        world.wallLoads = true;
        const Particles bed = grid(2, mu > 0 ? 32 : 16);
        Trial trial(stage, world, bed);
        trial.advanceTo(0.6);
        const std::vector<Vec3> force = reactions(world, trial);
        const double weight = weightOf(bed);
        Vec3 total(0);
        for (const Vec3& f : force) total += f;
        const Tolerance atRest{1e-3, "remaining motion, in units of the weight", weight};
        const std::string kind = mu > 0 ? ", rough" : ", smooth";
        stage.check("borne by floor and walls" + kind, "N", weight, total.y, atRest);
        const std::vector<BodyLoad> loads = trial.advance(200).bodies;
        Vec3 told(0);
        for (const BodyLoad& load : loads) told += load.force;
        stage.check("told as loads of floor and walls" + kind, "N", weight, -told.y, atRest);
        stage.check("told as a load of the floor" + kind, "N", force[0].y, -loads.at(0).force.y, atRest);
        stage.check("left to right" + kind, "N", 0, total.x, atRest);
        stage.check("front to back" + kind, "N", 0, total.z, atRest);
        double top = 0;
        for (const Vec3& x : trial.now().position) top = std::max(top, x.y);
        const Borne middle = borneAt(stage, world, trial, half, 0.5 * top);
        stage.check("borne at half height, as the stress says" + kind, "N", middle.weight, middle.stress, atRest);
        if (mu == 0)
            stage.check("share of the floor, smooth", "-", 1, force[0].y / weight, {1e-3, "remaining motion", 1});
        else
            stage.plausible("share of the floor, rough", "-", 0.5, force[0].y / weight,
                            {0.4, "Janssen: less than all, more than nothing; which depends on the packing", 1});
    }
}

// Slope of the cone with the heap's mean height (above a layer) and mean distance from the axis: for a cone these are
// h/4 and R/2, so that tan = 2 height/distance. Friction holds a heap up; without it there is none.
void heap(Stage& stage) {
    for (const double mu : {0.0, 0.5}) {
        RuledWorld world = floor(grain(mu, mu > 0 ? 0.2 : 0), kStep);
        const Particles block = grid(5, 5);
        Trial trial(stage, world, block);
        trial.advanceTo(0.6);
        Vec3 middle(0);
        for (const Vec3& x : trial.now().position) middle += x / static_cast<double>(block.size());
        double height = 0, distance = 0;
        for (std::size_t i = 0; i < block.size(); ++i) {
            height += (trial.now().position[i].y - block.radius[i]) / static_cast<double>(block.size());
            distance +=
                glm::length((trial.now().position[i] - middle) * Vec3(1, 0, 1)) / static_cast<double>(block.size());
        }
        const double slope = std::atan(2 * height / distance) * 180 / kPi;
        if (mu == 0)
            stage.check("slope without friction", "deg", 0, slope, {0.5, "a single layer, sunk in a little", 1});
        else
            stage.plausible("slope with friction", "deg", 22, slope,
                            {10, "heaps of rough spheres stand at 15 to 30 degrees; this one is small", 1});
    }
}

}  // namespace vkdose::verify
