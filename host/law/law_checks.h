#pragma once
// What the tokens of a user's law show by themselves, without its grammar.

#include <cstddef>
#include <string>
#include <vector>

#include "host/law/law_tokens.h"

namespace vkdose {

/// Most tokens of a law. Those of a function count again wherever it is called, because devices put its body there.
/// Compilers follow a long expression by recursion, so that without a bound they run out of stack.
inline constexpr std::size_t kMostLawTokens = 10'000;
/// Most brackets within brackets, and most statements within statements.
inline constexpr int kMostLawNesting = 64;

/// Thrown at the first fault: what comes after it may follow from it.
struct LawRefused {
    LawFault fault;
};

[[noreturn]] void refuseLaw(const LawToken& at, std::string problem, std::string remedy);
[[noreturn]] void refuseNesting(const LawToken& at);

/// Refuses words that a law may not hold, arrays, and a law that is too long or too deep.
void checkLawTokens(const std::vector<LawToken>& tokens);

/// Whether the variable whose name is the token `k` is assigned to, counted up or counted down there.
bool isChanged(const std::vector<LawToken>& tokens, std::size_t k);

/// The line on which a law defines a function; 1 if it does not.
int lineOfFunction(const std::string& law, const std::string& function);

}  // namespace vkdose
