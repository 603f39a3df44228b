// The contacts of a new case, by the closed forms of `vkdose check`.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "host/advice/figures.h"
#include "host/app/measures.h"
#include "host/app/new_design.h"
#include "host/law/luding.h"
#include "host/model/size_distribution.h"

namespace vkdose {

namespace {

/// Overlaps over the radius that a new case aims at: of a mean pair under the bed's weight, and of the largest sphere
/// that hits the wall after the fall. Ten times less would take three times as many steps and change little.
constexpr double kWeightOverlap = 0.005, kFallOverlap = 0.3;
/// Share of the strongest pull that contacts of a stiffness can have with any adhesion, which the wanted pull may take.
/// All of it would take an adhesion without limit.
constexpr double kPullShare = 0.8;
/// A bed rests after so many times the time of the fall at the latest, or something is wrong with it.
constexpr double kFalls = 10;

/// The stiffness k with which a contact can pull with the wanted Bond number: the pull is in proportion to it.
double stiffnessForBond(const NewDesign& d, const Figures& f, const Case& trial) {
    const ContactParameters& pair = trial.dosingLaw.of(ContactClass::ParticleParticle);
    // A few spheres may be smaller in the mean than their distribution, by which the case counts.
    const double radius = std::max(f.mean, meanRadius(d.size));
    const double weight = sphereMass(d.density.value, radius) * glm::length(trial.world.gravity);
    const double most = strongestPull(pair, radius, std::numeric_limits<double>::infinity()) / weight;
    return pair.k2Max * d.bond / (kPullShare * most);
}

void fitStiffness(NewDesign& d, const Figures& f, const Case& trial) {
    const ContactParameters& pair = trial.dosingLaw.of(ContactClass::ParticleParticle);
    const double byWeight = pair.k1 * f.overlapUnderBed / kWeightOverlap;
    const double byFall = pair.k1 * std::pow(f.overlapOfFall / kFallOverlap, 2);
    const double byOverlap = std::max(byWeight, byFall) / d.k1OverK;
    const double byBond = d.bond > 0 ? stiffnessForBond(d, f, trial) : 0;
    d.stiffness.value = roundedUp(std::max(byOverlap, byBond), 2);
    d.stiffness.why =
        byBond > byOverlap
            ? fmt::format("N/m; so that contacts of spheres as heavy as these can hold {} of their weights",
                          figureText(d.bond))
        : byWeight > byFall
            ? fmt::format("N/m; under the bed's weight ({} deep) mean spheres overlap by {} of their radius",
                          lengthText(f.bedDepth), kWeightOverlap)
            : fmt::format("N/m; after the fall of {} a largest sphere goes {} of its radius into the wall",
                          lengthText(f.fall), kFallOverlap);
}

}  // namespace

void fitContacts(NewDesign& d, const Case& trial) {
    const Figures f = figuresOf(trial, insertParticles(trial));
    if (!d.powder) fitStiffness(d, f, trial);
    d.settle.value = roundedUp(kFalls * f.fallTime, 2);
    d.settle.why = fmt::format("at the latest: {} times the fall of the fill ({})", kFalls, lengthText(f.fall));
}

}  // namespace vkdose
