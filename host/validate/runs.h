#pragma once
// The runs of a comparison, read from the folder of its sweep.

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "host/core/vec.h"

namespace vkdose::validate {

// NOLINTNEXTLINE(bugprone-exception-escape): no member of the JSON library throws when it is moved
struct Run {
    std::map<std::string, std::string> at;  ///< the keys that vary, as they stand in members.csv
    nlohmann::ordered_json summary;
    std::filesystem::path folder;

    /// The value of a key that varies. Throws CaseError if it is not one, or is no number.
    double value(const std::string& key) const;
    /// The three numbers of one, likewise.
    Vec3 vector(const std::string& key) const;
    /// A figure of the summary by its JSON pointer, "/measures/heap/angle_deg"; NaN without it.
    double figure(const std::string& pointer) const;
    /// A column of the time series. Throws CaseError without it.
    std::vector<double> series(const std::string& column) const;
};

/// The members that have ended well, in the order of the table. Throws CaseError if a file is missing or damaged.
std::vector<Run> readRuns(const std::filesystem::path& sweep);

}  // namespace vkdose::validate
