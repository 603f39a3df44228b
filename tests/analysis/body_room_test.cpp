// Where the bed is beside bodies: densities and arches of beds with exact shapes and with meshes of the same shape.
#include "host/sim/body_room.h"

#include <cmath>
#include <map>
#include <memory>
#include <string>

#include "geometry/mesh_file.h"
#include "host/analysis/blockage.h"
#include "host/analysis/heap.h"
#include "host/analysis/settled_figures.h"
#include "host/sim/density.h"
#include "tests/analysis/beds.h"
#include "tests/geometry/mesh_samples.h"
#include "tests/support/catch.h"
#include "tests/support/near.h"

using namespace vkdose;
using namespace vkdose::test;
using geometry::Shape;

namespace {

constexpr double kSolid = 1427, kRadius = 1e-3;
const double kCubic = kSolid * kPi / 6;  // spheres on a cubic lattice that touch

World worldWith(std::vector<Shape> shapes) {
    World world;
    world.density() = kSolid;
    RigidBody body;
    body.name = "stirrer";
    body.shapes = std::move(shapes);
    world.bodies.push_back(std::move(body));
    return world;
}

/// A mesh of a box from `low` to `high`.
Shape boxMesh(const Vec3& low, const Vec3& high) {
    geometry::TriangleSoup soup;
    const Sample unit = cube();
    for (const Vec3& corner : unit.points) soup.points.push_back(low + corner * (high - low));
    soup.triangles = unit.triangles;
    soup.places.resize(soup.triangles.size());
    return std::make_shared<const geometry::MeshSurface>(geometry::makeMesh(soup).mesh, 1.6 * kRadius);
}

/// The bed without the spheres that the bodies overlap, or have inside of them (`within`). Spheres that touch a face
/// are left, whatever a rounded distance says of them.
template <class Within>
Particles without(Particles bed, const World& world, const BodyPoses& poses, const Within& within) {
    for (std::size_t i = 0; i < bed.size(); ++i) {
        bool gone = within(bed.position[i]);
        for (std::size_t b = 0; b < world.bodies.size(); ++b)
            for (const Shape& shape : world.bodies[b].shapes)
                gone = gone ||
                       !geometry::places(shape, poses.at(b).toBody(bed.position[i]), 0.999 * bed.radius[i]).empty();
        if (gone) bed.status[i] = Status::Lost;
    }
    return bed;
}

const Vec3 kLow{-5e-3, 22e-3, 16e-3}, kHigh{5e-3, 46e-3, 44e-3};

bool inBox(const Vec3& x) {
    return glm::all(glm::greaterThan(x, kLow)) && glm::all(glm::lessThan(x, kHigh));
}

/// What Steiner's formula needs of a convex body: volume, surface, integral of its mean curvature.
struct Convex {
    double volume, surface, curvature;
    /// Volume of all that is no farther from the body than this.
    double grown(double by) const { return volume + surface * by + curvature * by * by + 4 * kPi / 3 * by * by * by; }
};

Convex convexBox(const Vec3& s) {
    return {s.x * s.y * s.z, 2 * (s.x * s.y + s.y * s.z + s.z * s.x), kPi * (s.x + s.y + s.z)};
}
Convex convexRod(double r, double length) {
    return {kPi * r * r * length, 2 * kPi * r * (r + length), kPi * length + kPi * kPi * r};
}
Convex convexBall(double r) {
    return {4 * kPi / 3 * r * r * r, 4 * kPi * r * r, 4 * kPi * r};
}

}  // namespace

