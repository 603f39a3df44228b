#pragma once
// Warnings about a case that is valid and yet hardly what was meant. They never stop a run.

#include <string>
#include <vector>

#include "host/model/case.h"

namespace vkdose {

/// One warning. `key` names the value to look at first, as a case file has it.
struct Warning {
    std::string name;   ///< of the rule: "settle-time"
    std::string key;    ///< "settle.time_s"
    std::string value;  ///< of that key in the resolved case, and whether it was softened; empty if the case has none
    std::string text;   ///< the finding, with its figures
    std::string cure;
    bool accepted = false;  ///< the case names it in `accepted_warnings`

    /// "settle.time_s = 0.05: text; cure (settle-time)"
    std::string line() const;
};

/// Every warning about a case and its particles, in the order of the rules. Accepted ones are among them.
std::vector<Warning> warningsOf(const Case& c, const Insertion& filled);

/// The names of all rules.
std::vector<std::string> warningNames();

}  // namespace vkdose
