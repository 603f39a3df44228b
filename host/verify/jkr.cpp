// Elastic adhesive spheres: pull-off, the path and its area, sticking and rebound (physics.md, "Elastic adhesive
// spheres"). What is expected follows from the theory with the contact radius as its parameter.

#include <fmt/format.h>

#include <algorithm>

#include "host/law/jkr.h"
#include "host/verify/cases.h"
#include "host/verify/setups.h"

namespace vkdose::verify {

namespace {

ContactParameters sticky(double surfaceEnergy) {
    ContactParameters rest;
    rest.surfaceEnergy = surfaceEnergy;
    return elasticAdhesive({2e7, 0.25}, {2e7, 0.25}, 1, rest);
}

/// A contact of the reduced size 2 R*, by its radius.
struct Theory {
    double modulus, energy, size;

    Theory(const ContactParameters& p, double reduced)
        : modulus(p.modulus), energy(p.surfaceEnergy), size(reduced / 2) {}

    double overlap(double a) const { return a * a / size - std::sqrt(2 * kPi * energy * a / modulus); }
    double force(double a) const {
        return 4 * modulus * a * a * a / (3 * size) - std::sqrt(8 * kPi * energy * modulus * a * a * a);
    }
    double pullOff() const { return 1.5 * kPi * energy * size; }
    double lost() const { return std::cbrt(kPi * energy * size * size / (8 * modulus)); }
    double touching() const { return std::cbrt(2 * kPi * energy * size * size / modulus); }
    double free() const { return std::cbrt(4.5 * kPi * energy * size * size / modulus); }