TEST_CASE("the density of a bed is the same with a body in it, whatever the body is made of") {
    const geometry::Coil coil = paperCoil();
    const Particles bed = layers(-10e-3, 60e-3);
    const BulkDensity free = *bedDensity(worldWith({}), bed, paperCanister(), &coil);
    const Convex box = convexBox(kHigh - kLow), cylinder = convexRod(6e-3, 32e-3), ball = convexBall(8e-3);
    const geometry::Tube rod{{0, 34e-3, 14e-3}, {0, 0, 1}, 6e-3, 32e-3, false};
    const geometry::Cone hub{{0, 34e-3, 14e-3}, {0, 0, 1}, 6e-3, 6e-3, 32e-3};
    const auto disc = [](double z) { return geometry::Cone{{0, 34e-3, z}, {0, 0, 1}, 0, 6e-3, 0}; };
    const auto inRod = [](const Vec3& x) { return std::hypot(x.x, x.y - 34e-3) < 6e-3 && x.z > 14e-3 && x.z < 46e-3; };
    struct Body {
        const char* name;
        std::vector<Shape> shapes;
        Convex convex;
        bool rod;
    };
    std::map<std::string, double> volumes;
    for (const Body& body :
         {Body{"block", {geometry::Block{kLow, kHigh}}, box, false}, Body{"mesh", {boxMesh(kLow, kHigh)}, box, false},
          Body{"rod", {rod}, cylinder, true}, Body{"hub", {hub, disc(14e-3), disc(46e-3)}, cylinder, true},
          Body{"ball", {geometry::Ball{{0, 34e-3, 30e-3}, 8e-3}}, ball, false}}) {
        CAPTURE(body.name);
        const World world = worldWith(body.shapes);
        const BodyPoses poses = bodyPoses(world, 0, 0);
        const bool boxed = std::string(body.name) != "ball" && !body.rod;
        const Particles left = without(bed, world, poses, [&](const Vec3& x) {
            return body.rod ? inRod(x) : boxed ? inBox(x) : glm::distance(x, Vec3(0, 34e-3, 30e-3)) < 8e-3;
        });
        const auto found = bedDensity(world, left, paperCanister(), &coil, poses);
        REQUIRE(found);
        // As in a bed without bodies, faces cut spheres between lattice planes.
        CHECK(nearRelative(found->density, kCubic, 0.03));
        // The room keeps a mean diameter away from the body, less what cubes of half a radius leave of that.
        const double margin = 2 * kRadius, cube = std::sqrt(3.0) * kRadius / 2, taken = free.volume - found->volume;
        CHECK(taken <= body.convex.grown(margin));
        CHECK(taken >= body.convex.grown(margin - cube));
        volumes[body.name] = found->volume;
        // Where nobody tells of the body, its place is taken for powder that is not there.
        CHECK(bedDensity(worldWith({}), left, paperCanister(), &coil)->density <
              free.density * (1 - body.convex.volume / free.volume));
    }
    CHECK(nearRelative(volumes["mesh"], volumes["block"], 1e-12));
    // The hub of discs and a cylinder is hollow, and no sphere can come into it.
    CHECK(nearRelative(volumes["hub"], volumes["rod"], 0.02));
}

TEST_CASE("a body counts where it is at that time, not where it began") {
    const geometry::Coil coil = paperCoil();
    World world = worldWith({boxMesh(kLow - Vec3(0, 0, 300e-3), kHigh - Vec3(0, 0, 300e-3))});
    world.bodies[0].course.motion = geometry::Slide{{0, 0, 0.6}};
    const BodyPoses then = bodyPoses(world, 0.5, 0), before = bodyPoses(world, 0, 0);
    const Particles left = without(layers(-10e-3, 60e-3), world, then, inBox);
    CHECK(nearRelative(bedDensity(world, left, paperCanister(), &coil, then)->density, kCubic, 0.03));
    CHECK(bedDensity(world, left, paperCanister(), &coil, before)->density < 0.9 * kCubic);

    // The settled bed keeps the poses, in a checkpoint too.
    Case c;
    c.world = world;
    c.world.coil = coil;
    c.canister = paperCanister();
    const SettledBed bed = settledBed(c, 0.5, left, {}, then);
    CHECK(nearRelative(settledFigures(c, bed).bulk->density, kCubic, 0.03));
    CHECK(nearRelative(settledDensity(c, {}, bed.particles, bed.bodies)->density, kCubic, 0.03));
    Record record;
    put(record, std::optional(bed));
    std::optional<SettledBed> back;
    get(record, left, back);
    REQUIRE(back);
    REQUIRE(back->bodies.size() == 1);
    CHECK(back->bodies[0].origin == then[0].origin);
    CHECK(back->bodies[0].rotation == then[0].rotation);
    CHECK(settledFigures(c, *back).bulk->density == settledFigures(c, bed).bulk->density);
}

TEST_CASE("a closed mesh with powder in it is a room, and one without is none") {
    // A box of triangles around the whole bed, as a container has.
    const geometry::Coil coil = paperCoil();
    const Particles bed = layers(-10e-3, 60e-3);
    const World room = worldWith({boxMesh({-20e-3, -20e-3, -10e-3}, {20e-3, 80e-3, 80e-3})});
    const auto within = bedDensity(room, bed, paperCanister(), &coil);
    const auto alone = bedDensity(worldWith({}), bed, paperCanister(), &coil);
    REQUIRE(within);
    CHECK(within->volume == alone->volume);
    CHECK(within->density == alone->density);
}

