#pragma once
// One function for each warning. The list of them, with their names, is in advice.cpp.

#include <optional>
#include <string>

#include "host/advice/figures.h"
#include "host/model/case.h"

namespace vkdose {

/// A case with all that the rules judge it by.
struct Subject {
    const Case& c;
    const Insertion& filled;
    Derived derived;
    Figures f;
    Node tree;  ///< of the resolved case

    /// Whether a coil turns in doses.
    bool doses() const { return c.world.coil && c.schedule.rotateTime > 0; }
    /// The value at "coil.pitch_mm", or null.
    const Node* node(const std::string& key) const;
    /// The value at "coil.pitch_mm" as the resolved case has it; empty if it has none.
    std::string value(const std::string& key) const;
    /// The same for people: a softened value says so, because the file has another one.
    std::string shown(const std::string& key) const;
    /// The names of the warnings that the case expects.
    std::vector<std::string> accepted() const;
    /// The one of two keys that the case gives.
    const char* given(const char* first, const char* second) const { return value(first).empty() ? second : first; }
};

struct Finding {
    std::string key;
    std::string text;
    std::string cure;
};

using Found = std::optional<Finding>;

// device_rules.cpp: canister and coil
Found hugeCanister(const Subject& s);
Found narrowTurns(const Subject& s);
Found pinchedSpheres(const Subject& s);
Found shortCoil(const Subject& s);
Found lateCoil(const Subject& s);
Found coilThroughRear(const Subject& s);
Found coilAtRest(const Subject& s);
Found coilTooFast(const Subject& s);
Found narrowOutlet(const Subject& s);
Found openThroat(const Subject& s);
Found emptyThroat(const Subject& s);
Found bareCoil(const Subject& s);
Found tightDomain(const Subject& s);

// region_rules.cpp: where powder is dosed or counted
Found unreachableRegion(const Subject& s);
Found noOutlet(const Subject& s);
Found openBelow(const Subject& s);

// powder_rules.cpp: particles, contacts and gravity
Found lightOrHeavyPowder(const Subject& s);
Found strangeBulkDensity(const Subject& s);
Found strangeGravity(const Subject& s);
Found strangeFriction(const Subject& s);
Found overdampedContacts(const Subject& s);
Found strangeRestitution(const Subject& s);
Found deepUnderWeight(const Subject& s);
Found deepOfFall(const Subject& s);
Found fewSpheres(const Subject& s);
Found wideSizes(const Subject& s);
Found cumulativeSieves(const Subject& s);
Found unusedMaterial(const Subject& s);
Found roundedLaw(const Subject& s);

// body_rules.cpp: bodies
Found bodyBackwards(const Subject& s);
Found shortBody(const Subject& s);
Found mendedMesh(const Subject& s);
Found bodyOutOfScale(const Subject& s);
Found bodyOutside(const Subject& s);
Found bodyPhases(const Subject& s);
Found bodySeam(const Subject& s);
Found sphereInBody(const Subject& s);
Found thinBody(const Subject& s);
Found bodyTooFast(const Subject& s);

// sweep_rules.cpp: bodies that move through something
Found bodyInWall(const Subject& s);
Found bodiesCross(const Subject& s);

// schedule_rules.cpp: times, doses and the ends of a run
Found shortSettling(const Subject& s);
Found longDose(const Subject& s);
Found shortLongestTime(const Subject& s);
Found smallDose(const Subject& s);
Found earlyStop(const Subject& s);
Found lateRefill(const Subject& s);
Found longWindow(const Subject& s);
Found fewFrames(const Subject& s);
Found fewSensors(const Subject& s);
Found aliasedSensors(const Subject& s);
Found shortStep(const Subject& s);
Found coarseNumbers(const Subject& s);
Found longRun(const Subject& s);
Found unknownAcceptance(const Subject& s);

}  // namespace vkdose
