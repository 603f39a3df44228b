#include "host/verify/suite.h"

#include <limits>

#include "host/core/error.h"
#include "host/verify/cases.h"

namespace vkdose::verify {

std::vector<Scene> scenes() {
    return {
        {"integrator/free-fall", "a sphere falls freely", freeFall},
        {"integrator/bounce", "it falls, meets a floor that is a damped spring, and rebounds", bounce},
        {"integrator/elastic-order", "an elastic oscillator at three time steps", elasticOrder},
        {"integrator/damped-order", "a damped oscillator at three time steps", dampedOrder},
        {"increments/falls", "spheres gain speed by steps that are small beside it", smallFalls},
        {"increments/turns", "spheres that slip gain spin by such steps", smallTurns},
        {"increments/stretches", "sliding springs are stretched at 1 um/s", smallStretches},
        {"increments/works", "a slow plate lifts a sphere", smallWorks},
        {"collisions/head-on", "plastic and adhesive spheres collide, rebound or stick", headOnAdhesive},
        {"collisions/head-on-damped", "the same with damping, against another program", headOnDamped},
        {"collisions/oblique-sliding", "a sphere grazes a wall and slips throughout", obliqueSliding},
        {"collisions/oblique-sticking", "a sphere hits a wall obliquely and never slips", obliqueSticking},
        {"sliding/slip-then-roll", "a sphere set sliding on a floor ends up rolling", slipThenRoll},
        {"sliding/steep-incline", "a sphere on a slope too steep to roll without slipping", inclineSlides},
        {"sliding/coulomb-limit", "what an adhesive contact bears in friction, both readings", coulombLimit},
        {"rolling/gentle-incline", "a sphere rolls down a slope", inclineRolls},
        {"rolling/resistance", "rolling friction holds a sphere up to a certain slope", rollingResistance},
        {"torsion/spin-decay", "a sphere spinning about the normal is braked", spinDecay},
        {"coil/empty-canister", "a coil turning where no particle is does no work", emptyCanister},
        {"coil/pressed-sphere", "the turning wire drags a sphere pressed against it", pressedAgainstWire},
        {"coil/pushed-sphere", "the coil pushes a sphere along the trough", pushedAlongTrough},
        {"bodies/mesh-incline", "a sphere rolls down a slope of uneven triangles", meshIncline},
        {"bodies/mesh-block", "spheres rebound from a block of triangles, its edges and corners", meshBlock},
        {"bodies/drum-balance", "what a turning drum of triangles bears, and what it gives", drumBalance},
        {"bodies/pushed-sphere", "a screw, and meshes of screw and coil, push a sphere along the trough",
         pushedByBodies},
        {"bodies/free-ball", "a ball that moves freely meets a sphere, another falls", freeBall},
        {"bodies/driven", "a force drives bodies: against damping, to a stop, onto a sphere", drivenBody},
        {"bodies/hinged-ball", "a sphere strikes a ball on a hinge", hingedBall},
        {"bodies/hinge", "torques drive hinges: against damping, to a stop, as a pendulum, onto a sphere", drivenHinge},
        {"bodies/held-sphere", "a sphere sticks to a turning disc or funnel and stays at its radius", heldByBodies},
        {"bodies/merging", "an elastic sphere rebounds where places of a mesh become one contact", mergingPlaces},
        {"bed/column", "spheres stacked upon each other", column},
        {"bed/weight", "a bed in a box and what its floor and walls bear", bedWeight},
        {"bed/heap", "a block of spheres slumps, with friction and without", heap},
        {"momentum/cluster", "a cluster collapses with every interaction on", isolatedCluster},
        {"energy/plastic", "what plastic and adhesive collisions lose", plasticLoss},
        {"energy/damping", "what a damped collision loses", dampingLoss},
        {"energy/friction", "what a sphere loses that slips until it rolls", frictionLoss},
        {"energy/cluster", "the balance of a collapsing cluster with every interaction on", clusterBalance},
        {"energy/grazing", "spheres graze a wall under laws whose stiffness follows the overlap", grazingImpacts},
        {"hertz/spheres", "two glass spheres meet (Chung and Ooi, test 1)", hertzSpheres},
        {"hertz/wall", "an aluminium sphere meets a rigid wall (test 2)", hertzWall},
        {"hertz/restitution", "spheres rebound with the restitution given (test 3)", hertzRestitution},
        {"hertz/oblique", "a sphere grazes a wall and slips throughout (test 4)", hertzOblique},
        {"hertz/oblique-sticking", "spheres hit a wall obliquely and stick or slip (test 5)", hertzObliqueSticking},
        {"hertz/spinning-wall", "a spinning sphere hits a wall (test 6)", hertzSpinningWall},
        {"hertz/spinning-pair", "two spinning spheres meet (test 7)", hertzSpinningPair},
        {"hertz/spinning-unequal", "a spinning sphere meets a larger one (test 8)", hertzSpinningUnequal},
        {"hertz/ledger", "what a damped impact that slips loses", hertzLedger},
        {"eepa/path", "an elasto-plastic adhesive sphere meets a wall and parts", eepaPath},
        {"eepa/restitution", "such spheres collide, rebound or stick", eepaRestitution},
        {"eepa/ledger", "what a plastic impact that slips loses", eepaLedger},
        {"jkr/path", "an elastic adhesive sphere meets a wall and parts", jkrPath},
        {"jkr/restitution", "such spheres collide, rebound or stick", jkrRestitution},
        {"jkr/ledger", "what an adhesive impact that slips loses", jkrLedger},
        {"user-law/memory", "a sphere meets a wall under a law with a memory that a user wrote", userLawRemembers},
        {"user-law/reach", "spheres meet under such a law that acts beyond touch", userLawReaches},
        {"user-law/flow", "what such a law gives spheres flows between them, and to a wall", userLawFlows},
        {"materials/hertz", "elastic spheres of two powders collide", materialsHertz},
        {"materials/luding", "plastic spheres of two powders collide", materialsLuding},
        {"materials/sliding", "spheres of two powders slide on a floor and on a body", materialsSliding},
        {"materials/cluster", "a cluster of two powders collapses with every interaction on", materialsCluster},
        {"period/rebound", "two spheres meet across the end of a domain that repeats", periodRebound},
        {"period/momentum", "a cluster tumbles in a box whose ends are joined", periodMomentum},
        {"period/incline", "a sphere rolls down an endless slope", periodIncline},
        {"period/screw", "one turn of an endless screw pushes a sphere uphill", periodScrew},
        {"size-ratio/wedge-bounce", "a small sphere bounces in the wedge between two large ones", wedgeBounce},
        {"size-ratio/wedge-rest", "a small sphere comes to rest between two large cylinders", wedgeRest},
        {"size-ratio/roll-off", "a small sphere rolls off a large cylinder", rollOff},
        {"size-ratio/neck", "a small sphere rolls around the neck between two large ones", neck},
    };
}

std::vector<Scene> scenesNamed(const std::string& part) {
    std::vector<Scene> chosen;
    for (Scene& scene : scenes())
        if (scene.name.find(part) != std::string::npos) chosen.push_back(std::move(scene));
    return chosen;
}

std::vector<Check> play(const Scene& scene, Backend& backend) {
    Stage stage(backend, scene.name);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    try {
        scene.play(stage);
        if (stage.checks().empty()) stage.check("checks made", "-", nan, 0, {0, "a case must check something"});
    } catch (const RunError& e) {
        stage.check("run", "-", 0, nan, {0, e.what()});
    }
    return stage.checks();
}

}  // namespace vkdose::verify
