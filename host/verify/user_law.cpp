// A law of the normal force that a user wrote: what its text says is what spheres do.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>

#include "host/law/user_law.h"
#include "host/verify/cases.h"
#include "host/verify/setups.h"

namespace vkdose::verify {

namespace {

/// Loads on one line and unloads on a steeper one (Walton and Braun 1986), and remembers the largest overlap.
constexpr const char* kHysteresis = R"(
parameter float k1, k2;
memory float largest;
float stored(float x) { return 0.5 * k2 * max(x, 0.0) * max(x, 0.0); }
float force(Contact c) {
    largest = max(largest, c.overlap);
    return max(min(k1 * c.overlap, k2 * (c.overlap - largest * (1.0 - k1 / k2))), 0.0);
}
float stiffness(Contact c) { return k2; }
float energy(Contact c) { return stored(c.overlap - largest * (1.0 - k1 / k2)); }
)";

/// A spring with a constant pull, which acts a little beyond touch.
constexpr const char* kThread = R"(
parameter float k, pull_N, length;
float force(Contact c) { return k * max(c.overlap, 0.0) - pull_N; }
float stiffness(Contact c) { return k; }
float energy(Contact c) { return 0.5 * k * max(c.overlap, 0.0) * max(c.overlap, 0.0) - pull_N * (c.overlap + length); }
float reach(Contact c) { return length; }
)";

/// A spring that is at rest at an overlap, through which heat flows.
constexpr const char* kHeat = R"(
parameter float k, rest, h;
particle float heat;
float force(Contact c) { return k * (c.overlap - rest); }
float stiffness(Contact c) { return k; }
float flow_heat(Contact c) { return h * (heat.y - heat.x); }
)";

ContactLaw lawOf(const char* text, const std::vector<double>& parameters, double reach) {
    const LawReading reading = readLaw("verify.glsl", text);
    if (!reading.faults.empty()) throw std::logic_error(reading.faults.front().problem);
    ContactLaw law;
    law.user = std::make_shared<const UserLaw>(reading.law);
    ContactParameters p;
    p.law = NormalLaw::User;
    p.reach = reach;
    std::copy(parameters.begin(), parameters.end(), p.own.begin());
    law.pairs.fill(p);
    return law;
}

}  // namespace

// A sphere meets a wall: what it remembers from the way in decides the way out.
void userLawRemembers(Stage& stage) {
    const double mass = massOf(kRadius), speed = 0.2, k1 = 400;
    for (const double ratio : {1.5, 4.0}) {
        const double deepest = speed * std::sqrt(mass / k1);
        RuledWorld world = space({}, deepest / speed / 3000);
        world.law = lawOf(kHysteresis, {k1, ratio * k1}, 0);
        world.energyBook = true;
        world.walls.push_back(geometry::Plane{Vec3(0), Vec3(0, 1, 0)});
        Particles sphere;
        sphere.add(Vec3(0, kRadius, 0), kRadius, Vec3(0, -speed, 0));
        Trial trial(stage, world, sphere);
        double most = 0;
        for (int i = 0; i < 1000; ++i) {
            trial.advance(10);
            most = std::max(most, kRadius - trial.now().position[0].y);
        }
        const std::string steeper = fmt::format(", {} times as stiff on the way out", ratio);
        const Tolerance tolerance{1e-3, "time step of 1/3000 of the way in"};
        stage.check("largest overlap" + steeper, "m", deepest, most, tolerance);
        stage.check("restitution" + steeper, "-", 1 / std::sqrt(ratio), trial.now().velocity[0].y / speed, tolerance);
        stage.check("plastic loss" + steeper, "J", mass * speed * speed / 2 * (1 - 1 / ratio),
                    trial.energy().sum.plastic, tolerance);
    }
}

// Two spheres meet, and pull at each other until they are apart by the reach of the law.
void userLawReaches(Stage& stage) {
    const double mass = massOf(kRadius) / 2, speed = 0.2, k = 400, length = kRadius / 20;
    const double motion = mass * speed * speed / 2, pull = 0.3 * motion / length;
    const double deepest = (pull + std::sqrt(pull * pull + 2 * k * motion)) / k;
    RuledWorld world = space({}, deepest / speed / 3000);
    world.law = lawOf(kThread, {k, pull, length}, length);
    world.energyBook = true;
    Particles pair;
    pair.add(Vec3(-kRadius, 0, 0), kRadius, Vec3(speed / 2, 0, 0));
    pair.add(Vec3(kRadius, 0, 0), kRadius, Vec3(-speed / 2, 0, 0));
    Trial trial(stage, world, pair);
    double most = 0, last = 0;
    for (int i = 0; i < 20000; ++i) {
        const double overlap = 2 * kRadius - (trial.now().position[1].x - trial.now().position[0].x);
        trial.advance(1);
        most = std::max(most, overlap);
        if (!trial.contacts().empty()) last = overlap;
    }
    const double apart = trial.now().velocity[1].x - trial.now().velocity[0].x;
    stage.check("largest overlap", "m", deepest, most, {1e-3, "time step of 1/3000 of the way in"});
    stage.check("overlap at which they part", "m", -length, last, {5e-3, "a step of the spheres"});
    stage.check("restitution", "-", std::sqrt(0.7), apart / speed, {1e-3, "the step in which the last pull ends"});
    stage.check("loss", "J", pull * length, trial.energy().sum.plastic, {5e-3, "the step in which the last pull ends"});
    stage.check("contacts left", "-", 0, static_cast<double>(trial.contacts().size()), {0, "they part", 1});
}

// Two spheres and a sphere at a wall are at rest, and what a user's law gives them flows until it is even.
void userLawFlows(Stage& stage) {
    const double k = 400, rest = kRadius / 100, h = 2, dt = 1e-5;
    constexpr int kSteps = 20000;
    RuledWorld world = space({}, dt);
    world.law = lawOf(kHeat, {k, rest, h}, 0);
    world.properties = world.law.user->properties;
    world.walls.push_back(geometry::Plane{Vec3(0, -10 * kRadius, 0), Vec3(0, 1, 0)});
    world.materials[kWallMaterial].properties = {3};
    Particles spheres;
    spheres.add(Vec3(0), kRadius);
    spheres.add(Vec3(2 * kRadius - rest, 0, 0), kRadius);
    spheres.add(Vec3(0, -9 * kRadius - rest, 0), kRadius);
    spheres.properties = {{2}, {1}, {-1}};
    Trial trial(stage, world, spheres);
    trial.advance(kSteps);
    const std::vector<LawProperties> now = trial.now().properties;
    // A step takes 2 h dt of the difference, at the wall h dt.
    const double even = std::pow(1 - 2 * h * dt, kSteps), atWall = std::pow(1 - h * dt, kSteps);
    const Tolerance tolerance{1e-5, "single precision of the flow, summed over 20,000 steps"};
    stage.check("difference of two spheres", "-", even, now[0][0] - now[1][0], tolerance);
    stage.check("sum of two spheres", "-", 3, now[0][0] + now[1][0], {1e-9, "what one loses the other has"});
    stage.check("difference to a wall", "-", 4 * atWall, 3 - now[2][0], tolerance);
}

}  // namespace vkdose::verify
