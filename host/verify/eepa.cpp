// Edinburgh's elasto-plastic adhesive law: the published branches and the areas under them (physics.md, "Elasto-plastic
// adhesive spheres").

#include <fmt/format.h>

#include <algorithm>

#include "host/law/eepa.h"
#include "host/law/hertz.h"
#include "host/model/stability.h"
#include "host/verify/cases.h"
#include "host/verify/setups.h"

namespace vkdose::verify {

namespace {

constexpr Elasticity kPowder{2e7, 0.25};

struct Adhesion {
    double ratio, energy, pull, exponent;
};

ContactParameters sticky(const Adhesion& a) {
    ContactParameters rest;
    rest.plasticityRatio = a.ratio;
    rest.surfaceEnergy = a.energy;
    rest.constantPull = a.pull;
    rest.adhesionExponent = a.exponent;
    return elastoPlasticAdhesive(kPowder, kPowder, 1, rest);
}

/// A contact pressed to a largest overlap, as published.
struct Pressed {
    double f0, k1, k2, plastic, strongest, pole, chi, largest;

    Pressed(const ContactParameters& p, double reduced, double overlap)
        : f0(-p.constantPull),
          k1(4.0 / 3.0 * p.modulus * std::sqrt(reduced / 2)),
          k2(k1 / (1 - p.plasticityRatio)),
          plastic(std::pow(p.plasticityRatio, 2.0 / 3.0) * overlap),
          chi(p.adhesionExponent),
          largest(overlap) {
        const double patch = std::sqrt(plastic * (reduced - plastic));
        strongest = std::min(1.5 * kPi * p.surfaceEnergy * patch, k2 * std::pow(plastic, 1.5) / 2);
        pole = std::pow(std::pow(plastic, 1.5) - strongest / k2, 2.0 / 3.0);
    }

    double force() const { return f0 + k1 * std::pow(largest, 1.5); }
    double spent() const { return f0 * largest + 0.4 * k1 * std::pow(largest, 2.5); }
    double returned() const {
        return f0 * largest - strongest * pole / (chi + 1) +
               k2 * (0.4 * (std::pow(largest, 2.5) - std::pow(pole, 2.5)) - std::pow(plastic, 1.5) * (largest - pole));
    }
    double restitution() const { return std::sqrt(std::max(0.0, returned() / spent())); }
    /// Relative speed of the impact that presses so deep.
    double speed(double mass) const { return std::sqrt(2 * spent() / mass); }
};

RuledWorld stickySpace(const ContactParameters& p, double timeStep) {
    RuledWorld world = space(p, timeStep);
    world.skin = kRadius / 10;
    return world;
}

}  // namespace

// A sphere meets a wall and parts: largest overlap and force on the loading line, strongest pull at the pole.
void eepaPath(Stage& stage) {
    const ContactParameters p = sticky({0.5, 2, 5e-4, 3});
    const Pressed known(p, 2 * kRadius, 2e-5);
    const double mass = massOf(kRadius), speed = known.speed(mass), step = known.largest / speed / 3000;
    RuledWorld world = stickySpace(p, step);
    world.walls.push_back(geometry::Plane{Vec3(0), Vec3(0, 1, 0)});
    Particles sphere;
    sphere.add(Vec3(0, kRadius, 0), kRadius, Vec3(0, -speed, 0));
    Trial trial(stage, world, sphere);
    double deepest = 0, strongest = 0, pull = 0, remembered = 0;
    for (int i = 0; i < 12000; ++i) {
        trial.advance(1);
        deepest = std::max(deepest, kRadius - trial.now().position[0].y);
        for (const Contact& c : trial.contacts()) {
            strongest = std::max(strongest, c.force.y);
            pull = std::max(pull, -c.force.y);
            remembered = c.maxOverlap;
        }
    }
    const Tolerance tolerance{1e-3, "time step of 1/3000 of the way in, looked at every step"};
    stage.check("largest overlap", "m", known.largest, deepest, tolerance);
    stage.check("what the contact remembers of it", "m", known.largest, remembered, tolerance);
    stage.check("largest force", "N", known.force(), strongest, tolerance);
    stage.check("strongest pull", "N", known.strongest - known.f0, pull,
                {2e-3, "looked at every step, and the force rises steeply beyond the pole"});
    stage.check("restitution", "-", known.restitution(), trial.now().velocity[0].y / speed, tolerance);
}

// Without damping a rebound has what lies between the loading line and the path back, or the two stick.
void eepaRestitution(Stage& stage) {
    const double mass = massOf(kRadius) / 2;
    struct Powder {
        const char* name;
        Adhesion adhesion;
    };
    for (const Powder& powder : {Powder{"plastic", {0.5, 0, 0, 1.5}},
                                 {"adhesive", {0.5, 0.5, 0, 1.5}},
                                 {"fading soon", {0.7, 0.5, 2e-4, 4}},
                                 {"at its limit", {0.3, 100, 0, 1.5}}}) {
        const ContactParameters p = sticky(powder.adhesion);
        for (const double overlap : {3e-6, 1e-5, 4e-5}) {
            const Pressed known(p, kRadius, overlap);
            const double speed = known.speed(mass);
            RuledWorld world = stickySpace(p, known.largest / speed / 1000);
            Particles pair;
            pair.add(Vec3(-kRadius, 0, 0), kRadius, Vec3(speed / 2, 0, 0));
            pair.add(Vec3(kRadius, 0, 0), kRadius, Vec3(-speed / 2, 0, 0));
            Trial trial(stage, world, pair);
            trial.advance(20000);
            const bool sticks = known.returned() <= 0;
            const double apart = trial.now().velocity[1].x - trial.now().velocity[0].x;
            const std::string what = fmt::format("{}, {:.3f} m/s: ", powder.name, speed);
            if (sticks)
                stage.check(what + "contacts left", "-", 1, static_cast<double>(trial.contacts().size()),
                            {0, "the pull takes all"});
            else
                stage.check(what + "restitution", "-", known.restitution(), apart / speed,
                            {1e-3, "time step of 1/1000 of the way in", 1});
        }
    }
}

// What the ledger makes of a plastic impact that slips throughout: e^2 = (1 - 5/2 l + 3/2 l^(5/3))/(1 - l) of the
// normal motion is left with the plasticity ratio l, and friction takes the impulse mu (1 + e).
void eepaLedger(Stage& stage) {
    const double speed = 0.5, mu = 0.1, theta = 75 * kPi / 180, ratio = 0.4;
    ContactParameters p = sticky({ratio, 0, 0, 1.5});
    p.mu = mu;
    const double mass = massOf(kRadius), vn = speed * std::cos(theta), vt = speed * std::sin(theta);
    const double e = std::sqrt((1 - 2.5 * ratio + 1.5 * std::pow(ratio, 5.0 / 3.0)) / (1 - ratio));
    const double deepest = overlapOfImpact(p, mass, 2 * kRadius, vn);
    const SlippingImpact impact = slippingImpact(stage, stickySpace(p, deepest / vn / 500), kRadius, vt, vn, e, 3000);
    const EnergyBook& book = impact.ledger.sum;
    stage.check("plastic loss", "J", impact.normal, book.plastic, {1e-3, "time step"});
    stage.check("friction loss", "J", impact.friction, book.sliding, {2e-3, "it sticks for a moment at the end"});
    stage.check("the time step's own loss", "J", 0, book.numerical,
                {1e-4, "of second order in the step", impact.energy});
    stage.check("what the ledger leaves over", "J", 0, impact.ledger.residual(), {1e-5, "rounding", impact.energy});
}

}  // namespace vkdose::verify