    /// Area under the path between two contact radii, by Simpson's rule.
    double area(double from, double to) const {
        constexpr int kPieces = 1000;
        const double h = (to - from) / kPieces;
        const auto rate = [&](double a) {
            return force(a) * (2 * a / size - std::sqrt(kPi * energy / (2 * modulus * a)));
        };
        double sum = rate(from) + rate(to);
        for (int i = 1; i < kPieces; ++i) sum += (i % 2 == 1 ? 4 : 2) * rate(from + i * h);
        return sum * h / 3;
    }
    /// What the loop between touch and loss takes from every impact.
    double loop() const { return -area(lost(), touching()); }
    double stickingSpeed(double mass) const { return std::sqrt(2 * loop() / mass); }
};

}  // namespace

// A sphere meets a wall and parts: the strongest pull, the overlaps of no force and of the last one, and the loop.
void jkrPath(Stage& stage) {
    const ContactParameters p = sticky(0.3);
    const Theory known(p, 2 * kRadius);
    const double mass = massOf(kRadius), speed = 2 * known.stickingSpeed(mass), motion = mass * speed * speed / 2;
    const double widest =
        root([&](double a) { return known.area(known.touching(), a) - motion; }, known.free(), 20 * known.free());
    const double deepest = known.overlap(widest), reach = -known.overlap(known.lost());
    RuledWorld world = space(p, deepest / speed / 3000);
    world.energyBook = true;
    world.walls.push_back(geometry::Plane{Vec3(0), Vec3(0, 1, 0)});
    Particles sphere;
    sphere.add(Vec3(0, kRadius, 0), kRadius, Vec3(0, -speed, 0));
    Trial trial(stage, world, sphere);
    double most = 0, pull = 0, strongest = 0, last = 0, force = 0, unloaded = 0, before = 0;
    for (int i = 0; i < 20000; ++i) {
        const double overlap = kRadius - trial.now().position[0].y;  // at which the next step's forces act
        trial.advance(1);
        most = std::max(most, overlap);
        for (const Contact& c : trial.contacts()) {
            if (force > 0 && c.force.y <= 0) unloaded = before + (overlap - before) * force / (force - c.force.y);
            force = c.force.y;
            before = overlap;
            strongest = std::max(strongest, force);
            pull = std::max(pull, -force);
            last = overlap;
        }
    }
    const Tolerance tolerance{1e-3, "time step of 1/3000 of the way in, looked at every step"};
    stage.check("strongest pull", "N", known.pullOff(), pull, tolerance);
    stage.check("overlap without force, on the way out", "m", known.overlap(known.free()), unloaded, tolerance);
    stage.check("overlap at which it parts", "m", -reach, last,
                {5e-3, "a step of the sphere, which is fastest beside the reach", reach});
    stage.check("largest overlap", "m", deepest, most, tolerance);
    stage.check("largest force", "N", known.force(widest), strongest, tolerance);
    stage.check("area of the loop", "J", known.loop(), trial.energy().sum.adhesive, tolerance);
    stage.check("area of the loop, as the motion misses it", "J", known.loop(), motion - trial.energy().sum.kinetic,
                {5e-3, "the time step, in which the last pull ends", known.loop()});
    stage.check("contacts left", "-", 0, static_cast<double>(trial.contacts().size()), {0, "it parts", 1});
}

// Spheres that collide without damping: they stick below a speed, and above it miss what the loop takes.
void jkrRestitution(Stage& stage) {
    const double mass = massOf(kRadius) / 2;
    for (const double surfaceEnergy : {0.01, 0.3}) {
        const ContactParameters p = sticky(surfaceEnergy);
        const Theory known(p, kRadius);
        for (const double share : {0.5, 0.97, 1.05, 1.5, 5.0}) {
            const double speed = share * known.stickingSpeed(mass);
            RuledWorld world = space(p, overlapOfImpact(p, mass, kRadius, speed) / speed / (share < 1.1 ? 8000 : 3000));
            Particles pair;
            pair.add(Vec3(-kRadius, 0, 0), kRadius, Vec3(speed / 2, 0, 0));
            pair.add(Vec3(kRadius, 0, 0), kRadius, Vec3(-speed / 2, 0, 0));
            Trial trial(stage, world, pair);
            trial.advance(share < 1.1 ? 60000 : 20000);
            const double apart = trial.now().velocity[1].x - trial.now().velocity[0].x;
            const std::string what = fmt::format("{} J/m2, {:.2f} of the sticking speed: ", surfaceEnergy, share);
            if (share < 1)
                stage.check(what + "contacts left", "-", 1, static_cast<double>(trial.contacts().size()),
                            {0, "the pull takes all"});
            else
                stage.check(what + "restitution", "-", std::sqrt(1 - 1 / (share * share)), apart / speed,
                            {3e-3, "the step in which the last pull ends", 1});
        }
    }
}

// What the ledger makes of it, and that friction is a fraction of the force counted from twice the pull-off.
void jkrLedger(Stage& stage) {
    ContactParameters p = sticky(0.05);
    p.mu = 0.05;
    const Theory known(p, 2 * kRadius);
    const double mass = massOf(kRadius), towards = 3 * known.stickingSpeed(mass), along = 6 * towards;
    const double deepest = overlapOfImpact(p, mass, 2 * kRadius, towards);
    RuledWorld world = space(p, deepest / towards / 1000);
    world.energyBook = true;
    world.law.limitFriction(CoulombLimit::Luding);
    world.walls.push_back(geometry::Plane{Vec3(0), Vec3(0, 1, 0)});
    Particles sphere;
    sphere.add(Vec3(0, kRadius, 0), kRadius, Vec3(along, -towards, 0));
    Trial trial(stage, world, sphere);
    double lasts = 0, left = 0;
    for (int i = 0; i < 5000; ++i) {
        trial.advance(1);
        if (!trial.contacts().empty()) lasts += world.timeStep;
        left = trial.now().velocity[0].y;
    }
    // It slips throughout, so friction takes mu times the impulse of f + 2 Fc.
    const double impulse = mass * (towards + left) + 2 * known.pullOff() * lasts, slowed = p.mu * impulse / mass;
    const double energy = mass * (along * along + towards * towards) / 2;
    const EnergyBook& book = trial.energy().sum;
    stage.check("adhesive loss", "J", known.loop(), book.adhesive, {1e-3, "time step"});
    stage.check("speed along the wall", "m/s", along - slowed, trial.now().velocity[0].x,
                {5e-4, "it sticks for a moment at the start", slowed});
    stage.check("plastic loss", "J", 0, book.plastic, {0, "there is none", energy});
    stage.check("the time step's own loss", "J", 0, book.numerical, {1e-3, "the last pull ends in a step", energy});
    stage.check("what the ledger leaves over", "J", 0, trial.energy().residual(), {1e-5, "rounding", energy});
}

}  // namespace vkdose::verify
