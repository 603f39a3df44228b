#pragma once
// How many doses it takes to empty a canister, by the paper's several measures.

#include <optional>
#include <span>

#include "host/model/case.h"

namespace vkdose {

/// The first dose after which `fraction` of the `filled` mass [kg] is out; none if that was never reached. The paper
/// counts the doses "when 99 percent of the total powder mass in the canister is dosed" (effect of initial mass).
std::optional<int> dosesToFraction(std::span<const double> cumulative, double filled, double fraction = 0.99);

/// The dose with which a stop rule on the mass holds, even if the run ended for another reason; none if it never does.
/// `dosed` [kg] holds the mass of each dose. A dose lighter than rounding (1e-6 of `filled`, the ledger's tolerance)
/// counts as none.
std::optional<int> dosesToRule(std::span<const double> dosed, double filled, const StopRule& rule);

}  // namespace vkdose
