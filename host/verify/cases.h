#pragma once
// Every case, by family (= file). The comment above the definition of a case says what it compares with what.

#include "host/verify/suite.h"

namespace vkdose::verify {

// integrator.cpp
void freeFall(Stage& stage);
void bounce(Stage& stage);
void elasticOrder(Stage& stage);
void dampedOrder(Stage& stage);

// increments.cpp
void smallFalls(Stage& stage);
void smallTurns(Stage& stage);
void smallStretches(Stage& stage);
void smallWorks(Stage& stage);

// collisions.cpp
void headOnAdhesive(Stage& stage);
void headOnDamped(Stage& stage);
void obliqueSliding(Stage& stage);
void obliqueSticking(Stage& stage);

// sliding.cpp
void slipThenRoll(Stage& stage);
void inclineSlides(Stage& stage);
void coulombLimit(Stage& stage);

// rolling.cpp
void inclineRolls(Stage& stage);
void rollingResistance(Stage& stage);

// torsion.cpp
void spinDecay(Stage& stage);

// coil.cpp
void emptyCanister(Stage& stage);
void pressedAgainstWire(Stage& stage);
void pushedAlongTrough(Stage& stage);

// bodies.cpp
void meshIncline(Stage& stage);
void meshBlock(Stage& stage);
void drumBalance(Stage& stage);
void pushedByBodies(Stage& stage);
void heldByBodies(Stage& stage);
void mergingPlaces(Stage& stage);

// free_bodies.cpp
void freeBall(Stage& stage);
void drivenBody(Stage& stage);
void hingedBall(Stage& stage);
void drivenHinge(Stage& stage);

// bed.cpp
void column(Stage& stage);
void bedWeight(Stage& stage);
void heap(Stage& stage);

// momentum.cpp
void isolatedCluster(Stage& stage);

// energy.cpp
void plasticLoss(Stage& stage);
void dampingLoss(Stage& stage);
void frictionLoss(Stage& stage);
void clusterBalance(Stage& stage);

// hertz.cpp
void hertzSpheres(Stage& stage);
void hertzWall(Stage& stage);
void hertzRestitution(Stage& stage);
void hertzOblique(Stage& stage);
void hertzLedger(Stage& stage);

// chung_ooi.cpp
void hertzObliqueSticking(Stage& stage);
void hertzSpinningWall(Stage& stage);
void hertzSpinningPair(Stage& stage);
void hertzSpinningUnequal(Stage& stage);

// eepa.cpp
void eepaPath(Stage& stage);
void eepaRestitution(Stage& stage);
void eepaLedger(Stage& stage);

// grazing.cpp
void grazingImpacts(Stage& stage);

// jkr.cpp
void jkrPath(Stage& stage);
void jkrRestitution(Stage& stage);
void jkrLedger(Stage& stage);

// user_law.cpp
void userLawRemembers(Stage& stage);
void userLawReaches(Stage& stage);
void userLawFlows(Stage& stage);

// materials.cpp
void materialsHertz(Stage& stage);
void materialsLuding(Stage& stage);
void materialsSliding(Stage& stage);
void materialsCluster(Stage& stage);

// period.cpp
void periodRebound(Stage& stage);
void periodMomentum(Stage& stage);
void periodIncline(Stage& stage);
void periodScrew(Stage& stage);

// size_ratio.cpp
void wedgeBounce(Stage& stage);
void wedgeRest(Stage& stage);
void rollOff(Stage& stage);
void neck(Stage& stage);

/// A small sphere rolls around the neck of two large fixed ones whose radii are `ratio` times its own. Returns the
/// angle off the top at which it parts from them [rad], 0 if it has not parted after 0.3 s. This is the case `neck` for
/// one ratio, large ones too.
double partingFromNeck(Stage& stage, double ratio, double timeStep);

}  // namespace vkdose::verify
