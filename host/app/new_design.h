#pragma once
// What follows from the answers to `vkdose new`: a case with a reason for each of its values.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "host/app/new_answers.h"
#include "host/model/case.h"
#include "host/model/powder_file.h"

namespace vkdose {

/// A value in SI, and how it came about: "given", or by which rule.
struct Reasoned {
    double value = 0;
    std::string why;
};

/// A mesh that turns in place of the coil. Its longest direction lies along the canister's axis.
struct NewMesh {
    std::filesystem::path file;  ///< as the case names it: relative to the case's folder
    std::string unit;
    Vec3 at{0}, rotationAxis{0, 0, 1};  ///< [m]
    double rotation = 0;                ///< [degrees]
    double turnsPerTurn = 1;            ///< the sense in which it conveys to the outlet
    double radius = 0, length = 0;      ///< [m]
    double advance = 0;                 ///< of the powder per turn, by the mesh's form [m]; 0: it conveys none
    double first = 0, last = 0;         ///< the same at its end in the canister, and at the outlet [m]
    double solid = 0;                   ///< cross-section that the mesh itself takes up, mean over its length [m2]
};

/// A powder by its file, whose contacts are those of the case.
struct NewPowder {
    std::filesystem::path file;  ///< as the case names it: relative to the case's folder
    std::string title;
    PowderSpheres spheres;
};

struct NewDesign {
    std::optional<NewMesh> mesh;
    std::optional<NewPowder> powder;
    Reasoned length, width, height, outlet, throat;  ///< of the canister [m]
    bool flatFloor = false;
    Reasoned pitch, coilLength, coilStart, wire, clearance;  ///< of the coil [m]
    Reasoned speed;                                          ///< [rad/s]
    Reasoned fill;                                           ///< [kg]
    Reasoned bulkDensity, density;                           ///< [kg/m3]
    SizeDistribution size;                                   ///< uniform or by quantiles, or that of the powder
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
    double expectedTurning = 0;         ///< time of a dose by the closed form [s]
    double target = 0;                  ///< mass to dose to [kg]; 0: doses by time
    std::vector<std::string> assumed;   ///< options that would replace what was assumed
    std::vector<std::string> notes;     ///< what the device may not have been meant to be
    std::vector<std::string> accepted;  ///< warnings of `vkdose check` that follow from what was given
};

/// `file` is the case to be written. Everything but the contacts and the time to settle, for which there are first
/// guesses. Throws UsageError where the answers contradict each other, CaseError with the faults of a powder file.
NewDesign designOf(const NewAnswers& answers, const std::filesystem::path& file);

/// Reads the mesh of `a` and lays it into the canister: throat, pitch, wire and clearance of the design become those of
/// a coil of its size. Throws UsageError.
void designMesh(NewDesign& d, const NewAnswers& a, const std::filesystem::path& file);

/// `file` as a case in `caseFile` names it: from its own folder.
std::filesystem::path fromCase(const std::filesystem::path& file, const std::filesystem::path& caseFile);

/// The design with contacts that load whatever its spheres are: without adhesion, which may need stiffer ones.
NewDesign trialOf(NewDesign design);

/// Chooses the contacts and the time to settle by the closed forms of `vkdose check`. `trial` is the case of the
/// design's `trialOf`.
void fitContacts(NewDesign& design, const Case& trial);

/// The case as commented TOML.
std::string newCaseText(const NewDesign& design);

/// The case of a design. Throws UsageError with the keys of what does not fit together.
Case caseOf(const NewDesign& design, const std::filesystem::path& file);

}  // namespace vkdose
