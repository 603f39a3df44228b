// Laws whose stiffness follows the overlap give no energy: impacts at many angles that stick, slip, roll and twist,
// without damping.

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "host/law/eepa.h"
#include "host/law/hertz.h"
#include "host/law/jkr.h"
#include "host/verify/cases.h"
#include "host/verify/setups.h"

namespace vkdose::verify {

namespace {

struct Named {
    const char* name;
    ContactParameters law;
};

/// Restitution 1 leaves no damping, and the sliders hardly ever slip.
std::array<Named, 3> lawsOfModuli() {
    const Elasticity soft{2e7, 0.25};
    ContactParameters plastic, adhesive;
    plastic.plasticityRatio = 0.2;
    adhesive.surfaceEnergy = 0.05;
    std::array<Named, 3> laws{{{"hertz-mindlin", hertzMindlin(soft, soft, 1)},
                               {"eepa", elastoPlasticAdhesive(soft, soft, 1, plastic)},
                               {"jkr", elasticAdhesive(soft, soft, 1, adhesive)}}};
    for (Named& n : laws) {
        n.law.mu = n.law.muR = n.law.muTo = 2;
        n.law.kr = n.law.kTo = 0.7;
    }
    return laws;
}

/// What a sphere that hits a wall at this angle from the normal has more than is left by the law of the normal force,
/// as share of what it had. Less than nothing: it lost more.
double gainAt(Stage& stage, const ContactParameters& p, double degrees) {
    const double speed = 0.5, theta = degrees * kPi / 180, towards = speed * std::cos(theta);
    const double mass = massOf(kRadius), deepest = overlapOfImpact(p, mass, 2 * kRadius, towards);
    RuledWorld world = space(p, deepest / towards / 500);
    world.energyBook = true;
    world.walls.push_back(geometry::Plane{Vec3(0), Vec3(0, 1, 0)});
    Particles sphere;
    sphere.add(Vec3(0, kRadius, 0), kRadius, Vec3(speed * std::sin(theta), -towards, 0),
               speed / kRadius * Vec3(0.1, 0.2, 0.1));
    const auto motion = [&](const Particles& now) {
        return (mass * glm::dot(now.velocity[0], now.velocity[0]) +
                inertiaOf(kRadius) * glm::dot(now.spin[0], now.spin[0])) /
               2;
    };
    const double before = motion(sphere);
    Trial trial(stage, world, sphere);
    for (int call = 0; call < 40; ++call) trial.advance(100);
    const EnergyBook& book = trial.energy().sum;
    return (motion(trial.now()) + book.plastic + book.adhesive - before) / before;
}

}  // namespace

void grazingImpacts(Stage& stage) {
    for (const Named& n : lawsOfModuli()) {
        double most = 0;
        for (const double degrees : {20.0, 40.0, 60.0, 70.0, 80.0, 85.0})
            most = std::max(most, gainAt(stage, n.law, degrees));
        stage.check(fmt::format("largest gain of energy, {}", n.name), "-", 0, most,
                    {1e-4, "time step of 1/500 of the way in", 1});
    }
}

}  // namespace vkdose::verify
