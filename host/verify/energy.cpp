// The energy ledger against closed forms: each loss in a case where it is the only one, and the balance where all
// occur.

#include <fmt/format.h>

#include <algorithm>

#include "host/core/worse.h"
#include "host/verify/cases.h"
#include "host/verify/head_on.h"
#include "host/verify/setups.h"

namespace vkdose::verify {

namespace {

/// Nothing may be left over: `scale` is the energy at stake [J].
void checkBalance(Stage& stage, const EnergyLedger& ledger, double scale, double share) {
    stage.check("what the ledger leaves over", "J", 0, ledger.residual(),
                {share, "rounding, in units of the energy at stake", scale});
}

double kineticEnergy(const Particles& p) {
    double sum = 0;
    for (std::size_t i = 0; i < p.size(); ++i)
        sum += 0.5 * massOf(p.radius[i]) * glm::dot(p.velocity[i], p.velocity[i]) +
               0.5 * inertiaOf(p.radius[i]) * glm::dot(p.spin[i], p.spin[i]);
    return sum;
}

}  // namespace

// Each pair loses 1 - e^2 of its energy. Of this k1 delta_max^2/2 (1 - 1/kappa) is the plastic loss on the way from
// loading to unloading line, and the rest, (1/kappa - e^2) of the energy, is the area under the adhesive branch.
void plasticLoss(Stage& stage) {
    const HeadOn law{.kc = 0.873 * kK2Max};
    const std::vector<double> speeds{0.2, 0.4, 0.6};
    RuledWorld world = space(plastic(law.kc, 0), 1e-7);
    world.energyBook = true;
    const Particles pairs = pairsAt(speeds);
    Trial trial(stage, world, pairs);
    trial.advanceTo(3e-4);
    double loaded = 0, plasticPart = 0, adhesivePart = 0;
    for (const double speed : speeds) {
        const double energy = 0.5 * law.reducedMass * speed * speed;
        const double kappa = 1 + (kK2Max / kK1 - 1) * speed * std::sqrt(law.reducedMass / kK1) / law.limit;
        loaded += energy;
        plasticPart += energy * (1 - 1 / kappa);
        adhesivePart += energy * (1 / kappa - law.restitutionSquared(speed));
    }
    const Tolerance tolerance{2e-4, "time step of 1/300 of the shortest half period on k2, rounding"};
    stage.check("energy loaded", "J", loaded, trial.energy().sum.loaded, {1e-6, "rounding"});
    stage.check("plastic loss", "J", plasticPart, trial.energy().sum.plastic, tolerance);
    stage.check("adhesive loss", "J", adhesivePart, trial.energy().sum.adhesive, tolerance);
    checkBalance(stage, trial.energy(), loaded, 1e-5);
}

// A linear spring with damping; parting comes half a period after touch. Here e = exp(-gamma/(2 m12) t_c), and all of
// the loss is viscous.
void dampingLoss(Stage& stage) {
    const double k = 2000, gamma = 0.05, speed = 0.1, dt = 2e-8;
    RuledWorld world = space(spring(k, gamma), dt);
    world.energyBook = true;
    Trial trial(stage, world, pairsAt({speed}));
    const double m = massOf(kRadius) / 2, half = gamma / (2 * m);
    const double duration = kPi / std::sqrt(k / m - half * half);
    const double energy = 0.5 * m * speed * speed;
    trial.advanceTo(1.2 * duration);
    stage.check("viscous loss", "J", energy * (1 - std::exp(-2 * half * duration)), trial.energy().sum.viscous,
                {half * dt + 5e-5, "damping is of first order in the time step; rounding"});
    checkBalance(stage, trial.energy(), energy, 1e-5);
}

// A sphere set sliding ends up rolling with 5/7 of its speed: friction has taken 2/7 of its energy.
void frictionLoss(Stage& stage) {
    const double mu = 0.3, start = 0.1, k = 500;
    ContactParameters p = spring(k, 0.02);
    p.mu = mu;
    p.kt = 0.5 * k;
    RuledWorld world = floor(p, 1e-5);
    world.energyBook = true;
    const double sinking = massOf(kRadius) * kGravity / k;
    Particles sphere;
    sphere.add(Vec3(0, kRadius - sinking, 0), kRadius, Vec3(start, 0, 0));
    Trial trial(stage, world, sphere);
    trial.advanceTo(3.0 / 7 * start / (mu * kGravity));  // half as long again as it takes
    const double energy = 0.5 * massOf(kRadius) * start * start;
    const double stored = 0.5 * std::pow(mu * massOf(kRadius) * kGravity, 2) / p.kt;
    stage.check("friction loss", "J", 2.0 / 7 * energy, trial.energy().sum.sliding,
                {stored / (2.0 / 7 * energy) + 1e-3,
                 "energy left in the tangential spring, which swings on; single-precision kicks of g dt"});
    checkBalance(stage, trial.energy(), energy, 1e-4);
}

// All kinds of loss occur at once, and nothing acts from outside. The energy that was loaded is motion, springs and
// losses, and no loss is negative.
void clusterBalance(Stage& stage) {
    RuledWorld world = space(everyInteraction(), 1e-6);
    world.energyBook = true;
    const Particles cluster = collapsingCluster();
    Trial trial(stage, world, cluster);
    for (int i = 0; i < 20; ++i) trial.advance(500);
    const double energy = kineticEnergy(cluster);
    const EnergyBook& book = trial.energy().sum;
    stage.check("energy loaded", "J", energy, book.loaded, {1e-5, "rounding; the opening half kick"});
    checkBalance(stage, trial.energy(), energy, 1e-5);
    stage.check("the time step's own loss", "J", 0, book.numerical,
                {2e-4, "(pi dt/t_c)^2/12 of what meets, 6e-5 with t_c on k1; some meet more than once", energy});
    double negative = 0;
    for (const double loss : {book.plastic, book.adhesive, book.viscous, book.sliding, book.rolling, book.torsion})
        negative = worse(negative, -loss);
    stage.check("the least of the losses, if negative", "J", 0, -negative, {1e-5, "rounding", energy});
}

}  // namespace vkdose::verify
