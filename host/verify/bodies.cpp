// Bodies: exact shapes and meshes of themselves, at rest and in motion. However a surface is cut into triangles, a
// sphere must feel the surface alone.

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "geometry/coil_mesh.h"
#include "geometry/shape.h"
#include "host/verify/cases.h"
#include "host/verify/setups.h"

namespace vkdose::verify {

namespace {

using geometry::Triangle;
using Triangles = std::vector<Triangle>;

/// The plane y = 0 from x = z = -6 to 60 radii, in columns that are in turn 3, 0.37 and 0.02 radii wide, and rows that
/// are 2.1 and 0.6 radii deep, with diagonals either way: facets larger and smaller than the sphere, and needles.
Triangles unevenFloor() {
    const auto lines = [](std::vector<double> widths) {
        std::vector<double> at{-6 * kRadius};
        for (std::size_t i = 0; at.back() < 60 * kRadius; ++i)
            at.push_back(at.back() + kRadius * widths[i % widths.size()]);
        return at;
    };
    const std::vector<double> x = lines({3, 0.37, 0.02}), z = lines({2.1, 0.6});
    Triangles floor;
    for (std::size_t i = 0; i + 1 < x.size(); ++i)
        for (std::size_t j = 0; j + 1 < z.size(); ++j) {
            const Vec3 a(x[i], 0, z[j]), b(x[i], 0, z[j + 1]), c(x[i + 1], 0, z[j + 1]), d(x[i + 1], 0, z[j]);
            if ((i + j) % 2 == 0)
                floor.insert(floor.end(), {Triangle{a, b, c}, Triangle{a, c, d}});
            else
                floor.insert(floor.end(), {Triangle{a, b, d}, Triangle{b, c, d}});
        }
    return floor;
}

/// Each triangle cut into four, so many times.
Triangles finer(Triangles triangles, int times) {
    for (; times > 0; --times) {
        Triangles cut;
        for (const Triangle& t : triangles) {
            const Vec3 a = (t[0] + t[1]) / 2.0, b = (t[1] + t[2]) / 2.0, c = (t[2] + t[0]) / 2.0;
            cut.insert(cut.end(),
                       {Triangle{t[0], a, c}, Triangle{a, t[1], b}, Triangle{c, b, t[2]}, Triangle{a, b, c}});
        }
        triangles = std::move(cut);
    }
    return triangles;
}

}  // namespace

// Without slipping: acceleration 5/7 g sin(tilt), as on the plane itself, with one contact all the way.
void meshIncline(Stage& stage) {
    const double k = 500, tilt = kPi / 6, dt = 1e-5;
    ContactParameters p = spring(k, 0.02);
    p.mu = 2;
    p.kt = 0.5 * k;
    p.gammaT = 0.01;
    RuledWorld world = space(p, dt);
    // Down the slope obliquely to the rows of facets.
    const double along = 0.3;
    world.gravity =
        kGravity * Vec3(std::sin(tilt) * std::cos(along), -std::cos(tilt), std::sin(tilt) * std::sin(along));
    world.bodies = {bodyOf({meshOf(unevenFloor())})};
    Particles one;
    one.add(Vec3(0.1, 1, 0.1) * kRadius - Vec3(0, massOf(kRadius) * kGravity * std::cos(tilt) / k, 0), kRadius);
    Trial trial(stage, world, one);
    std::size_t most = 0, least = 1;
    for (int look = 0; look < 56; ++look) {
        trial.advance(250);
        const std::size_t contacts = trial.contacts().size();
        most = std::max(most, contacts);
        least = std::min(least, contacts);
    }
    const double speed = 5.0 / 7 * kGravity * std::sin(tilt) * trial.halfStep();
    const Tolerance tolerance{2e-4, "tangential oscillation on the spring's stretch, lever a - delta/2"};
    const Vec3 v = trial.now().velocity[0];
    stage.check("speed", "m/s", speed, std::hypot(v.x, v.z), tolerance);
    stage.check("direction of the way", "rad", along, std::atan2(v.z, v.x), {1e-3, "facets must not turn it"});
    stage.check("spin times radius", "m/s", speed, glm::length(trial.now().spin[0]) * kRadius, tolerance);
    stage.check("rolled more than 20 radii, over some 17 columns", "-", 1,
                glm::length(trial.now().position[0] - one.position[0]) > 20 * kRadius ? 1 : 0, {0, "it must roll"});
    stage.check("most contacts at once", "-", 1, double(most), {0, "a plane is one contact, however it is cut"});
    stage.check("fewest contacts at once", "-", 1, double(least), {0, "no gap between facets"});
}

// A damped impact leaves exp(-pi zeta/sqrt(1 - zeta^2)) of the speed, with zeta = gamma/(2 sqrt(k m)), on the middle of
// a facet, on an edge or a corner of facets within a face, and on an edge and a corner of the block. A contact too many
// would be a stiffer and more damped spring.
void meshBlock(Stage& stage) {
    const double k = 500, gamma = 0.03, speed = 0.1, half = 8 * kRadius, dt = 1e-6;
    const double zeta = gamma / (2 * std::sqrt(k * massOf(kRadius)));
    const double expected = std::exp(-kPi * zeta / std::sqrt(1 - zeta * zeta));
    struct Place {
        const char* name;
        Vec3 at, from;  ///< on the block; the direction to the sphere
    };
    const double facet = half / 8;
    const Place places[] = {{"a facet", half * Vec3(1, 0, 0) + facet * Vec3(0, 0.3, 0.5), {1, 0, 0}},
                            {"an edge of facets", half * Vec3(-1, 0, 0) + facet * Vec3(0, 0, 0.5), {-1, 0, 0}},
                            {"a corner of facets", half * Vec3(0, 1, 0) + facet * Vec3(2, 0, -3), {0, 1, 0}},
                            {"an edge of the block", half * Vec3(0, -1, -1) + facet * Vec3(1.3, 0, 0), {0, -1, -1}},
                            {"a corner of the block", half * Vec3(1, 1, 1), {1, 1, 1}}};
    const geometry::Block block{Vec3(-half), Vec3(half), false};
    const Triangles coarse = geometry::tessellated(block, half, Vec3(-1), Vec3(1));
    for (const int cuts : {0, 4}) {
        RuledWorld world = space(spring(k, gamma), dt);
        world.bodies = {bodyOf({meshOf(finer(coarse, cuts))})};
        Particles spheres;
        for (const Place& place : places) {
            const Vec3 from = glm::normalize(place.from);
            spheres.add(place.at + (1.001 * kRadius) * from, kRadius, -speed * from);
        }
        Trial trial(stage, world, spheres);
        trial.advance(1500);  // an impact takes 480 of them
        for (std::size_t i = 0; i < spheres.size(); ++i)
            stage.check(fmt::format("restitution on {}, {} triangles", places[i].name, coarse.size() << (2 * cuts)),
                        "-", expected, glm::dot(trial.now().velocity[i], glm::normalize(places[i].from)) / speed,
                        {3e-3, "damping is first order in the time step: gamma dt/2m = 1.3e-3"});
    }
}

// A drum that turns under a bed. Power is torque by rate, and both are what the ledger books. The spheres' momentum
// changes by their weight and by what the drum bears.
void drumBalance(Stage& stage) {
    const double rate = 12, k = 2000, dt = 1e-5, radius = 10 * kRadius, length = 5 * kRadius;
    ContactParameters p = spring(k, 0.03);
    p.mu = 0.5;
    p.kt = 0.3 * k;
    p.gammaT = 0.01;
    RuledWorld world = space(p, dt);
    world.gravity = Vec3(0, -kGravity, 0);
    world.energyBook = true;
    const Vec3 z(0, 0, 1);
    Triangles drum;
    for (const geometry::Shape& part : {geometry::Shape(geometry::Cone{Vec3(0), z, radius, radius, length}),
                                        geometry::Shape(geometry::Cone{Vec3(0), z, 0, radius, 0}),
                                        geometry::Shape(geometry::Cone{Vec3(0, 0, length), z, 0, radius, 0})}) {
        const Triangles more = geometry::tessellated(part, kRadius, Vec3(-1), Vec3(1));
        drum.insert(drum.end(), more.begin(), more.end());
    }
    world.bodies = {bodyOf({meshOf(drum)}, geometry::Turn{z, Vec3(0), rate})};
    Particles bed;
    for (int i = 0; i < 60; ++i)
        bed.add(kRadius * Vec3(2.1 * (i % 5 - 2), 2.1 * (i / 10) - 6, 1.2 + 2.3 * (i / 5 % 2)), kRadius);
    Trial trial(stage, world, bed);
    const auto momentum = [&] {
        Vec3 sum(0);
        for (const Vec3& v : trial.now().velocity) sum += massOf(kRadius) * v;
        return sum;
    };
    trial.advance(5000);
    const Vec3 before = momentum();
    const double booked = trial.energy().sum.bodyWork;
    const std::uint64_t steps = 10000;
    const Sensors sensors = trial.advance(steps);
    const BodyLoad& load = sensors.bodies.at(0);
    const double time = double(steps) * dt, work = -load.torque * rate * time;
    const double weight = 60 * massOf(kRadius) * kGravity;
    stage.check("work of the drum", "J", work, load.work, {1e-4, "single precision of a device's sums"});
    stage.check("work in the energy ledger", "J", work, trial.energy().sum.bodyWork - booked,
                {1e-2, "the ledger counts the mean of the forces before and after a step"});
    stage.check("residual of the ledger", "J", 0, trial.energy().residual(),
                {1e-4, "rounding, in units of the work", work});
    const Vec3 gained = momentum() - before, given = (Vec3(0, -weight, 0) - load.force) * time;
    stage.check("momentum of the spheres, upwards", "kg m/s", given.y, gained.y,
                {1e-5, "rounding, in units of the weight by the time", weight * time});
    stage.check("momentum of the spheres, sideways", "kg m/s", given.x, gained.x,
                {1e-5, "rounding, in units of the weight by the time", weight * time});
}

// As the coil (coil.cpp), bodies that the drive turns push a sphere uphill: one pitch a turn, for a torque of
// m g_z p/2 pi on the drive, whatever their form, and however coarse their meshes are.
void pushedByBodies(Stage& stage) {
    const double trough = 0.0115, slope = 20 * kPi / 180, pitch = 0.00875, length = 0.07;
    const geometry::Coil coil{.radius = 0.0104, .pitch = pitch, .wireRadius = 0.001, .length = length};
    const geometry::Flight blade{3e-3, 11e-3, 1e-3, pitch, pitch, 2 * kPi * length / pitch, 0, 0, 1};
    struct Pusher {
        std::string name;
        geometry::Shape shape;
    };
    std::vector<Pusher> pushers{{"screw", blade}};
    const auto addMesh = [&pushers](const char* of, const Triangles& triangles) {
        pushers.push_back({fmt::format("{} of {} triangles", of, triangles.size()), meshOf(triangles)});
    };
    addMesh("screw", geometry::tessellated(blade, 2e-3, Vec3(-1), Vec3(1)));
    addMesh("coil", geometry::coilMesh(coil, 6, 12));
    addMesh("coil", geometry::coilMesh(coil, 16, 40));
    for (const Pusher& pusher : pushers) {
        RuledWorld world = space(spring(200, 0.05), 8e-5);
        world.gravity = kGravity * Vec3(0, -std::cos(slope), -std::sin(slope));
        world.walls = {geometry::Trough{trough}};
        world.bodies = {bodyOf({pusher.shape}, geometry::Turn{Vec3(0, 0, 1), Vec3(0), 1})};
        world.bodies[0].clock = Clock::Drive;
        Particles one;  // at the bottom, before the blade that passes it there
        one.add(Vec3(0, -(trough - kRadius), 0.75 * pitch + 1.05 * (kRadius + coil.wireRadius)), kRadius);
        Trial trial(stage, world, one);
        const bool exact = std::holds_alternative<geometry::Flight>(pusher.shape);
        const double rate = geometry::conveyingRate(coil, 4 * kPi), turn = 2 * kPi / std::abs(rate);
        trial.advanceTo(turn, rate);
        const double from = trial.now().position[0].z, since = trial.time();
        const Sensors sensors = trial.advanceTo(3 * turn, rate);
        stage.check(fmt::format("mean v_z over 2 turns, {}", pusher.name), "m/s", pitch * std::abs(rate) / (2 * kPi),
                    (trial.now().position[0].z - from) / (trial.time() - since),
                    {1e-2, "the sphere sways at the bottom, by a fiftieth of the two pitches"});
        stage.check(fmt::format("mean torque, {}", pusher.name), "N m",
                    massOf(kRadius) * kGravity * std::sin(slope) * pitch / (2 * kPi), sensors.bodies.at(0).torque,
                    exact ? Tolerance{3e-3, "the sphere sways"}
                          : Tolerance{2e-2, "each edge of facets knocks the sphere, and damping takes that work too"});
    }
}

// A sphere that sticks to a turning body stays at its radius r. With the velocity of the body at the contact point of
// the full step it would creep inwards by Omega^2 r dt/2.
void heldByBodies(Stage& stage) {
    const double k = 5000, rate = 100, dt = 4e-6, at = 0.05, press = 1e3;
    ContactParameters p = spring(k, 0.1);
    p.kt = p.kr = p.kTo = 0.3 * k;
    p.gammaT = p.gammaR = p.gammaTo = 0.1;
    p.mu = p.muR = p.muTo = 10;
    const Vec3 z(0, 0, 1);
    struct Holder {
        const char* name;
        geometry::Shape shape;
        Vec3 contact, normal;
        Clock clock;
    };
    const geometry::Shape disc = geometry::Cone{Vec3(0), z, 0, 2 * at, 0};
    const Holder holders[] = {{"a disc", disc, Vec3(at, 0, 0), z, Clock::Time},
                              {"a disc on the drive", disc, Vec3(at, 0, 0), z, Clock::Drive},
                              {"a funnel", geometry::Cone{Vec3(0), z, 0, 2 * at, 2 * at}, Vec3(at, 0, at),
                               glm::normalize(Vec3(-1, 0, 1)), Clock::Time}};
    for (const Holder& holder : holders) {
        const bool driven = holder.clock == Clock::Drive;
        RuledWorld world = space(p, dt);
        world.gravity = -press * z;
        world.bodies = {bodyOf({holder.shape}, geometry::Turn{z, Vec3(0), driven ? 1 : rate})};
        world.bodies[0].clock = holder.clock;
        const double sinking = massOf(kRadius) * press * holder.normal.z / k;
        const Vec3 start = holder.contact + (kRadius - sinking) * holder.normal;
        Particles one;
        one.add(start, kRadius, rate * glm::cross(z, start), rate * z);
        Trial trial(stage, world, one);
        const auto radius = [&] { return std::hypot(trial.now().position[0].x, trial.now().position[0].y); };
        trial.advance(5000, driven ? rate : 0);  // its springs have come to rest
        const double before = radius(), since = trial.time();
        trial.advance(10000, driven ? rate : 0);
        const double creep = rate * rate * at * dt / 2 * (trial.time() - since);
        stage.check(fmt::format("change of the radius, {}", holder.name), "m", 0, radius() - before,
                    {0.01, "terms of second order, in units of Omega^2 r dt/2 times the time", creep});
        stage.check(fmt::format("speed, {}", holder.name), "m/s", rate * radius(), glm::length(trial.now().velocity[0]),
                    {3e-4, "a spring does not turn about the normal: a slip of Omega times its stretch renews it"});
    }
}

}  // namespace vkdose::verify
