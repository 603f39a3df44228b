#pragma once
// Figures that a contact is to have (a restitution, a duration, an overlap, a Bond number), and the parameters of the
// law that give them.

#include <limits>
#include <optional>
#include <string>

#include "host/model/material.h"

namespace vkdose {

/// Contact parameters as ratios, the way the file has them.
struct Ratios {
    double k, k1, kc, plasticity, damping, mu, kt, dampingT, muR, kr, dampingR, muTo, kTo, dampingTo;

    /// Similar spheres, `s` times as soft (physics.md, "Similar softer spheres").
    void soften(double s);
    ContactParameters parameters(double adhesion) const;
};

/// The figures that the contacts of one class are to have. One that is absent leaves its parameter as it is given.
struct ContactTargets {
    /// In place of k: the largest overlap under the bed's weight over the radius [-], or the duration of a contact [s].
    std::optional<double> overlap, duration;
    std::optional<double> bond;         ///< in place of k_c: pull-off force over weight [-]
    bool bondUnderBed = false;          ///< after the bed's weight; else after a load beyond the plastic limit
    std::optional<double> restitution;  ///< in place of gamma [-]
    double speed = 0;                   ///< of the impact with that restitution [m/s]; 0: the limit of slow impacts

    bool any() const { return overlap || duration || bond || restitution; }
};

/// The contact that the targets are meant for: two spheres of the mean radius, or one and the wall or wire.
struct MeanContact {
    double mass = 0;     ///< reduced [kg]
    double reduced = 0;  ///< a* [m]
    double radius = 0;   ///< [m]
    double weight = 0;   ///< of the mean sphere [N]; 0 without gravity
    /// Mean force at the floor of the bed [N]. Absent without a bed: without a canister, or if gravity does not pull
    /// down.
    std::optional<double> load;
};

/// Why a target cannot be met: its key, the problem and the remedy.
struct MissedTarget {
    const char* key;
    std::string problem, remedy;
};

/// Changes k, damping and kc of `r` so that the contact has the targets. k1_over_k, plasticity and whatever has no
/// target stay. Returns the target that cannot be met, if there is one. With a value that is NaN (its fault is
/// already told) nothing is done.
///
/// The duration is that of `contactDuration` (case.h) on k1, so that it depends on the damping too; restitution on k1,
/// and at a speed on k_c. All are met at once.
std::optional<MissedTarget> meetTargets(const ContactTargets& targets, const MeanContact& contact, Ratios& r);

}  // namespace vkdose
