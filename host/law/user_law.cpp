#include "host/law/user_law.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "host/core/closest_word.h"
#include "host/core/fnv.h"
#include "host/law/law_bodies.h"
#include "host/law/law_checks.h"
#include "host/law/law_tokens.h"
#include "host/law/user_law_shader.h"

namespace vkdose {
namespace {

const std::vector<std::string> kRequired{"force", "stiffness"};
/// Names that particles and fields have in tables, lists and frames, and colours of pictures.
constexpr std::string_view kTaken =
    " id x y z r powder status radius force spin velocity overlap kinetic_energy member material speed vx vy vz wx wy "
    "wz "
    "x_m y_m z_m radius_m vx_m_s vy_m_s vz_m_s wx_rad_s wy_rad_s wz_rad_s periods_gone time time_s phase dose file "
    "density density_kg_m3 volume_fraction momentum momentum_x_kg_m2_s momentum_y_kg_m2_s momentum_z_kg_m2_s "
    "velocity_x_m_s velocity_y_m_s velocity_z_m_s coordination granular_temperature granular_temperature_m2_s2 "
    "kinetic_stress kinetic_stress_xx_Pa kinetic_stress_yy_Pa kinetic_stress_zz_Pa kinetic_stress_yz_Pa "
    "kinetic_stress_zx_Pa kinetic_stress_xy_Pa contact_stress contact_stress_xx_Pa contact_stress_xy_Pa "
    "contact_stress_xz_Pa contact_stress_yx_Pa contact_stress_yy_Pa contact_stress_yz_Pa contact_stress_zx_Pa "
    "contact_stress_zy_Pa contact_stress_zz_Pa ";
const std::vector<std::string> kAnswers{"force", "stiffness", "damping", "pull", "energy", "reach"};

/// Reads the tokens of a law from the first to the last.
class Parser : private LawBodies {
  public:
    Parser(const std::vector<LawToken>& tokens, UserLaw& law) : LawBodies(tokens), law_(law) {}

    void read() {
        checkLawTokens(tokens_);
        while (at_ < tokens_.size()) readDeclaration();
        refuseUncalled();
        for (const std::string& name : kRequired)
            if (!functions_.contains(name))
                refuseLaw(last(), fmt::format("the function {} is missing", name),
                          fmt::format("add float {}(Contact c) {{ return ...; }}", name));
        refuseTrips();
        law_.hasDamping = functions_.contains("damping");
        law_.hasPull = functions_.contains("pull");
        law_.hasEnergy = functions_.contains("energy");
        law_.hasReach = functions_.contains("reach");
        for (const std::string& property : law_.properties)
            law_.flows.push_back(functions_.contains(flowOf(property)) ? 1 : 0);
    }

    bool isFunction(const std::string& name) const { return functions_.contains(name); }

  private:
    static std::string flowOf(const std::string& property) { return std::string(kLawFlow) + property; }

    /// Whether it is the name of a function that the engine calls.
    bool isAnswer(std::string_view name) const {
        const auto flows = [&](const std::string& property) { return name == flowOf(property); };
        return std::ranges::find(kAnswers, name) != kAnswers.end() || std::ranges::any_of(law_.properties, flows);
    }

    void declare(const LawToken& t) {
        if (!names_.insert(t.text).second)
            refuseLaw(t, fmt::format("{} is declared twice", t.text), "remove one of them");
    }

    /// A variable that the engine would take for a function that is missing.
    void refuseAnswer(const LawToken& t) const {
        if (isAnswer(t.text)) refuseLaw(t, fmt::format("{} is the name of a function", t.text), "choose another name");
    }

    void readNames(std::vector<std::string>& names, const char* kind, std::size_t most) {
        expect("float");
        for (;;) {
            const LawToken& t = name(kind);
            declare(t);
            refuseAnswer(t);
            names.push_back(t.text);
            if (names.size() > most)
                refuseLaw(t, fmt::format("is {} {} of a law, and there is room for {}", names.size(), kind, most),
                          "do with fewer");
            if (!here(",")) break;
            ++at_;
        }
        expect(";");
    }

    void readDeclaration() {
        const LawToken& first = next("a declaration");
        if (first.is("parameter")) return readNames(law_.parameters, "parameter", kMostLawParameters);
        if (first.is("memory")) return readNames(law_.memories, "memory", kMostLawMemories);
        if (first.is("particle")) {
            const std::size_t begin = at_;
            readNames(law_.properties, "particle property", kMostLawProperties);
            for (std::size_t k = begin; k < at_; ++k)
                if (kTaken.find(" " + tokens_[k].text + " ") != std::string_view::npos)
                    refuseLaw(tokens_[k], fmt::format("particles have a {} already", tokens_[k].text),
                              "choose another name");
            return;
        }
        if (first.is("const")) return readConstant();
        if (!isLawType(first.text))
            refuseLaw(first, fmt::format("{} begins no declaration", first.text),
                      "outside of functions there are `parameter float`, `memory float`, `particle float`, `const` and "
                      "functions");
        readFunction(first);
    }

    const LawToken& nameOfConstant() {
        const LawToken& t = name("a constant");
        declare(t);
        refuseAnswer(t);
        return t;
    }

