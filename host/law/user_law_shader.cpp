#include "host/law/user_law_shader.h"

#include <fmt/format.h>

namespace vkdose {
namespace {

std::string vectorPart(const char* array, std::size_t k) {
    return fmt::format("{}[{}].{}", array, k / 4, "xyzw"[k % 4]);
}

/// The text with the prefix, line by line.
std::string prefixed(const std::string& bare, const std::vector<LawToken>& tokens, const IsFunction& isFunction) {
    std::string out;
    std::size_t done = 0;
    for (std::size_t k = 0; k < tokens.size(); ++k) {
        const LawToken& t = tokens[k];
        if (t.kind != LawToken::Kind::Name || (k > 0 && tokens[k - 1].is("."))) continue;
        const bool called = k + 1 < tokens.size() && tokens[k + 1].is("(");
        const bool declares = isLawDeclarer(t) && k + 1 < tokens.size() && tokens[k + 1].is("float");
        const bool ofBothSides = t.is("float") && k > 0 && tokens[k - 1].is("particle");
        const bool ofGlsl = isLawWord(t.text) || (called && isLawFunction(t.text) && !isFunction(t.text));
        if (ofGlsl && !ofBothSides) continue;
        out += bare.substr(done, t.at - done);
        done = t.at + t.text.size();
        if (ofBothSides)
            out += "vec2";
        else if (!declares)
            out += std::string(kUserPrefix) + t.text;
    }
    return out + bare.substr(done);
}

/// The functions by which shaders/law/user_functions.glsl reads parameters, memory and properties.
std::string glue(const UserLaw& law) {
    std::string load, recall, keep, sides, flows;
    for (std::size_t k = 0; k < kMostLawProperties; ++k) {
        const bool there = k < law.properties.size();
        if (there)
            sides += fmt::format("    {0}{1} = vec2(i.{2}, j.{2});\n", kUserPrefix, law.properties[k], "xyzw"[k]);
        const bool flowing = there && law.flows[k] != 0;
        flows += (k > 0 ? ", " : "") +
                 (flowing ? fmt::format("{}{}{}(c)", kUserPrefix, kLawFlow, law.properties[k]) : std::string("0.0"));
    }
    for (std::size_t k = 0; k < law.parameters.size(); ++k)
        load += fmt::format("    {}{} = {};\n", kUserPrefix, law.parameters[k], vectorPart("p.own", k));
    for (std::size_t k = 0; k < law.memories.size(); ++k) {
        recall += fmt::format("    {}{} = {};\n", kUserPrefix, law.memories[k], vectorPart("own", k));
        keep += fmt::format("    {} = {}{};\n", vectorPart("own", k), kUserPrefix, law.memories[k]);
    }
    const auto optional = [](const char* wrapper, const char* function, bool has) {
        return has ? fmt::format("float {}(UserContact c) {{ return {}{}(c); }}\n", wrapper, kUserPrefix, function)
                   : fmt::format("float {}(UserContact c) {{ return 0.0; }}\n", wrapper);
    };
    return fmt::format(
               "void userParameters(ContactParams p) {{\n{}}}\n"
               "void userRecall(vec4 own[2]) {{\n{}}}\n"
               "void userKeep(inout vec4 own[2]) {{\n{}}}\n"
               "void userSides(vec4 i, vec4 j) {{\n{}}}\n"
               "vec4 userFlows(UserContact c) {{ return vec4({}); }}\n",
               load, recall, keep, sides, flows) +
           optional("userDamping", "damping", law.hasDamping) + optional("userPull", "pull", law.hasPull) +
           optional("userEnergy", "energy", law.hasEnergy) + optional("userReach", "reach", law.hasReach);
}

}  // namespace

std::string lawShader(const UserLaw& law, const std::string& bare, const std::vector<LawToken>& tokens,
                      const IsFunction& isFunction) {
    // A second source string, so that the compiler's messages tell the user's own lines.
    return fmt::format("#line 1 1\n{}\n#line 1 0\n{}", prefixed(bare, tokens, isFunction), glue(law));
}

}  // namespace vkdose
