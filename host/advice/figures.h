#pragma once
// Closed forms by which a case is judged before it runs: fall, weights, overlaps, gaps, restitution, adhesion.

#include <string>
#include <vector>

#include "host/model/case.h"

namespace vkdose {

/// Restitution that damping alone gives to collisions on the loading line k1 [-]; 0 if overdamped.
struct Restitution {
    MaterialPair pair;    ///< whose contacts these are
    double mean = 0;      ///< two mean spheres, or one and the wall
    double smallest = 0;  ///< the same for the smallest
    double largest = 0;
};

/// A figure that has no meaning in a case (a gap without a coil, a bed without a canister) is NaN, so that every
/// comparison with it is false.
struct Figures {
    double smallest = 0, mean = 0, largest = 0;  ///< radii of the particles [m]
    double bedTop = 0;                           ///< y of the settled bed's top [m]
    double bedDepth = 0;                         ///< from the lowest point of the floor [m]
    double fall = 0;                             ///< height that the highest sphere falls [m]
    double fallTime = 0;                         ///< of that height [s]
    double fallSpeed = 0;                        ///< at its end [m/s]
    double overlapUnderBed = 0;  ///< of a mean pair at the floor under the bed's weight, over its radius [-]
    double overlapOfFall = 0;    ///< of the largest sphere that hits the wall after the fall, over its radius [-]
    double bondUnderBed = 0;     ///< pull-off force over weight of a mean pair that bore the bed's weight [-]
    double bondLargest = 0;      ///< the same after an overlap beyond the plastic limit [-]
    double coilGap = 0;          ///< free width between two turns, across the wire [m]
    double coilClearance = 0;    ///< between wire and trough, or hole where the coil passes it and it is narrower [m]
    std::vector<Restitution> restitutions;
    double automaticStep = 0;  ///< time step that "auto" would give, before it is cut to three digits [s]
    std::string stepLimit;     ///< the motion that limits it: "particle-wall rolling"
    double runTime = 0;        ///< simulated, as far as it can be foreseen [s]
};

/// The first powder and the material of the canister's walls.
MaterialPair canisterPair(const Case& c);

Figures figuresOf(const Case& c, const Insertion& filled);

}  // namespace vkdose