    void readConstant() {
        const LawToken& type = next("a type");
        const LawToken& constant = nameOfConstant();
        expect("=");
        if (type.is("int") && at_ + 1 < tokens_.size() && tokens_[at_ + 1].is(";"))
            if (const auto value = integer(tokens_[at_])) integers_[constant.text] = *value;
        for (int depth = 0; !here(";");) {
            const LawToken& t = next(";");
            if (t.is("{") || t.is("}")) refuseLaw(t, "the constant's line has no ;", "add it");
            if (t.is("(")) ++depth;
            if (t.is(")")) --depth;
            if (t.is(",") && depth == 0) nameOfConstant();
        }
        ++at_;
    }

    void readFunction(const LawToken& type) {
        const LawToken& function = name("a function");
        if (!here("("))
            refuseLaw(function, fmt::format("{} is a variable outside of the functions", function.text),
                      "declare `parameter float`, `memory float`, `particle float` or `const`, or move it into a "
                      "function");
        ++at_;
        declare(function);
        if (isLawFunction(function.text))
            refuseLaw(function, fmt::format("{} is a function of GLSL", function.text), "choose another name");
        std::vector<std::string> types;
        while (!here(")")) {
            const LawToken* t = &next(")");
            while (t->is("const") || t->is("in")) t = &next("a type");
            if (!isLawType(t->text) && !t->is("Contact"))
                refuseLaw(*t, fmt::format("{} is no type", t->text), "give float, int, bool, vec2 ... or Contact");
            types.push_back(t->text);
            if (t->is("void") && here(")")) break;
            refuseShadow(name("an argument"));
            if (here(",")) ++at_;
        }
        expect(")");
        if (isAnswer(function.text) && (!type.is("float") || types != std::vector<std::string>{"Contact"}))
            refuseLaw(function, fmt::format("{} has another signature", function.text),
                      fmt::format("write float {}(Contact c) {{ ... }}", function.text));
        if (here(";"))
            refuseLaw(tokens_[at_], fmt::format("{} has no body", function.text),
                      "define a function before it is called");
        expect("{");
        name_ = function.text;
        function_ = {};
        if (types == std::vector<std::string>{"Contact"}) function_.ofContact = &function;
        const std::size_t body = at_;
        const std::map<std::string, long> outside = integers_;
        const bool returns = readBlock(1);
        integers_ = outside;
        if (!returns && !type.is("void") && !hidesReturn(body))
            refuseLaw(function, fmt::format("{} may end without a return, and has no value then", function.text),
                      "end it with one");
        grow(function, double(at_ - body));
        refuseChanges(body);
        functions_[name_] = function_;
    }

    /// A law changes its memory in `force`, and nothing else that outlives the call.
    void refuseChanges(std::size_t body) const {
        const auto is = [](const auto& names, const LawToken& t) {
            return std::ranges::find(names, t.text) != names.end();
        };
        for (std::size_t k = body; k < at_; ++k) {
            const LawToken& t = tokens_[k];
            if (t.kind != LawToken::Kind::Name || !isChanged(tokens_, k)) continue;
            if (is(law_.parameters, t))
                refuseLaw(t, fmt::format("{} is a parameter, and {} changes it", t.text, name_),
                          "use a local variable of another name");
            if (is(law_.properties, t))
                refuseLaw(t, fmt::format("{} is a property of particles, and {} changes it", t.text, name_),
                          fmt::format("say by float {}(Contact c) how it flows", flowOf(t.text)));
            if (name_ != "force" && is(law_.memories, t))
                refuseLaw(t, fmt::format("{} is a memory, and {} changes it, which only force may do", t.text, name_),
                          "use a local variable of another name, or change it in force");
        }
    }

    /// A slip in the name of an optional function would go unseen.
    void refuseUncalled() const {
        for (const auto& [function, is] : functions_) {
            if (is.ofContact == nullptr || is.called || isAnswer(function)) continue;
            std::vector<std::string> answers = kAnswers;
            for (const std::string& property : law_.properties) answers.push_back(flowOf(property));
            const std::string meant = closestWord(function, answers);
            refuseLaw(*is.ofContact, fmt::format("nobody calls the function {}", function),
                      meant.empty() ? "call it, or remove it" : fmt::format("did you mean {}?", meant));
        }
    }

    /// One contact calls all answers. Some devices end the loops of a shader after some ten thousand trips.
    void refuseTrips() const {
        double trips = 0;
        for (const auto& [function, is] : functions_)
            if (isAnswer(function)) addTrips(*is.ofContact, is.trips, trips);
    }

    UserLaw& law_;
    std::set<std::string> names_;
};

}  // namespace

std::string lawHash(std::string_view text) {
    return fmt::format("{:016x}", fnv1a(text));
}

LawReading readLaw(const std::string& name, const std::string& text) {
    LawReading reading;
    UserLaw& law = reading.law;
    law.name = name;
    law.text = text;
    law.hash = lawHash(text);
    std::string bare;
    const std::vector<LawToken> tokens = lawTokens(text, bare, reading.faults);
    if (!reading.faults.empty()) return reading;
    Parser parser(tokens, law);
    try {
        parser.read();
    } catch (const LawRefused& refused) {
        reading.faults.push_back(refused.fault);
        return reading;
    }
    law.shader = lawShader(law, bare, tokens, [&](const std::string& f) { return parser.isFunction(f); });
    return reading;
}

}  // namespace vkdose
