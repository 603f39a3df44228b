#pragma once
// The words of a user's law.

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "host/law/user_law.h"

namespace vkdose {

struct LawToken {
    enum class Kind { Name, Number, Sign };
    Kind kind = Kind::Sign;
    std::string text;
    int line = 0;
    std::size_t at = 0;  ///< in the text

    bool is(std::string_view word) const { return text == word; }
};

/// The tokens of a text without its comments, and faults for characters that a law may not hold. `bare` receives the
/// text with blanks in place of comments, line by line as it was.
std::vector<LawToken> lawTokens(const std::string& text, std::string& bare, std::vector<LawFault>& faults);

/// Whether a law may use this word of GLSL as it is: a type or a word of its grammar; a function.
bool isLawWord(std::string_view name);
bool isLawFunction(std::string_view name);
bool isLawType(std::string_view name);
/// Whether it begins a declaration outside of functions that GLSL does not have: parameter, memory, particle.
bool isLawDeclarer(const LawToken& token);

/// Why a law may not use this word; empty if it may.
std::string_view refusalOf(std::string_view name);

}  // namespace vkdose
