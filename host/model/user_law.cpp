#include "host/model/user_law.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <map>
#include <optional>
#include <set>

#include "host/core/fnv.h"
#include "host/model/law_tokens.h"
#include "host/model/user_law_shader.h"

namespace vkdose {
namespace {

constexpr std::string_view kRequired[] = {"force", "stiffness"};
constexpr std::string_view kOptional[] = {"damping", "pull", "energy", "reach"};

bool isAnswer(std::string_view name) {
    return std::ranges::find(kRequired, name) != std::end(kRequired) ||
           std::ranges::find(kOptional, name) != std::end(kOptional);
}

/// Thrown at the first fault: what comes after it may follow from it.
struct Refused {
    LawFault fault;
};

/// Reads the tokens of a law from the first to the last.
class Parser {
  public:
    Parser(const std::vector<LawToken>& tokens, UserLaw& law) : tokens_(tokens), law_(law) {}

    void read() {
        for (const LawToken& t : tokens_) {
            if (t.kind != LawToken::Kind::Name) continue;
            if (const std::string_view why = refusalOf(t.text); !why.empty())
                refuse(t, fmt::format("{}: {}", t.text, why), "write it without");
            if (t.text.find("__") != std::string::npos)
                refuse(t, fmt::format("{}: names with two underscores are the compiler's", t.text),
                       "choose another name");
        }
        while (at_ < tokens_.size()) readDeclaration();
        for (const std::string_view name : kRequired)
            if (!functions_.contains(std::string(name)))
                refuse(last(), fmt::format("the function {} is missing", name),
                       fmt::format("add float {}(Contact c) {{ return ...; }}", name));
        law_.hasDamping = functions_.contains("damping");
        law_.hasPull = functions_.contains("pull");
        law_.hasEnergy = functions_.contains("energy");
        law_.hasReach = functions_.contains("reach");
    }

    bool isFunction(const std::string& name) const { return functions_.contains(name); }

  private:
    [[noreturn]] static void refuse(const LawToken& t, std::string problem, std::string remedy) {
        throw Refused{{t.line, std::move(problem), std::move(remedy)}};
    }
    LawToken last() const { return tokens_.empty() ? LawToken{LawToken::Kind::Sign, "", 1, 0} : tokens_.back(); }

    const LawToken& next(const char* wanted) {
        if (at_ >= tokens_.size()) refuse(last(), fmt::format("the text ends where {} should come", wanted), "add it");
        return tokens_[at_++];
    }
    const LawToken& expect(std::string_view sign) {
        const LawToken& t = next(std::string(sign).c_str());
        if (!t.is(sign)) refuse(t, fmt::format("{} stands where {} should come", t.text, sign), "write it so");
        return t;
    }
    const LawToken& name(const char* of) {
        const LawToken& t = next(of);
        if (t.kind != LawToken::Kind::Name || isLawWord(t.text) || t.is("parameter") || t.is("memory") ||
            t.is("Contact"))
            refuse(t, fmt::format("{} is no name of {}", t.text, of), "give a name");
        return t;
    }
    bool here(std::string_view word) const { return at_ < tokens_.size() && tokens_[at_].is(word); }

    void declare(const LawToken& t) {
        if (!names_.insert(t.text).second) refuse(t, fmt::format("{} is declared twice", t.text), "remove one of them");
    }

