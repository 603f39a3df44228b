#pragma once
// What follows from the answers to `vkdose new`: a case with a reason for each of its values.

#include <string>
#include <vector>

#include "host/app/new_answers.h"
#include "host/model/case.h"

namespace vkdose {

/// A value in SI, and how it came about: "given", or by which rule.
struct Reasoned {
    double value = 0;
    std::string why;
};

struct NewDesign {
    Reasoned length, width, height, outlet, throat;  ///< of the canister [m]
    bool flatFloor = false;
    Reasoned pitch, coilLength, coilStart, wire, clearance;  ///< of the coil [m]
    Reasoned speed;                                          ///< [rad/s]
    Reasoned fill;                                           ///< [kg]
    Reasoned bulkDensity, density;                           ///< [kg/m3]
    SizeDistribution size;                                   ///< uniform or by quantiles
    std::string sizeWhy;
    Flow flow = Flow::Easy;
    bool flowGiven = false;
    Reasoned stiffness;             ///< k of the contacts [N/m]
    double k1OverK = 1;             ///< 1: elastic
    double bond = 0;                ///< strongest pull of a contact over the weight of a mean sphere [-]
    double friction = 0.5;          ///< between particles [-]
    double rollingFriction = 0;     ///< likewise [-]
    Reasoned settle, rotate, rest;  ///< [s]
    int doses = 3;
    double massPerDose = 0;             ///< by the closed form [kg]
    std::vector<std::string> assumed;   ///< options that would replace what was assumed
    std::vector<std::string> notes;     ///< what the device may not have been meant to be
    std::vector<std::string> accepted;  ///< warnings of `vkdose check` that follow from what was given
};

/// Everything but the contacts and the time to settle, for which there are first guesses. Throws UsageError where the
/// answers contradict each other.
NewDesign designOf(const NewAnswers& answers);

/// Chooses the contacts and the time to settle by the closed forms of `vkdose check`. `trial` is the design's case.
void fitContacts(NewDesign& design, const Case& trial);

/// The case as commented TOML.
std::string newCaseText(const NewDesign& design);

}  // namespace vkdose
