#pragma once
// A law of the normal force that a user wrote: its text, what it declares, and the shader code that it becomes.
// cases/laws/README.md has the language.

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace vkdose {

inline constexpr std::size_t kMostLawParameters = 16;
inline constexpr std::size_t kMostLawMemories = 7;
inline constexpr std::size_t kMostLawProperties = 4;
/// Most trips of loops that one evaluation may take, the loops of called functions counted.
inline constexpr double kMostLawTrips = 10000;
/// The largest whole number in the head of a loop.
inline constexpr long kMostLoopBound = 1'000'000;

/// Its names stand behind this prefix in the shader, so that they meet no name of the engine.
inline constexpr std::string_view kUserPrefix = "User";
/// Before the name of a property: the function that says how it flows.
inline constexpr std::string_view kLawFlow = "flow_";

struct UserLaw {
    std::string name;                     ///< as the case gives it: "bridge.glsl"
    std::string file;                     ///< its path for messages
    std::string text;                     ///< as the user wrote it
    std::string hash;                     ///< of the text, 16 hexadecimal digits
    std::vector<std::string> parameters;  ///< in the order of their declaration
    std::vector<std::string> memories;
    std::vector<std::string> properties;  ///< numbers that each particle has
    std::vector<char> flows;              ///< of each property, whether a function says how it flows
    bool hasDamping = false, hasPull = false, hasEnergy = false, hasReach = false;  ///< whether it has these functions
    /// In place of law/user_text.glsl: the text, line by line, with the prefix; then the functions by which
    /// shaders/law/user_functions.glsl reads parameters and memory.
    std::string shader;
};

/// An answer of a law on a device beside the same in double precision.
struct LawRounding {
    std::string function;  ///< of the law
    std::string pair;      ///< of materials
    double overlap = 0;    ///< [m]
    double device = 0, exact = 0;
    double share = 0;  ///< their difference over the answer, or over a thousandth of the largest of the loading
};

/// The properties of a particle, in the order of UserLaw::properties; 0 behind them.
using LawProperties = std::array<double, kMostLawProperties>;

/// A fault in the text of a law.
struct LawFault {
    int line = 0;
    std::string problem, remedy;
};

/// A text that is no law; of a compiler's findings `remedy` is empty.
struct LawReading {
    UserLaw law;
    std::vector<LawFault> faults;  ///< if there are any, the law is of no use
};

/// Reads a law. What only a compiler can find (types, undeclared names) is not among the faults.
LawReading readLaw(const std::string& name, const std::string& text);

/// The hash of a text as UserLaw has it.
std::string lawHash(std::string_view text);

}  // namespace vkdose
