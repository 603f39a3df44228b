#pragma once
// Every case, by family (= file). The comment above the definition of a case says what it compares with what.

#include "host/verify/suite.h"

namespace vkdose::verify {

// integrator.cpp
void freeFall(Bench& bench);
void bounce(Bench& bench);
void elasticOrder(Bench& bench);
void dampedOrder(Bench& bench);

// collisions.cpp
void headOnAdhesive(Bench& bench);
void headOnDamped(Bench& bench);
void obliqueSliding(Bench& bench);
void obliqueSticking(Bench& bench);

// sliding.cpp
void slipThenRoll(Bench& bench);
void inclineSlides(Bench& bench);
void coulombLimit(Bench& bench);

// rolling.cpp
void inclineRolls(Bench& bench);
void rollingResistance(Bench& bench);

// torsion.cpp
void spinDecay(Bench& bench);

// coil.cpp
void emptyCanister(Bench& bench);
void pressedAgainstWire(Bench& bench);
void pushedAlongTrough(Bench& bench);

// bed.cpp
void column(Bench& bench);
void bedWeight(Bench& bench);
void heap(Bench& bench);

// momentum.cpp
void isolatedCluster(Bench& bench);

// energy.cpp
void plasticLoss(Bench& bench);
void dampingLoss(Bench& bench);
void frictionLoss(Bench& bench);
void clusterBalance(Bench& bench);

// size_ratio.cpp
void wedgeBounce(Bench& bench);
void wedgeRest(Bench& bench);
void rollOff(Bench& bench);
void neck(Bench& bench);

/// A small sphere rolls around the neck of two large fixed ones whose radii are `ratio` times its own. Returns the
/// angle off the top at which it parts from them [rad], 0 if it has not parted after 0.3 s. This is the case `neck` for
/// one ratio, large ones too.
double partingFromNeck(Bench& bench, double ratio, double timeStep);

}  // namespace vkdose::verify
