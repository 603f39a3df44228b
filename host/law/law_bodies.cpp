#include "host/law/law_bodies.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "host/law/user_law.h"

namespace vkdose {

std::optional<long> LawBodies::integer(const LawToken& t) const {
    if (const auto known = integers_.find(t.text); known != integers_.end()) return known->second;
    if (t.text.size() > 1 && t.text.front() == '0') return {};  // GLSL takes it as octal
    long value = 0;
    const auto [end, error] = std::from_chars(t.text.data(), t.text.data() + t.text.size(), value);
    if (error != std::errc() || end != t.text.data() + t.text.size()) return {};
    return value;
}

void LawBodies::refuseShadow(const LawToken& t) const {
    if (integers_.contains(t.text))
        refuseLaw(t, fmt::format("{} is a constant already", t.text), "choose another name");
}

bool LawBodies::readBlock(double times) {
    bool returns = false;
    while (!here("}")) returns = readStatement(times) || returns;
    ++at_;
    return returns;
}

bool LawBodies::readInner(const LawToken& outer, double times) {
    if (++nesting_ > kMostLawNesting) refuseNesting(outer);
    const std::map<std::string, long> outside = integers_;
    const bool returns = outer.is("{") ? readBlock(times) : readStatement(times);
    integers_ = outside;
    --nesting_;
    return returns;
}

bool LawBodies::readStatement(double times) {
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
    if (isLawDeclarer(t) && here("float"))
        refuseLaw(t, fmt::format("a {} is declared inside of {}", t.text, name_), "declare it before the functions");
    --at_;
    readPlain(times);
    return t.is("return");
}

bool LawBodies::hidesReturn(std::size_t body) const {
    for (std::size_t k = body; k < at_; ++k) {
        const LawToken& before = tokens_[k - 1];
        const bool begins = before.is("{") || before.is("}") || before.is(";") || before.is(")") || before.is("else");
        if (tokens_[k].is("return") && !begins) return true;
    }
    return false;
}

bool LawBodies::isDeclaredType(const LawToken& t) {
    return isLawType(t.text) || t.is("Contact");
}

void LawBodies::refuseUnset(std::size_t at) const {
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

void LawBodies::readPlain(double times) {
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

void LawBodies::readUntilClosed(double times) {
    for (int depth = 1; depth > 0;) {
        const LawToken& t = next(")");
        if (t.is("(")) ++depth;
        if (t.is(")")) --depth;
        if (t.is(";") || t.is("{") || t.is("}")) refuseLaw(t, "a parenthesis before it is not closed", "add )");
        count(t, times);
    }
}

void LawBodies::count(const LawToken& t, double times) {
    if (t.kind != LawToken::Kind::Name || !here("(")) return;
    if (t.text == name_) refuseLaw(t, fmt::format("{} calls itself", t.text), "write a loop");
    if (const auto called = functions_.find(t.text); called != functions_.end()) {
        called->second.called = true;
        addTrips(t, times * called->second.trips, function_.trips);
        grow(t, called->second.tokens);
    }
    if (std::ranges::find(loops_, t.text) != loops_.end()) refuseLaw(t, "a loop's counter is no function", "rename it");
}

void LawBodies::addTrips(const LawToken& t, double trips, double& sum) {
    sum += trips;
    if (sum > kMostLawTrips)
        refuseLaw(t,
                  fmt::format("the loops take {:.6g} trips together; at most {:.0f} are allowed", sum, kMostLawTrips),
                  "loop less often");
}

void LawBodies::grow(const LawToken& t, double tokens) {
    function_.tokens += tokens;
    if (function_.tokens > double(kMostLawTokens))
        refuseLaw(t,
                  fmt::format("{} has more than {} words and signs, with those of the functions that it calls", name_,
                              kMostLawTokens),
                  "call them less often, or in a loop");
}

void LawBodies::refuseLoop(const LawToken& t) {
    refuseLaw(t, "the loop has no constant bound",
              "write for (int i = 0; i < 10; ++i), with whole numbers or constants of the type int");
}

long LawBodies::bound() {
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

void LawBodies::readLoop(const LawToken& loop, double times) {
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

long LawBodies::readStep(const LawToken& loop, const std::string& counter) {
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

void LawBodies::refuseChange(std::size_t from, const std::string& counter) const {
    for (std::size_t k = from; k < at_; ++k)
        if (tokens_[k].is(counter) && isChanged(tokens_, k))
            refuseLaw(tokens_[k],
                      fmt::format("the loop changes its counter {}, so that it has no constant bound", counter),
                      "use another variable");
}

}  // namespace vkdose
