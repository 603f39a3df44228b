// Quantities that grow by many small steps. A single float loses a step that is less than half of its last place, and
// rounds a larger one the same way every time. So each case has steps that one float could not add up.

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "geometry/shape.h"
#include "host/verify/cases.h"
#include "host/verify/setups.h"

namespace vkdose::verify {

namespace {

constexpr double kSteps[] = {1e-9, 1e-8, 1e-7, 1e-6, 1e-5};  // [s]

/// The one of `figures` that is farthest from 1.
double farthestFromOne(const std::vector<double>& figures) {
    return *std::max_element(figures.begin(), figures.end(),
                             [](double a, double b) { return !(std::abs(a - 1) >= std::abs(b - 1)); });
}

const Tolerance kExact{1e-4, "speeds have two floats: 2^-48 of a speed is lost in a step, here at most 4e-6 of g dt"};

}  // namespace

// v = v0 + g t, for spheres that are thrown downwards or upwards, and for a body that moves freely.
void smallFalls(Stage& stage) {
    constexpr std::uint64_t steps = 2000;
    const double speeds[] = {1e-3, 0.01, 0.1, 0.6, 3, 10};
    for (const double dt : kSteps) {
        RuledWorld world = space(spring(1000), dt);
        world.gravity = Vec3(0, -kGravity, 0);
        Particles spheres;
        for (const double speed : speeds)
            for (const double sign : {-1.0, 1.0})
                spheres.add(Vec3(3 * kRadius * double(spheres.size()), 0, 0), kRadius, Vec3(0, sign * speed, 0));
        RigidBody ball;
        ball.name = "ball";
        ball.shapes = {geometry::Ball{Vec3(0), kRadius}};
        ball.course.start.origin = Vec3(0, 0, 10 * kRadius);
        ball.course.motion = geometry::Free{massOf(kRadius), Vec3(0, -10, 0), {}};
        ball.clock = Clock::Forces;
        world.bodies = {ball};
        Trial trial(stage, world, spheres);
        trial.advance(steps);
        const double gained = -kGravity * trial.halfStep();
        std::vector<double> figures;
        for (std::size_t i = 0; i < spheres.size(); ++i)
            figures.push_back((trial.now().velocity[i].y - spheres.velocity[i].y) / gained);
        stage.check(fmt::format("gain of speed over g t, dt = {:.0e} s, from 1 mm/s to 10 m/s", dt), "-", 1,
                    farthestFromOne(figures), kExact);
        stage.check(fmt::format("the same of a free body at 10 m/s, dt = {:.0e} s", dt), "-", 1,
                    (trial.freeBodies().at(0).velocity.y + 10) / gained, kExact);
    }
}

// Friction mu m g on a sphere that slips is a constant torque. The spin grows by mu m g (a - delta/2)/I in a second,
// and the speed falls by mu g. The dashpot alone bears more than the limit, so the sphere slips from the first step on.
void smallTurns(Stage& stage) {
    constexpr std::uint64_t steps = 2000;
    const double a = 1.25 / 1024;  // [m]: a float, as the device's radius is, so that no overlap is off by its rounding
    const double mu = 0.3, k = 500, slip = 1, weight = massOf(a) * kGravity, sinking = weight / k;
    ContactParameters p = spring(k);
    p.mu = mu;
    p.kt = 0.5 * k;
    p.gammaT = 1e-3;
    for (const double dt : kSteps) {
        Particles spheres;
        for (const double spin : {1.0, 30.0, 1e3, 1e4})
            spheres.add(Vec3(3 * a * double(spheres.size()), a - sinking, 0), a, Vec3(0, 0, a * spin + slip),
                        Vec3(spin, 0, 0));
        Trial trial(stage, floor(p, dt), spheres);
        trial.advance(steps);
        const double t = trial.halfStep();
        const double turned = mu * weight * (a - sinking / 2) / inertiaOf(a) * t;
        std::vector<double> spins, speeds;
        for (std::size_t i = 0; i < spheres.size(); ++i) {
            spins.push_back((trial.now().spin[i].x - spheres.spin[i].x) / turned);
            speeds.push_back((spheres.velocity[i].z - trial.now().velocity[i].z) / (mu * kGravity * t));
        }
        stage.check(fmt::format("gain of spin over that of a constant torque, dt = {:.0e} s", dt), "-", 1,
                    farthestFromOne(spins), kExact);
        stage.check(fmt::format("loss of speed over mu g t, dt = {:.0e} s", dt), "-", 1, farthestFromOne(speeds),
                    kExact);
    }
}

// A heavy sphere between two plates goes on at 1 um/s while its sliding springs are stretched already. Each of them
// must grow by the way of the sphere. Nothing is level, so that turning the spring into the tangent plane rounds as
// well.
void smallStretches(Stage& stage) {
    constexpr std::uint64_t steps = 20000, brake = 100;
    const double a = 1.25 / 1024, k = 500, sinking = 6e-7, fast = 0.01, slow = 1e-6, stretch = 3e-7;
    const Vec3 normal = Vec3(1, 2, 2) / 3.0, along = Vec3(2, -2, 1) / 3.0;
    ContactParameters p = spring(k);
    p.mu = 0.5;
    p.kt = 0.5 * k;
    for (const double dt : {1e-7, 1e-8}) {
        RuledWorld world = space(p, dt);
        world.density() = 1e12;  // so that the springs do not slow it down
        world.walls.push_back(geometry::Plane{Vec3(0), normal});
        world.walls.push_back(geometry::Plane{(2 * (a - sinking)) * normal, -normal});
        Particles one;
        one.add((a - sinking) * normal, a, fast * along);
        Trial trial(stage, world, one);
        trial.advance(static_cast<std::uint64_t>(std::llround(stretch / (fast * dt))));
        stage.backend().setGravity((slow - fast) / (double(brake) * dt) * along);
        trial.advance(brake);
        stage.backend().setGravity(Vec3(0));
        const auto springs = [&] {
            double sum = 0;
            for (const Contact& contact : trial.contacts()) sum += glm::dot(contact.sliding, along);
            return sum;
        };
        const double before = springs();
        const Vec3 from = trial.now().position[0];
        trial.advance(steps);
        const double way = glm::dot(trial.now().position[0] - from, along);
        stage.check(fmt::format("growth of a spring over the way at 1 um/s, dt = {:.0e} s", dt), "-", 1,
                    (springs() - before) / (2 * way),
                    {4 * 0x1p-45 / way, "a spring is one float; 20000 steps are good to some of its last places"});
    }
}

// A plate lifts a sphere by 1 mm/s. Its work is the weight by the way, and the mean of its load the weight, however
// many steps there are from one sensing to the next. So says the ledger.
void smallWorks(Stage& stage) {
    constexpr std::uint64_t steps = 100000;
    const double a = 1.25 / 1024, k = 500, speed = 1e-3, dt = 1e-6, weight = massOf(a) * kGravity;
    const Vec3 up(0, 0, 1);
    RuledWorld world = space(spring(k), dt);
    world.gravity = -kGravity * up;
    world.energyBook = true;
    RigidBody plate;
    plate.name = "plate";
    plate.shapes = {geometry::Cone{Vec3(0), up, 0, 10 * a, 0}};
    plate.course.motion = geometry::Slide{speed * up};
    world.bodies = {plate};
    Particles one;
    one.add((a - weight / k) * up, a, speed * up);
    Trial trial(stage, world, one);
    const BodyLoad load = trial.advance(steps).bodies.at(0);
    const double work = weight * speed * double(steps - 1) * dt;  // the springs rest in the first step
    const Tolerance tolerance{1e-4, "rounding; a float that loses what it cannot hold would be off by some 1e-3"};
    stage.check("work of the plate", "J", work, load.work, tolerance);
    stage.check("work in the ledger", "J", work, trial.energy().sum.bodyWork, tolerance);
    stage.check("mean load of the plate", "N", weight, -load.force.z, tolerance);
}

}  // namespace vkdose::verify
