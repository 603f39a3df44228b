// The contacts of a new case, by the closed forms of `vkdose check`.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "host/advice/figures.h"
#include "host/app/measures.h"
#include "host/app/new_design.h"

namespace vkdose {

namespace {

/// Overlaps over the radius that a new case aims at: of a mean pair under the bed's weight, and of the largest sphere
/// that hits the wall after the fall. Ten times less would take three times as many steps and change little.
constexpr double kWeightOverlap = 0.005, kFallOverlap = 0.3;
constexpr double kRestitution = 0.5;
/// Least restitution of the smallest spheres, which damping slows most.
constexpr double kLeastRestitution = 0.05;
/// The coil turns after so many times the time of the fall (host/advice/schedule_rules.cpp).
constexpr double kFalls = 5;

/// How strongly a contact holds that was pressed beyond the plastic limit: pull-off force over weight of a mean sphere.
/// They are starting points for a calibration.
double bondOf(Flow flow) {
    return flow == Flow::Free ? 0 : flow == Flow::Easy ? 5 : 50;
}

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

/// The adhesion that gives mean spheres this Bond number at the most, or as much as k_c = k gives.
void fitAdhesion(NewDesign& d, const Figures& f, ContactParameters p, double density) {
    const double wanted = bondOf(d.flow);
    if (wanted == 0) {
        d.adhesion = {0, "none"};
        return;
    }
    const double weight = 4.0 / 3.0 * kPi * density * std::pow(f.mean, 3) * 9.81;
    const auto bond = [&](double ratio) {
        p.kc = ratio * p.k2Max;
        return pullOffUnder(p, f.mean, std::numeric_limits<double>::infinity()) / weight;
    };
    double low = 0, high = 1;
    for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high);
        (bond(middle) < wanted ? low : high) = middle;
    }
    d.adhesion.value = rounded(high, 2);
    d.adhesion.why = fmt::format("a contact pressed hard holds {} times the weight of a mean sphere",
                                 figureText(bond(d.adhesion.value), 2));
}

}  // namespace

void fitContacts(NewDesign& d, const Case& trial) {
    const Figures f = figuresOf(trial, insertParticles(trial));
    const double density = trial.world.density;
    ContactParameters p = trial.dosingLaw.of(ContactClass::ParticleParticle);
    fitStiffness(d, f, p);
    p.k2Max = d.stiffness.value;
    p.k1 = d.k1OverK * d.stiffness.value;
    fitAdhesion(d, f, p, density);
    d.damping.value = rounded(std::min(dampingFor(kRestitution, p, density, f.mean, f.mean),
                                       dampingFor(kLeastRestitution, p, density, f.smallest, f.smallest)),
                              2);
    p.gamma = d.damping.value;
    d.damping.why = fmt::format("kg/s; mean spheres rebound with {} of their speed, by damping alone",
                                figureText(restitution(p, density, f.mean, f.mean), 2));
    d.settle.value = roundedUp(kFalls * f.fallTime, 2);
    d.settle.why = fmt::format("{} times the fall of the fill ({}), so that the bed rests before dose 1", kFalls,
                               lengthText(f.fall));
}

}  // namespace vkdose
