#pragma once
// Blocked outlets and arches: powder is there and does not come out.

#include <optional>
#include <vector>

#include "geometry/coil.h"
#include "host/model/case.h"
#include "host/sim/body_room.h"
#include "host/sim/dose.h"

namespace vkdose {

/// A canister counts as blocked after `doses` in a row that together give no more than `threshold`, while more than the
/// part `remaining` of the fill is still inside. The defaults are those of the paper's experiments.
struct BlockageRule {
    double threshold = 0.15e-3;  ///< [kg]
    int doses = 3;
    double remaining = 0.01;  ///< [-]
};

/// The rule for a run: that of its `stop` if it is the experiment's. Another stop rule has no threshold of its own;
/// then the paper's threshold is taken in proportion to the mass that a dose has by the closed form, or to its target
/// if that is less [kg].
BlockageRule blockageRule(const StopRule& stop, double closedForm);

/// The powder that a run was given.
struct Supply {
    struct Refill {
        double time = 0, mass = 0;  ///< [s], [kg]
    };

    Supply(double all) : mass(all) {}  // NOLINT(google-explicit-constructor): most runs have no refill
    double mass;                       ///< refills included [kg]
    std::vector<Refill> refills{};     ///< those that were made

    double until(double time) const;  ///< what had been given by that time [kg]
};

/// The first of the doses that gave nothing (counted from 1), even if an avalanche freed the outlet later; none if the
/// flow never stopped, or too few doses were made to tell. Doses before the first powder do not count, unless none ever
/// came. Doses that an empty canister made before its refill do not
/// count. Incomplete doses are left out.
std::optional<int> blockedAt(const std::vector<Dose>& doses, const Supply& supply, const BlockageRule& rule = {});

/// A void under powder that spans it.
struct Arch {
    double height = 0;  ///< of the highest void [m]
    double z = 0;       ///< where it is, along the coil [m]
    double length = 0;  ///< of all slices with a void, along the coil [m]
};

/// Looks for arches over the coil in the canister. It cuts the powder into slices two mean diameters thick along the
/// coil and looks within half the coil's radius of its axis to either side. A void is a range of heights, from the
/// floor up, that holds no powder but has powder above it. It must be two mean diameters high and reach above the
/// coil's axis. The room of a body of `world`, within a radius of its surface or closed off by it (BodyRoom), is no
/// void, and what lies below a body is held by that and not by powder. Returns the greatest void, or none. `particles`
/// and `bodies` are those of one instant; dosed particles are left out.
std::optional<Arch> archAbove(const geometry::Coil& coil, const Canister& canister, const Particles& particles,
                              const World& world = {}, const BodyPoses& bodies = {});

}  // namespace vkdose
