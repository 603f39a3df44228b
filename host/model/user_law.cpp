#include "host/model/user_law.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <map>
#include <optional>
#include <set>

#include "host/core/fnv.h"
#include "host/model/closest_word.h"
#include "host/model/law_checks.h"
#include "host/model/law_cursor.h"
#include "host/model/law_tokens.h"
#include "host/model/user_law_shader.h"

namespace vkdose {
namespace {

const std::vector<std::string> kRequired{"force", "stiffness"};
const std::vector<std::string> kAnswers{"force", "stiffness", "damping", "pull", "energy", "reach"};

bool isAnswer(std::string_view name) {
    return std::ranges::find(kAnswers, name) != kAnswers.end();
}

struct Function {
    double trips = 1;   ///< of the loops in one call
    double tokens = 0;  ///< of its body, with those of the functions that it calls
    bool called = false;
    const LawToken* ofContact = nullptr;  ///< its name, if its only argument is a Contact
};

/// Reads the tokens of a law from the first to the last.
class Parser : private LawCursor {
  public:
    Parser(const std::vector<LawToken>& tokens, UserLaw& law) : LawCursor(tokens), law_(law) {}

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
    }

    bool isFunction(const std::string& name) const { return functions_.contains(name); }

  private:
    void declare(const LawToken& t) {
        if (!names_.insert(t.text).second)
            refuseLaw(t, fmt::format("{} is declared twice", t.text), "remove one of them");
    }

    /// A variable that the engine would take for a function that is missing.
    static void refuseAnswer(const LawToken& t) {
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
        if (first.is("const")) return readConstant();
        if (!isLawType(first.text))
            refuseLaw(first, fmt::format("{} begins no declaration", first.text),
                      "outside of functions there are `parameter float`, `memory float`, `const` and functions");
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

    std::optional<long> integer(const LawToken& t) const {
        if (const auto known = integers_.find(t.text); known != integers_.end()) return known->second;
        if (t.text.size() > 1 && t.text.front() == '0') return {};  // GLSL takes it as octal
        long value = 0;
        const auto [end, error] = std::from_chars(t.text.data(), t.text.data() + t.text.size(), value);
        if (error != std::errc() || end != t.text.data() + t.text.size()) return {};
        return value;
    }

    /// A bound of a loop must stay what it is.
    void refuseShadow(const LawToken& t) const {
        if (integers_.contains(t.text))
            refuseLaw(t, fmt::format("{} is a constant already", t.text), "choose another name");
    }

    void readFunction(const LawToken& type) {
        const LawToken& function = name("a function");
        if (!here("("))
            refuseLaw(function, fmt::format("{} is a variable outside of the functions", function.text),
                      "declare `parameter float`, `memory float` or `const`, or move it into a function");
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
            if (name_ != "force" && is(law_.memories, t))
                refuseLaw(t, fmt::format("{} is a memory, and {} changes it, which only force may do", t.text, name_),
                          "use a local variable of another name, or change it in force");
        }
    }

