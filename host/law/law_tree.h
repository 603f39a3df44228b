#pragma once
// A user's law as a tree: what it declares, its functions, their statements and expressions.

#include <memory>
#include <string>
#include <vector>

#include "host/law/law_tokens.h"
#include "host/law/law_value.h"

namespace vkdose {

struct LawFunction;

/// Each variable has a place of its own among all variables of the law: no function calls itself.
struct LawExpression {
    enum class Kind : std::uint8_t {
        Number,     ///< `number`
        Variable,   ///< at `place`, or its `parts`
        Parts,      ///< of the only operand
        Prefix,     ///< `word` before the operand
        Chain,      ///< operands from left to right, with the `signs` between them
        And,        ///< operands from left to right, up to the first that is false
        Or,         ///< the same, up to the first that is true
        Choice,     ///< the first operand chooses between the others
        Sequence,   ///< the value of the last operand
        Assign,     ///< the operand to the variable; `word` is the sign before =, if any
        Step,       ///< the variable by one, as `word` says; `after`: the value is that before
        Call,       ///< of `function` with the operands
        Language,   ///< of the language's function `word` with the operands
        Construct,  ///< of `type` with the operands
    };
    Kind kind = Kind::Number;
    LawValue number;
    std::size_t place = 0;
    std::vector<int> parts{};  ///< elements of the variable, or of the operand; empty: all
    std::string word{};
    std::vector<std::string> signs{};
    bool after = false;
    const LawFunction* function = nullptr;
    LawType type{};
    std::vector<LawExpression> operands{};
};

struct LawStatement {
    enum class Kind : std::uint8_t { Expression, Declare, If, For, Return, Break, Continue, Block };
    Kind kind = Kind::Block;
    // Declare: of a variable of `type` at `place` with the first expression for its value. If and For: the first
    // expression is the condition. For: the second is the step; the first of `inner` is made before it. Return: none or
    // one.
    std::size_t place = 0;
    LawType type{};
    std::vector<LawExpression> expressions{};
    std::vector<LawStatement> inner{};  ///< If: what is made if the condition holds, and what else
};

struct LawFunction {
    std::string name;
    LawType type;
    std::vector<std::size_t> arguments;  ///< places
    std::vector<LawType> argumentTypes;
    LawStatement body;
};

struct LawTree {
    std::vector<std::size_t> parameters, memories, properties;  ///< places, in the order of their declaration
    std::vector<LawStatement> constants;                        ///< declarations
    std::vector<std::unique_ptr<LawFunction>> functions;
    std::size_t places = 0;  ///< how many variables there are

    const LawFunction* function(std::string_view name) const;
};

/// Reads a text that readLaw and a compiler of the language accept. Throws LawRefused where it is not in the language,
/// or nested so deeply that a processor's stack may not hold it.
LawTree lawTree(const std::vector<LawToken>& tokens);

}  // namespace vkdose
