#pragma once
// The doses of a run beside the closed form of their mass, and a note if the two are far apart.

#include <string>
#include <vector>

#include "host/sim/runner.h"

namespace vkdose {

/// Doses beyond this factor, either way, are far from the closed form. Nearer ones need no particular cause: the bulk
/// density of a powder is seldom known to better than 20 %, and a first dose that also fills the throat takes 1.8 times
/// as long (host/advice/schedule_rules.cpp).
inline constexpr double kFarFromClosedForm = 2;

/// Means over the same doses.
struct ClosedFormComparison {
    int doses = 0;          ///< 0: there is nothing to compare
    double mean = 0;        ///< mass of a dose [kg]
    double closedForm = 0;  ///< of the same turns [kg]

    bool isFar() const {
        return doses > 0 && (mean > kFarFromClosedForm * closedForm || mean * kFarFromClosedForm < closedForm);
    }
};

/// The complete doses with a closed form, until 99 % of what was `filled` [kg] is out: an empty canister says nothing
/// about the closed form.
ClosedFormComparison besideClosedForm(const std::vector<Dose>& doses, double filled);

/// A sentence with both figures and the reasons that can be looked into, likely ones with their figures; empty unless
/// the doses are far from the closed form.
std::string closedFormNote(const Case& c, const RunResult& r);

}  // namespace vkdose
