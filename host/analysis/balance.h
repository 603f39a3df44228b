#pragma once
// The readings of a balance, dose after dose.

#include <filesystem>
#include <vector>

namespace vkdose {

struct BalanceReadings {
    std::vector<double> mass;        ///< of each dose [kg]
    std::vector<double> cumulative;  ///< up to and with it [kg]
};

/// Reads a CSV with the columns dose (1, 2, ...) and mass_g or cumulative_g. People may have written it: the columns
/// may stand in any order and others beside them, and the last line may have no end. Throws CaseError, naming line and
/// column.
BalanceReadings readBalance(const std::filesystem::path& file);

}  // namespace vkdose
