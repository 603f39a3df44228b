#include "host/law/law_checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace vkdose {

void refuseLaw(const LawToken& at, std::string problem, std::string remedy) {
    throw LawRefused{{at.line, std::move(problem), std::move(remedy)}};
}

void refuseNesting(const LawToken& at) {
    refuseLaw(at, fmt::format("it is nested more than {} deep here", kMostLawNesting),
              "take a part of it into a variable or a function");
}

void checkLawTokens(const std::vector<LawToken>& tokens) {
    constexpr std::string_view kBefore[] = {"-", "+", "!", "~", "++", "--"};  // a row of them is as deep as one of (
    if (tokens.size() > kMostLawTokens)
        refuseLaw(tokens[kMostLawTokens],
                  fmt::format("the law has {} words and signs, and may have {}", tokens.size(), kMostLawTokens),
                  "write it shorter, with functions and loops");
    int depth = 0, signs = 0;
    for (const LawToken& t : tokens) {
        if (t.is("(") || t.is("{")) ++depth;
        if (t.is(")") || t.is("}")) --depth;
        signs = std::ranges::find(kBefore, t.text) != std::end(kBefore) ? signs + 1 : 0;
        if (depth > kMostLawNesting || signs > kMostLawNesting) refuseNesting(t);
        if (t.is("["))
            refuseLaw(t, "arrays and indices are not in the language of laws",
                      "use variables, and .x .y .z .w for the parts of a vector");
        if (t.kind != LawToken::Kind::Name) continue;
        if (const std::string_view why = refusalOf(t.text); !why.empty())
            refuseLaw(t, fmt::format("{}: {}", t.text, why), "write it without");
        if (t.text.find("__") != std::string::npos)
            refuseLaw(t, fmt::format("{}: names with two underscores are the compiler's", t.text),
                      "choose another name");
    }
}

bool isChanged(const std::vector<LawToken>& tokens, std::size_t k) {
    constexpr std::string_view kChanges[] = {
        "=", "+=", "-=", "*=", "/=", "%=", "|=", "&=", "^=", "++", "--", "<<=", ">>="};
    const auto is = [&](std::size_t at, std::string_view sign) { return at < tokens.size() && tokens[at].is(sign); };
    if (k > 0 && is(k - 1, ".")) return false;  // the field of another variable
    // (i).x is still i.
    std::size_t first = k, behind = k + 1;
    for (;;) {
        if (is(behind, "."))
            behind += 2;
        else if (first > 0 && is(first - 1, "(") && is(behind, ")"))
            --first, ++behind;
        else
            break;
    }
    if (first > 0 && (is(first - 1, "++") || is(first - 1, "--"))) return true;
    return behind < tokens.size() && std::ranges::find(kChanges, tokens[behind].text) != std::end(kChanges);
}

int lineOfFunction(const std::string& law, const std::string& function) {
    std::string bare;
    std::vector<LawFault> faults;
    const std::vector<LawToken> tokens = lawTokens(law, bare, faults);
    for (std::size_t k = 1; k + 1 < tokens.size(); ++k)
        if (tokens[k].is(function) && tokens[k - 1].is("float") && tokens[k + 1].is("(")) return tokens[k].line;
    return 1;
}

}  // namespace vkdose
