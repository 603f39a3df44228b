#pragma once
// What is told of the powder that a run was given while it went on.

#include <string>
#include <vector>

#include "host/sim/runner.h"

namespace vkdose {

/// As many refills of one table are told one by one; more of them would push all else from the screen.
inline constexpr std::size_t kToldRefills = 4;

/// A refill, or all that were added of a table that has more than kToldRefills.
struct AddedSeries {
    AddedPowder first, last;
    std::size_t particles = 0;  ///< of all
    double mass = 0;            ///< of all [kg]

    bool single() const { return first.refill == last.refill; }
    std::string name() const;  ///< "spoon", "inlet-1 to inlet-59"
    std::string when() const;  ///< "at t = 4 s", "from t = 0.05 s to 2.95 s"
    std::string text() const;  ///< "10 g in 812 spheres, at t = 4 s"
};

/// How many refills a [[refill]] gives.
std::size_t refillsOfTable(const std::vector<Refill>& refills, std::size_t table);

/// In the order of their first times. `added` is in the order of time.
std::vector<AddedSeries> seriesOf(const std::vector<AddedPowder>& added);

}  // namespace vkdose
