#pragma once
// The questions of `vkdose new`, each once: they are its options and its dialogue.

#include <array>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace vkdose {

/// How a powder flows, by the flow function ffc of a shear cell: free above 10, easy from 4 to 10, cohesive below.
enum class Flow { Free, Easy, Cohesive };

/// A device and its powder as far as somebody knows them, in SI. The rest follows from these (new_design.h).
struct NewAnswers {
    std::optional<std::array<double, 3>> canister;  ///< inside: length along the coil, width, height [m]
    std::optional<double> outlet, throat;           ///< diameter of the hole, length behind it [m]
    bool flatFloor = false;
    std::optional<double> turns, pitch;     ///< of the coil: one of them or both; pitch in [m]
    std::string mesh, meshUnit;             ///< in place of a coil: the file of a screw or spring, and its unit
    std::optional<double> wire, clearance;  ///< thickness, gap to the wall [m]
    std::optional<double> fill;             ///< [kg]
    std::optional<double> bulkDensity;      ///< of the settled powder [kg/m3]
    std::optional<double> density;          ///< of its particles [kg/m3]
    std::vector<double> sizes;              ///< diameters by volume: d50, or d10, d50, d90 [m]
    std::optional<Flow> flow;
    std::filesystem::path powder;         ///< file of a powder, which tells these four; empty: none
    std::optional<double> speed, rotate;  ///< [rad/s], [s]
    std::optional<double> dose;           ///< mass to dose to [kg]
    std::optional<int> doses, spheres;
};

struct NewQuestion {
    const char* option = "";  ///< "--canister"
    const char* form = "";    ///< "LxWxHmm"
    const char* meaning = "";
    const char* standard = nullptr;  ///< what holds without an answer; nullptr: an answer is needed
    const char* example = "";
    bool asked = false;  ///< in the dialogue
    /// Puts the answer `text` into its place. Throws UsageError that says what would be right.
    void (*take)(NewAnswers& answers, const NewQuestion& question, const std::string& text) = nullptr;
    bool ofPowder = false;  ///< a powder file answers it
};

std::span<const NewQuestion> newQuestions();

}  // namespace vkdose
