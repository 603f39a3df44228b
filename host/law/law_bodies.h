#pragma once
// The bodies of the functions of a user's law, and how much work they are.

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "host/law/law_cursor.h"

namespace vkdose {

/// Reads them, token by token.
class LawBodies : protected LawCursor {
  protected:
    struct Function {
        double trips = 1;   ///< of the loops in one call
        double tokens = 0;  ///< of its body, with those of the functions that it calls
        bool called = false;
        const LawToken* ofContact = nullptr;  ///< its name, if its only argument is a Contact
    };

    using LawCursor::LawCursor;

    /// The whole number that a token stands for, if it is a number of GLSL or a constant of the type int.
    std::optional<long> integer(const LawToken& t) const;
    /// A bound of a loop must stay what it is.
    void refuseShadow(const LawToken& t) const;
    /// To the brace that ends the block. `times` it is made in one call of the function. Returns whether the function
    /// ends in it, whatever happens.
    bool readBlock(double times);
    /// Whether a statement goes on into a `return`, for want of a semicolon. The compiler tells that in its place.
    bool hidesReturn(std::size_t body) const;
    static void addTrips(const LawToken& t, double trips, double& sum);
    /// Adds the tokens of a body, or of a function that it calls.
    void grow(const LawToken& t, double tokens);

    std::map<std::string, long> integers_;  ///< constants
    std::map<std::string, Function> functions_;
    std::string name_;   ///< of the function that is read
    Function function_;  ///< the same

  private:
    /// A statement within another one, which begins with `outer`. Its constants end with it.
    bool readInner(const LawToken& outer, double times);
    bool readStatement(double times);
    /// A declaration or an expression.
    void readPlain(double times);
    static bool isDeclaredType(const LawToken& t);
    /// What is read before it is written has no value, or another one on each device. `at` is behind the type.
    void refuseUnset(std::size_t at) const;
    /// Reads on behind the parenthesis that closes the one before.
    void readUntilClosed(double times);
    /// Counts the trips of a function that is called.
    void count(const LawToken& t, double times);

    void readLoop(const LawToken& loop, double times);
    long bound();
    long readStep(const LawToken& loop, const std::string& counter);
    [[noreturn]] static void refuseLoop(const LawToken& t);
    /// The counter of a loop may not change in its body, which ends here.
    void refuseChange(std::size_t from, const std::string& counter) const;

    std::vector<std::string> loops_;  ///< counters of those at work
    int nesting_ = 0;                 ///< statements around the one that is read
};

}  // namespace vkdose
