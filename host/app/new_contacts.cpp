// The contacts of a new case, by the closed forms of `vkdose check`.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/advice/figures.h"
#include "host/app/measures.h"
#include "host/app/new_design.h"

namespace vkdose {

namespace {

/// Overlaps over the radius that a new case aims at: of a mean pair under the bed's weight, and of the largest sphere
/// that hits the wall after the fall. Ten times less would take three times as many steps and change little.
constexpr double kWeightOverlap = 0.005, kFallOverlap = 0.3;
/// A bed rests after so many times the time of the fall at the latest, or something is wrong with it.
constexpr double kFalls = 10;

void fitStiffness(NewDesign& d, const Figures& f, const ContactParameters& trial) {
    const double byWeight = trial.k1 * f.overlapUnderBed / kWeightOverlap;
    const double byFall = trial.k1 * std::pow(f.overlapOfFall / kFallOverlap, 2);
    d.stiffness.value = roundedUp(std::max(byWeight, byFall) / d.k1OverK, 2);
    d.stiffness.why =
        byWeight > byFall
            ? fmt::format("N/m; under the bed's weight ({} deep) mean spheres overlap by {} of their radius",
                          lengthText(f.bedDepth), kWeightOverlap)
            : fmt::format("N/m; after the fall of {} a largest sphere goes {} of its radius into the wall",
                          lengthText(f.fall), kFallOverlap);
}

}  // namespace

void fitContacts(NewDesign& d, const Case& trial) {
    const Figures f = figuresOf(trial, insertParticles(trial));
    fitStiffness(d, f, trial.dosingLaw.of(ContactClass::ParticleParticle));
    d.settle.value = roundedUp(kFalls * f.fallTime, 2);
    d.settle.why = fmt::format("at the latest: {} times the fall of the fill ({})", kFalls, lengthText(f.fall));
}

}  // namespace vkdose