    /// A slip in the name of an optional function would go unseen.
    void refuseUncalled() const {
        for (const auto& [function, is] : functions_) {
            if (is.ofContact == nullptr || is.called || isAnswer(function)) continue;
            const std::string meant = closestWord(function, kAnswers);
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

    /// To the brace that ends the block. `times` it is made in one call of the function. Returns whether the function
    /// ends in it, whatever happens.
    bool readBlock(double times) {
        bool returns = false;
        while (!here("}")) returns = readStatement(times) || returns;
        ++at_;
        return returns;
    }

    /// A statement within another one, which begins with `outer`. Its constants end with it.
    bool readInner(const LawToken& outer, double times) {
        if (++nesting_ > kMostLawNesting) refuseNesting(outer);
        const std::map<std::string, long> outside = integers_;
        const bool returns = outer.is("{") ? readBlock(times) : readStatement(times);
        integers_ = outside;
        --nesting_;
        return returns;
    }

    bool readStatement(double times) {
        const LawToken& t = next("}");
        if (t.is("{")) return readInner(t, times);
        if (t.is("for")) {
            readLoop(t, times);
            return false;
        }
        if (t.is("if")) {
            expect("(");
            readUntilClosed(times);
            const bool then = readInner(t, times);
            return here("else") && readInner(next("else"), times) && then;
        }
        if ((t.is("parameter") || t.is("memory")) && here("float"))
            refuseLaw(t, fmt::format("a {} is declared inside of {}", t.text, name_),
                      "declare it before the functions");
        --at_;
        readPlain(times);
        return t.is("return");
    }

    /// Whether a statement goes on into a `return`, for want of a semicolon. The compiler tells that in its place.
    bool hidesReturn(std::size_t body) const {
        for (std::size_t k = body; k < at_; ++k) {
            const LawToken& before = tokens_[k - 1];
            const bool begins =
                before.is("{") || before.is("}") || before.is(";") || before.is(")") || before.is("else");
            if (tokens_[k].is("return") && !begins) return true;
        }
        return false;
    }

    static bool isDeclaredType(const LawToken& t) { return isLawType(t.text) || t.is("Contact"); }

    /// What is read before it is written has no value, or another one on each device. `at` is behind the type.
    void refuseUnset(std::size_t at) const {
        for (int depth = 0; !tokens_[at].is(";"); ++at) {
            const LawToken& t = tokens_[at];
            const LawToken& before = tokens_[at - 1];
            if (t.is("(")) ++depth;
            if (t.is(")")) --depth;
            const bool declared = before.is(",") || isDeclaredType(before);
            if (depth == 0 && t.kind == LawToken::Kind::Name && declared && !tokens_[at + 1].is("="))
                refuseLaw(t, fmt::format("{} is declared without a value", t.text),
                          fmt::format("give it one: {} = ...", t.text));
        }
    }

    /// A declaration or an expression.
    void readPlain(double times) {
        const std::size_t first = at_;
        std::size_t type = first;
        while (type + 1 < tokens_.size() && (tokens_[type].is("const") || tokens_[type].is("precise"))) ++type;
        const bool declaration = isLawType(tokens_[type].text);
        int depth = 0;
        while (depth > 0 || !here(";")) {
            const LawToken& part = next(";");
            if (part.is("{") && declaration && at_ > first + 3 && tokens_[type + 2].is("("))
                refuseLaw(tokens_[first], fmt::format("a function begins inside of {}", name_),
                          fmt::format("add the }} that ends {} before it", name_));
            if (part.is("{") || part.is("}")) refuseLaw(part, "the statement before it has no ; or no )", "add it");
            if (part.is("(")) ++depth;
            if (part.is(")")) --depth;
            const LawToken& before = tokens_[at_ > 1 ? at_ - 2 : 0];
            if (declaration && depth == 0 && (before.is(",") || isLawType(before.text))) refuseShadow(part);
            count(part, times);
        }
        if (isDeclaredType(tokens_[type]) && !tokens_[type + 1].is("(")) refuseUnset(type + 1);
        if (at_ == first + 5 && tokens_[first].is("const") && tokens_[first + 1].is("int"))
            if (const auto value = integer(tokens_[first + 4])) integers_[tokens_[first + 2].text] = *value;
        ++at_;
    }

    /// Reads on behind the parenthesis that closes the one before.
    void readUntilClosed(double times) {
        for (int depth = 1; depth > 0;) {
            const LawToken& t = next(")");
            if (t.is("(")) ++depth;
            if (t.is(")")) --depth;
            if (t.is(";") || t.is("{") || t.is("}")) refuseLaw(t, "a parenthesis before it is not closed", "add )");
            count(t, times);
        }
    }

    /// Counts the trips of a function that is called.
    void count(const LawToken& t, double times) {
        if (t.kind != LawToken::Kind::Name || !here("(")) return;
        if (t.text == name_) refuseLaw(t, fmt::format("{} calls itself", t.text), "write a loop");
        if (const auto called = functions_.find(t.text); called != functions_.end()) {
            called->second.called = true;
            addTrips(t, times * called->second.trips, function_.trips);
            grow(t, called->second.tokens);
        }
        if (std::ranges::find(loops_, t.text) != loops_.end())
            refuseLaw(t, "a loop's counter is no function", "rename it");
    }

    static void addTrips(const LawToken& t, double trips, double& sum) {
        sum += trips;
        if (sum > kMostLawTrips)
            refuseLaw(
                t, fmt::format("the loops take {:.6g} trips together; at most {:.0f} are allowed", sum, kMostLawTrips),
                "loop less often");
    }

    void grow(const LawToken& t, double tokens) {
        function_.tokens += tokens;
        if (function_.tokens > double(kMostLawTokens))
            refuseLaw(t,
                      fmt::format("{} has more than {} words and signs, with those of the functions that it calls",
                                  name_, kMostLawTokens),
                      "call them less often, or in a loop");
    }

    [[noreturn]] static void refuseLoop(const LawToken& t) {
        refuseLaw(t, "the loop has no constant bound",
                  "write for (int i = 0; i < 10; ++i), with whole numbers or constants of the type int");
    }

    long bound() {
        bool negative = here("-");
        if (negative) ++at_;
        const LawToken& t = next("a bound");
        const auto value = integer(t);
        if (!value) refuseLoop(t);
        // The device counts in 32 bits: beyond them a counter would begin again, and the loop would not end.
        if (*value > kMostLoopBound)
            refuseLaw(t, fmt::format("{} is beyond what a loop may count to", t.text),
                      fmt::format("stay within {} and its negative", kMostLoopBound));
        return negative ? -*value : *value;
    }

    void readLoop(const LawToken& loop, double times) {
        expect("(");
        if (!here("int")) refuseLoop(loop);
        ++at_;
        const LawToken& named = name("a counter");
        refuseShadow(named);
        const std::string counter = named.text;
        expect("=");
        const long start = bound();
        expect(";");
        if (!next("the counter").is(counter)) refuseLoop(loop);
        const std::string compare = next("<").text;
        const long end = bound();
        expect(";");
        const long step = readStep(loop, counter);
        expect(")");
        const bool up = compare == "<" || compare == "<=", down = compare == ">" || compare == ">=";
        if ((!up && !down) || (up && step <= 0) || (down && step >= 0)) refuseLoop(loop);
        const double way = up ? double(end) - double(start) : double(start) - double(end);
        const double trips = std::max(0.0, way / double(std::abs(step)) + 1);
        addTrips(loop, times * trips, function_.trips);
        const std::size_t body = at_;
        loops_.push_back(counter);
        readInner(loop, times * trips);
        loops_.pop_back();
        refuseChange(body, counter);
    }

    long readStep(const LawToken& loop, const std::string& counter) {
        const LawToken& first = next("a step");
        if (first.is("++") || first.is("--")) {
            if (!next("the counter").is(counter)) refuseLoop(loop);
            return first.is("++") ? 1 : -1;
        }
        if (!first.is(counter)) refuseLoop(loop);
        const LawToken& sign = next("a step");
        if (sign.is("++")) return 1;
        if (sign.is("--")) return -1;
        if (!sign.is("+=") && !sign.is("-=")) refuseLoop(loop);
        return sign.is("+=") ? bound() : -bound();
    }

    /// The counter of a loop may not change in its body, which ends here.
    void refuseChange(std::size_t from, const std::string& counter) const {
        for (std::size_t k = from; k < at_; ++k)
            if (tokens_[k].is(counter) && isChanged(tokens_, k))
                refuseLaw(tokens_[k],
                          fmt::format("the loop changes its counter {}, so that it has no constant bound", counter),
                          "use another variable");
    }

    UserLaw& law_;
    std::set<std::string> names_;
    std::map<std::string, long> integers_;  ///< constants
    std::map<std::string, Function> functions_;
    std::vector<std::string> loops_;  ///< counters of those at work
    std::string name_;                ///< of the function that is read
    Function function_;               ///< the same
    int nesting_ = 0;                 ///< statements around the one that is read
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