TEST_CASE("the density between the turns leaves out a shaft within the coil") {
    const geometry::Coil coil = paperCoil();
    const World world = worldWith({geometry::Tube{{0, 0, -10e-3}, {0, 0, 1}, 4e-3, 100e-3, false}});
    const BodyPoses poses = bodyPoses(world, 0, 0);
    const auto inShaft = [](const Vec3& x) { return std::hypot(x.x, x.y) < 4e-3; };
    const Particles bed = layers(-14e-3, 40e-3), left = without(bed, world, poses, inShaft);
    const auto full = coilDensity(worldWith({}), bed, paperCanister(), coil);
    const auto shaft = coilDensity(world, left, paperCanister(), coil, 0, poses);
    REQUIRE(full);
    REQUIRE(shaft);
    CHECK(shaft->volume < full->volume);
    // A ring from 6 to 11.4 mm around the axis cuts the lattice as it comes.
    CHECK(nearRelative(shaft->density, full->density, 0.05));
    CHECK(coilDensity(worldWith({}), left, paperCanister(), coil)->density < 0.92 * full->density);
}

TEST_CASE("the element test of bulk density leaves out a rod, wherever up is") {
    Particles bed;
    for (int i = -8; i <= 8; ++i)
        for (int j = 0; j < 20; ++j)
            for (int k = -8; k <= 8; ++k)
                bed.add({2 * kRadius * i, kRadius + 2 * kRadius * j, 2 * kRadius * k}, kRadius);
    // Through the bed from its floor to far above, and in the middle, where no column has a sphere then.
    const World world = worldWith({geometry::Tube{{0, 0, 0}, {0, 1, 0}, 5e-3, 80e-3, false}});
    const BodyPoses poses = bodyPoses(world, 0, 0);
    const Particles left = without(bed, world, poses, [](const Vec3& x) { return std::hypot(x.x, x.z) < 5e-3; });
    const auto found = containerDensity(world, left, 17e-3, poses);
    REQUIRE(found);
    CHECK(nearRelative(found->density, kCubic, 0.03));

    // The same lying on its side: up is along x.
    Particles lying = left;
    const Vec3 foot(0.1, 0.2, 0.3);
    for (Vec3& x : lying.position) x = foot + Vec3(x.y, -x.x, x.z);
    const BodyPoses lyingPoses{{glm::quat_cast(glm::dmat3(Vec3(0, -1, 0), Vec3(1, 0, 0), Vec3(0, 0, 1))), foot}};
    const Vec3 up(1, 0, 0);
    const auto turned = containerDensity(world, upright(lying, foot, up), 17e-3, upright(lyingPoses, foot, up));
    REQUIRE(turned);
    CHECK(nearRelative(turned->density, found->density, 0.01));
}

TEST_CASE("a rod above the coil is no arch, exact or a mesh, and a void in the powder still is") {
    const Vec3 low{-6e-3, 12e-3, 0}, high{6e-3, 22e-3, 60e-3};
    const auto inRod = [&](const Vec3& x) { return x.y > low.y && x.y < high.y && std::abs(x.x) < high.x; };
    for (const Shape& shape : {Shape(geometry::Block{low, high}), boxMesh(low, high)}) {
        const World world = worldWith({shape});
        const BodyPoses poses = bodyPoses(world, 0, 0);
        Particles bed = without(layers(-10e-3, 40e-3), world, poses, inRod);
        CHECK(archAbove(paperCoil(), paperCanister(), bed));  // where nobody tells of the rod
        CHECK_FALSE(archAbove(paperCoil(), paperCanister(), bed, world, poses));
        for (std::size_t i = 0; i < bed.size(); ++i)
            if (bed.position[i].y > 25e-3 && bed.position[i].y < 35e-3) bed.status[i] = Status::Dosed;
        const auto arch = archAbove(paperCoil(), paperCanister(), bed, world, poses);
        REQUIRE(arch);
        CHECK(near(arch->height, 10e-3, 10e-3, 1e-9));  // from the spheres on the rod to those above the void
    }
}