    void readNames(std::vector<std::string>& names, const char* kind, std::size_t most) {
        expect("float");
        for (;;) {
            const LawToken& t = name(kind);
            declare(t);
            if (isAnswer(t.text)) refuse(t, fmt::format("{} is the name of a function", t.text), "choose another name");
            names.push_back(t.text);
            if (names.size() > most)
                refuse(t, fmt::format("is {} {} of a law, and there is room for {}", names.size(), kind, most),
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
            refuse(first, fmt::format("{} begins no declaration", first.text),
                   "outside of functions there are `parameter float`, `memory float`, `const` and functions");
        readFunction(first);
    }

    void readConstant() {
        const LawToken& type = next("a type");
        const LawToken& constant = name("a constant");
        declare(constant);
        expect("=");
        if (type.is("int") && at_ + 1 < tokens_.size() && tokens_[at_ + 1].is(";"))
            if (const auto value = integer(tokens_[at_])) integers_[constant.text] = *value;
        while (!here(";")) {
            const LawToken& t = next(";");
            if (t.is("{") || t.is("}")) refuse(t, "the constant's line has no ;", "add it");
        }
        ++at_;
    }

    std::optional<long> integer(const LawToken& t) const {
        if (const auto known = integers_.find(t.text); known != integers_.end()) return known->second;
        long value = 0;
        const auto [end, error] = std::from_chars(t.text.data(), t.text.data() + t.text.size(), value);
        if (error != std::errc() || end != t.text.data() + t.text.size()) return {};
        return value;
    }

    /// A bound of a loop must stay what it is.
    void refuseShadow(const LawToken& t) const {
        if (integers_.contains(t.text))
            refuse(t, fmt::format("{} is a constant already", t.text), "choose another name");
    }

    void readFunction(const LawToken& type) {
        const LawToken& function = name("a function");
        if (!here("("))
            refuse(function, fmt::format("{} is a variable outside of the functions", function.text),
                   "declare `parameter float`, `memory float` or `const`, or move it into a function");
        ++at_;
        declare(function);
        if (isLawFunction(function.text))
            refuse(function, fmt::format("{} is a function of GLSL", function.text), "choose another name");
        std::vector<std::string> types;
        while (!here(")")) {
            const LawToken* t = &next(")");
            while (t->is("const") || t->is("in")) t = &next("a type");
            if (!isLawType(t->text) && !t->is("Contact"))
                refuse(*t, fmt::format("{} is no type", t->text), "give float, int, bool, vec2 ... or Contact");
            types.push_back(t->text);
            if (t->is("void") && here(")")) break;
            refuseShadow(name("an argument"));
            if (here(",")) ++at_;
        }
        expect(")");
        if (isAnswer(function.text) && (!type.is("float") || types != std::vector<std::string>{"Contact"}))
            refuse(function, fmt::format("{} has another signature", function.text),
                   fmt::format("write float {}(Contact c) {{ ... }}", function.text));
        if (here(";"))
            refuse(tokens_[at_], fmt::format("{} has no body", function.text), "define a function before it is called");
        expect("{");
        function_ = function.text;
        trips_ = 1;
        const std::map<std::string, long> outside = integers_;
        readBlock(1);
        integers_ = outside;
        functions_[function_] = trips_;
    }

    /// To the brace that ends the block. `times` it is made in one call of the function.
    void readBlock(double times) {
        while (!here("}")) readStatement(times);
        ++at_;
    }

    void readStatement(double times) {
        const LawToken& t = next("}");
        if (t.is("{")) return readBlock(times);
        if (t.is("for")) return readLoop(t, times);
        if (t.is("if")) {
            expect("(");
            readUntilClosed(times);
            readStatement(times);
            if (here("else")) {
                ++at_;
                readStatement(times);
            }
            return;
        }
        if (t.is("const") && here("int") && at_ + 4 < tokens_.size() && tokens_[at_ + 4].is(";"))
            if (const auto value = integer(tokens_[at_ + 3])) {
                refuseShadow(tokens_[at_ + 1]);
                integers_[tokens_[at_ + 1].text] = *value;
            }
        const bool declaration = isLawType(t.text);
        --at_;
        int depth = 0;
        while (depth > 0 || !here(";")) {
            const LawToken& part = next(";");
            if (part.is("{") || part.is("}")) refuse(part, "the statement before it has no ; or no )", "add it");
            if (part.is("(")) ++depth;
            if (part.is(")")) --depth;
            const LawToken& before = tokens_[at_ > 1 ? at_ - 2 : 0];
            if (declaration && depth == 0 && (before.is(",") || isLawType(before.text))) refuseShadow(part);
            count(part, times);
        }
        ++at_;
    }

    /// Reads on behind the parenthesis that closes the one before.
    void readUntilClosed(double times) {
        for (int depth = 1; depth > 0;) {
            const LawToken& t = next(")");
            if (t.is("(")) ++depth;
            if (t.is(")")) --depth;
            if (t.is(";") || t.is("{") || t.is("}")) refuse(t, "a parenthesis before it is not closed", "add )");
            count(t, times);
        }
    }

    /// Counts the trips of a function that is called.
    void count(const LawToken& t, double times) {
        if (t.kind != LawToken::Kind::Name || !here("(")) return;
        if (t.text == function_) refuse(t, fmt::format("{} calls itself", t.text), "write a loop");
        if (const auto called = functions_.find(t.text); called != functions_.end()) add(t, times * called->second);
        if (std::ranges::find(loops_, t.text) != loops_.end())
            refuse(t, "a loop's counter is no function", "rename it");
    }

    void add(const LawToken& t, double trips) {
        trips_ += trips;
        if (trips_ > kMostLawTrips)
            refuse(
                t,
                fmt::format("the loops take {:.6g} trips together; at most {:.0f} are allowed", trips_, kMostLawTrips),
                "loop less often");
    }

    [[noreturn]] static void refuseLoop(const LawToken& t) {
        refuse(t, "the loop has no constant bound",
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
            refuse(t, fmt::format("{} is beyond what a loop may count to", t.text),
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
        add(loop, times * trips);
        const std::size_t body = at_;
        loops_.push_back(counter);
        readStatement(times * trips);
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
        constexpr std::string_view kChanges[] = {"=", "+=", "-=", "*=", "/=", "%=", "|=", "&=", "++", "--", "<<", ">>"};
        const auto changes = [&](std::size_t k) {
            return k < at_ && std::ranges::find(kChanges, tokens_[k].text) != std::end(kChanges);
        };
        for (std::size_t k = from; k < at_; ++k)
            if (tokens_[k].is(counter) &&
                (changes(k + 1) || (k > from && (tokens_[k - 1].is("++") || tokens_[k - 1].is("--")))))
                refuse(tokens_[k],
                       fmt::format("the loop changes its counter {}, so that it has no constant bound", counter),
                       "use another variable");
    }

    const std::vector<LawToken>& tokens_;
    UserLaw& law_;
    std::size_t at_ = 0;
    std::set<std::string> names_;
    std::map<std::string, long> integers_;     ///< constants
    std::map<std::string, double> functions_;  ///< with the trips of their loops
    std::vector<std::string> loops_;           ///< counters of those at work
    std::string function_;
    double trips_ = 0;
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
    } catch (const Refused& refused) {
        reading.faults.push_back(refused.fault);
        return reading;
    }
    law.shader = lawShader(law, bare, tokens, [&](const std::string& f) { return parser.isFunction(f); });
    return reading;
}

}  // namespace vkdose
