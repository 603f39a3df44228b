#pragma once
// Every case, by family (= file). What each compares with what stands above its definition.

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

/// Angle off the top at which a small sphere that rolls around the neck of two large fixed ones parts from them [rad],
/// 0 if it has not after 0.3 s; `ratio` of the radii. The case `neck` for one ratio, large ones too.
double partingFromNeck(Bench& bench, double ratio, double timeStep);

}  // namespace vkdose::verify
