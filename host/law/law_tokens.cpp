#include "host/law/law_tokens.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <regex>
#include <utility>

#include "host/core/number.h"

namespace vkdose {
namespace {

constexpr std::array<std::string_view, 20> kTypes{"float", "int",   "uint",  "bool",  "vec2",  "vec3",  "vec4",
                                                  "ivec2", "ivec3", "ivec4", "uvec2", "uvec3", "uvec4", "bvec2",
                                                  "bvec3", "bvec4", "mat2",  "mat3",  "mat4",  "void"};
constexpr std::array<std::string_view, 11> kWords{"if",    "else", "for",   "return",  "const",   "in",
                                                  "break", "true", "false", "precise", "continue"};
constexpr std::array<std::string_view, 52> kFunctions{"abs",        "sign",        "floor",         "ceil",
                                                      "fract",      "mod",         "min",           "max",
                                                      "clamp",      "mix",         "step",          "sqrt",
                                                      "pow",        "exp",         "log",           "exp2",
                                                      "log2",       "sin",         "cos",           "tan",
                                                      "asin",       "acos",        "atan",          "sinh",
                                                      "cosh",       "tanh",        "asinh",         "acosh",
                                                      "atanh",      "length",      "dot",           "cross",
                                                      "normalize",  "distance",    "isnan",         "isinf",
                                                      "trunc",      "round",       "radians",       "degrees",
                                                      "any",        "all",         "not",           "equal",
                                                      "lessThan",   "fma",         "notEqual",      "greaterThan",
                                                      "smoothstep", "inversesqrt", "lessThanEqual", "greaterThanEqual"};

struct Refusal {
    std::string_view word;  ///< with a star at its end: all that begin so
    std::string_view why;
};
constexpr std::string_view kNoTables = "reaches for what belongs to the program: a law sees only its arguments";
constexpr std::string_view kNoOthers = "concerns other contacts: a law answers for one contact alone";
constexpr Refusal kRefusals[] = {
    {"gl_*", "names that begin with gl_ belong to the device"},
    {"layout", kNoTables},
    {"uniform", kNoTables},
    {"buffer", kNoTables},
    {"shared", kNoTables},
    {"sampler*", kNoTables},
    {"image*", kNoTables},
    {"texture*", kNoTables},
    {"texelFetch*", kNoTables},
    {"coherent", kNoTables},
    {"volatile", kNoTables},
    {"readonly", kNoTables},
    {"writeonly", kNoTables},
    {"restrict", kNoTables},
    {"atomic*", kNoOthers},
    {"barrier", kNoOthers},
    {"memoryBarrier*", kNoOthers},
    {"groupMemoryBarrier", kNoOthers},
    {"subgroup*", kNoOthers},
    {"discard", "is of fragment shaders; a law returns an answer"},
    {"while", "has no constant bound: write for (int i = 0; i < 10; ++i)"},
    {"do", "has no constant bound: write for (int i = 0; i < 10; ++i)"},
    {"goto", "is not in the language"},
    {"switch", "is not in the language of laws: write if"},
    {"struct", "is not in the language of laws"},
    {"out", "is not in the language of laws: a function gives its result by return"},
    {"inout", "is not in the language of laws: a function gives its result by return"},
    {"double", "is not on every device: write float"},
    {"dvec*", "is not on every device: write vec"},
    {"dmat*", "is not on every device: write mat"},
    {"precision", "is set by the program"},
    {"invariant", "is set by the program"},
    {"subroutine", "is not in the language of laws"},
    {"varying", "is not in the language of laws"},
    {"attribute", "is not in the language of laws"},
};

/// What some editors put before a text.
constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";

bool isNameStart(char c) {
    return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_';
}
bool isNamePart(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

template <std::size_t n>
bool holds(const std::array<std::string_view, n>& words, std::string_view name) {
    return std::find(words.begin(), words.end(), name) != words.end();
}

/// How many characters from `at` on are a comment; 0: none. One that does not end goes to the text's end.
std::size_t commentAt(const std::string& text, std::size_t at) {
    const std::string_view begins = std::string_view(text).substr(at, 2);
    if (begins == "//") return std::min(text.find('\n', at), text.size()) - at;
    if (begins != "/*") return 0;
    const std::size_t end = text.find("*/", at + 2);
    return (end == std::string::npos ? text.size() : end + 2) - at;
}

/// Where the characters end that may belong to a number which begins at `at`.
std::size_t numberEnd(const std::string& text, std::size_t at) {
    const std::string begins = text.substr(at, 2);
    const bool hexadecimal = begins == "0x" || begins == "0X";
    std::size_t end = at;
    while (end < text.size()) {
        const bool exponentSign = (text[end] == '+' || text[end] == '-') && end > at &&
                                  (text[end - 1] == 'e' || text[end - 1] == 'E') && !hexadecimal;
        if (!isNamePart(text[end]) && text[end] != '.' && !exponentSign) break;
        ++end;
    }
    return end;
}

/// What GLSL takes for one number. Behind anything else a name could hide.
bool isNumber(const std::string& text) {
    static const std::regex whole("(0[xX][0-9a-fA-F]+|[0-9]+)[uU]?");
    static const std::regex real("([0-9]+\\.[0-9]*|\\.[0-9]+|[0-9]+)([eE][+-]?[0-9]+)?([fF]|lf|LF)?");
    constexpr std::size_t kLongest = 60;  // std::regex calls itself for each character
    return text.size() <= kLongest && (std::regex_match(text, whole) || std::regex_match(text, real));
}

}  // namespace

std::vector<LawToken> lawTokens(const std::string& text, std::string& bare, std::vector<LawFault>& faults) {
    constexpr std::array<std::string_view, 2> kTriples{"<<=", ">>="};
    constexpr std::array<std::string_view, 19> kDoubles{"++", "--", "+=", "-=", "*=", "/=", "%=", "==", "!=", "<=",
                                                        ">=", "&&", "||", "^^", "<<", ">>", "|=", "&=", "^="};
    constexpr std::string_view kSigns = "+-*/%=<>!&|^~?:;,.(){}[]";
    std::vector<LawToken> tokens;
    bare = text;
    int line = 1;
    std::size_t at = 0;
    if (text.starts_with(kByteOrderMark))
        for (; at < kByteOrderMark.size(); ++at) bare[at] = ' ';
    while (at < text.size()) {
        const char c = text[at];
        if (const std::size_t length = commentAt(text, at); length > 0) {
            if (text[at + 1] == '*' && text.find("*/", at + 2) == std::string::npos) {
                faults.push_back({line, "a comment that begins here has no end", "add */ where it should end"});
                return tokens;
            }
            for (std::size_t end = at + length; at < end; ++at)
                if (text[at] == '\n')
                    ++line;
                else
                    bare[at] = ' ';
            continue;
        }
        std::size_t end = at + 1;
        if (isNameStart(c)) {
            while (end < text.size() && isNamePart(text[end])) ++end;
            tokens.push_back({LawToken::Kind::Name, text.substr(at, end - at), line, at});
        } else if (isDigit(c) || (c == '.' && end < text.size() && isDigit(text[end]))) {
            end = numberEnd(text, at);
            tokens.push_back({LawToken::Kind::Number, text.substr(at, end - at), line, at});
            if (!isNumber(tokens.back().text)) {
                faults.push_back({line, fmt::format("{} is no number", tokens.back().text.substr(0, 60)),
                                  "write it as 2, 2.0, 2e-3 or 0x2"});
                return tokens;
            }
        } else if (kSigns.find(c) != std::string_view::npos) {
            if (holds(kTriples, std::string_view(text).substr(at, 3)))
                end += 2;
            else if (holds(kDoubles, std::string_view(text).substr(at, 2)))
                ++end;
            tokens.push_back({LawToken::Kind::Sign, text.substr(at, end - at), line, at});
        } else if (c == '\n') {
            ++line;
        } else if (c == '#') {
            faults.push_back({line, "directives (#) are not in the language of laws", "remove the line"});
            return tokens;
        } else if (c != ' ' && c != '\t' && c != '\r') {
            const auto byte = static_cast<unsigned char>(c);
            faults.push_back({line,
                              byte < 0x21 || byte > 0x7e ? fmt::format("the byte {:#04x} means nothing here", byte)
                                                         : fmt::format("the character {} means nothing here", c),
                              "remove it; comments may hold anything"});
            return tokens;
        }
        at = end;
    }
    return tokens;
}

bool isLawType(std::string_view name) {
    return holds(kTypes, name);
}
bool isLawWord(std::string_view name) {
    return isLawType(name) || holds(kWords, name);
}
bool isLawDeclarer(const LawToken& token) {
    return token.is("parameter") || token.is("memory") || token.is("particle");
}

bool isLawFunction(std::string_view name) {
    return holds(kFunctions, name);
}

std::string_view refusalOf(std::string_view name) {
    for (const Refusal& r : kRefusals) {
        const bool family = r.word.ends_with('*');
        if (family ? name.starts_with(r.word.substr(0, r.word.size() - 1)) : name == r.word) return r.why;
    }
    return {};
}

}  // namespace vkdose
