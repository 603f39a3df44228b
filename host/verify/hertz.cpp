// The law of Hertz and Mindlin. Tests 1 to 4 of Chung and Ooi (2011), Granular Matter 13:643, and their closed forms.

#include <fmt/format.h>

#include <algorithm>

#include "host/law/hertz.h"
#include "host/model/stability.h"
#include "host/verify/cases.h"
#include "host/verify/setups.h"

namespace vkdose::verify {

namespace {

constexpr Elasticity kGlass{48e9, 0.2}, kAluminium{70e9, 0.3}, kOxide{380e9, 0.23};
constexpr Elasticity kRigid{1e20, 0.3};

RuledWorld elasticSpace(const ContactParameters& p, double density, double radius, double timeStep) {
    RuledWorld world = space(p, timeStep);
    world.density() = density;
    world.skin = radius / 10;
    return world;
}

/// What a head-on impact of Hertz's law is like, without damping.
struct Impact {
    double overlap, force, duration;

    Impact(const ContactParameters& p, double mass, double reduced, double speed)
        : overlap(overlapOfImpact(p, mass, reduced, speed)),
          force(2.0 / 3.0 * hertzStiffness(p, reduced, overlap) * overlap),
          duration(2.9432750 * overlap / speed) {}  // 2 times the integral of dx/sqrt(1 - x^(5/2)) from 0 to 1
};

/// Follows the first sphere until it has parted. `distance` gives that of its centre from what it meets, less the
/// distance at touch.
template <class Distance>
void followImpact(Stage& stage, Trial& trial, const Impact& known, const Distance& distance) {
    double deepest = 0, strongest = 0, parted = 0;
    while (parted == 0 && trial.time() < 2 * known.duration) {
        trial.advance(1);
        deepest = std::max(deepest, -distance(trial.now()));
        for (const Contact& c : trial.contacts()) strongest = std::max(strongest, glm::length(c.force));
        if (deepest > 0 && distance(trial.now()) > 0) parted = trial.time();
    }
    const Tolerance tolerance{1e-3, "time step of 1/100 of the contact, looked at every step"};
    stage.check("largest overlap", "m", known.overlap, deepest, tolerance);
    stage.check("largest force", "N", known.force, strongest, tolerance);
    stage.check("duration", "s", known.duration, parted, {1.0 / 100 + 1e-3, "looked at every step"});
}

}  // namespace

// Two glass spheres of 10 mm meet at 10 m/s each: 274.11 um, 10.697 kN, 40.34 us are the published figures.
void hertzSpheres(Stage& stage) {
    const double radius = 0.01, density = 2800, speed = 20;
    const ContactParameters p = hertzMindlin(kGlass, kGlass, 1);
    const double mass = reducedMass(density, radius, radius);
    const Impact known(p, mass, radius, speed);
    stage.check("published overlap", "m", 274.11e-6, known.overlap, {2e-4, "published to five digits"});
    stage.check("published force", "N", 10.697e3, known.force, {2e-4, "published to five digits"});
    stage.check("published duration", "s", 40.34e-6, known.duration, {5e-4, "published to four digits"});
    Particles pair;
    pair.add(Vec3(-radius, 0, 0), radius, Vec3(speed / 2, 0, 0));
    pair.add(Vec3(radius, 0, 0), radius, Vec3(-speed / 2, 0, 0));
    Trial trial(stage, elasticSpace(p, density, radius, known.duration / 100), pair);
    followImpact(stage, trial, known,
                 [&](const Particles& now) { return glm::length(now.position[1] - now.position[0]) - 2 * radius; });
    stage.check("restitution", "-", 1, (trial.now().velocity[1].x - trial.now().velocity[0].x) / speed,
                {2e-4, "time step, rounding"});
}

// An aluminium sphere of 100 mm meets a rigid wall at 0.2 m/s: 49.717 um, 11.370 kN, 731.6 us are the published
// figures.
void hertzWall(Stage& stage) {
    const double radius = 0.1, density = 2699, speed = 0.2;
    const ContactParameters p = hertzMindlin(kAluminium, kRigid, 1);
    const Impact known(p, reducedMass(density, radius, std::numeric_limits<double>::infinity()), 2 * radius, speed);
    stage.check("published overlap", "m", 49.717e-6, known.overlap, {2e-4, "published to five digits"});
    stage.check("published force", "N", 11.370e3, known.force, {2e-4, "published to five digits"});
    stage.check("published duration", "s", 731.6e-6, known.duration, {5e-4, "published to four digits"});
    RuledWorld world = elasticSpace(p, density, radius, known.duration / 100);
    world.walls.push_back(geometry::Plane{Vec3(0), Vec3(0, 1, 0)});
    Particles sphere;
    sphere.add(Vec3(0, radius, 0), radius, Vec3(0, -speed, 0));
    Trial trial(stage, world, sphere);
    followImpact(stage, trial, known, [&](const Particles& now) { return now.position[0].y - radius; });
}

// The restitution does not depend on the speed.
void hertzRestitution(Stage& stage) {
    const double radius = 0.0025, density = 4000;
    const std::vector<double> speeds{0.1, 3.9};
    for (const double e : {0.2, 0.5, 0.8, 1.0}) {
        const ContactParameters p = hertzMindlin(kOxide, kOxide, e);
        const double mass = reducedMass(density, radius, radius);
        const Impact slow(p, mass, radius, speeds.front()), fast(p, mass, radius, speeds.back());
        const int steps = 500;
        Particles pairs;
        for (std::size_t i = 0; i < speeds.size(); ++i) {
            const double y = 4 * radius * static_cast<double>(i);
            pairs.add(Vec3(-radius, y, 0), radius, Vec3(speeds[i] / 2, 0, 0));
            pairs.add(Vec3(radius, y, 0), radius, Vec3(-speeds[i] / 2, 0, 0));
        }
        Trial trial(stage, elasticSpace(p, density, radius, fast.duration / steps), pairs);
        trial.advanceTo(2 * slow.duration);
        for (std::size_t i = 0; i < speeds.size(); ++i) {
            const Vec3 apart = trial.now().velocity[2 * i + 1] - trial.now().velocity[2 * i];
            stage.check(fmt::format("restitution at {:.1f} m/s, e = {:.1f}", speeds[i], e), "-", e, apart.x / speeds[i],
                        {2.0 / steps * (1 - e) + 2e-4, "damping is of first order in the time step; rounding", 1});
        }
    }
}

// A sphere of aluminium oxide grazes a wall of its kind at 3.9 m/s and slips throughout: with theta from the normal
// e_t = 1 - mu (1 + e)/tan(theta), and the spin is 5/2 mu (1 + e) v_n/R.
void hertzOblique(Stage& stage) {
    const double radius = 0.0025, density = 4000, speed = 3.9, e = 0.98, mu = 0.092;
    ContactParameters p = hertzMindlin(kOxide, kOxide, e);
    p.mu = mu;
    const double mass = reducedMass(density, radius, std::numeric_limits<double>::infinity());
    const std::vector<int> degrees{50, 65, 80};
    const double slowest = speed * std::cos(80 * kPi / 180);
    const Impact longest(p, mass, 2 * radius, slowest), shortest(p, mass, 2 * radius, speed);
    RuledWorld world = elasticSpace(p, density, radius, shortest.duration / 500);
    world.walls.push_back(geometry::Plane{Vec3(0), Vec3(0, 1, 0)});
    Particles spheres;
    for (std::size_t i = 0; i < degrees.size(); ++i) {
        const double theta = degrees[i] * kPi / 180;
        spheres.add(Vec3(0, radius, 4 * radius * static_cast<double>(i)), radius,
                    speed * Vec3(std::sin(theta), -std::cos(theta), 0));
    }
    Trial trial(stage, world, spheres);
    trial.advanceTo(1.5 * longest.duration);
    for (std::size_t i = 0; i < degrees.size(); ++i) {
        const double theta = degrees[i] * kPi / 180, lost = mu * (1 + e) * speed * std::cos(theta);
        const Vec3 v = trial.now().velocity[i], w = trial.now().spin[i];
        stage.check(fmt::format("normal restitution at {} deg", degrees[i]), "-", e, v.y / (speed * std::cos(theta)),
                    {1e-3, "time step, rounding"});
        stage.check(
            fmt::format("tangential restitution at {} deg", degrees[i]), "-", 1 - lost / (speed * std::sin(theta)),
            v.x / (speed * std::sin(theta)),
            {1e-3, "it sticks for a moment at the end; in units of the loss", lost / (speed * std::sin(theta))});
        stage.check(fmt::format("spin times radius at {} deg", degrees[i]), "m/s", 2.5 * lost, -w.z * radius,
                    {3e-3, "lever R - delta/2"});
    }
}

// What the ledger makes of damped impacts and of a sphere that slips: viscous loss 1 - e^2, friction as above.
void hertzLedger(Stage& stage) {
    const double radius = 0.0025, density = 4000, speed = 1, e = 0.6, mu = 0.1, theta = 75 * kPi / 180;
    ContactParameters p = hertzMindlin(kOxide, kOxide, e);
    p.mu = mu;
    const double mass = reducedMass(density, radius, std::numeric_limits<double>::infinity());
    const double vn = speed * std::cos(theta), vt = speed * std::sin(theta);
    const Impact undamped(p, mass, 2 * radius, vn);
    const SlippingImpact impact =
        slippingImpact(stage, elasticSpace(p, density, radius, undamped.duration / 1000), radius, vt, vn, e, 2000);
    const EnergyBook& book = impact.ledger.sum;
    stage.check("viscous loss", "J", impact.normal, book.viscous, {1e-3, "damping is of first order in the time step"});
    stage.check("friction loss", "J", impact.friction, book.sliding, {2e-3, "it sticks for a moment at the end"});
    stage.check("plastic loss", "J", 0, book.plastic, {0, "the law has none", impact.energy});
    stage.check("the time step's own loss", "J", 0, book.numerical,
                {1e-4, "of second order in the step", impact.energy});
    stage.check("what the ledger leaves over", "J", 0, impact.ledger.residual(), {1e-5, "rounding", impact.energy});
}

}  // namespace vkdose::verify
