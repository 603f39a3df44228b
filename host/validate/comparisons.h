#pragma once
// The comparisons with the literature that come with the program. Each is a study in cases/validate, run like any other
// sweep, and a function that makes figures, verdicts and curves of its runs. A new one is a file with such a function
// and a line in comparisons.cpp.

#include <filesystem>
#include <string>
#include <vector>

#include "host/validate/finding.h"
#include "host/validate/runs.h"

namespace vkdose::validate {

struct Comparison {
    const char* name;    ///< also of its study, cases/validate/NAME.toml, and of that at full size, full/NAME.toml
    const char* what;    ///< one line for people
    const char* source;  ///< the publication
    /// `studies` is the folder of the study's file, where what belongs to it lies. Throws CaseError.
    Evaluation (*evaluate)(const std::vector<Run>& runs, const std::filesystem::path& studies);
};

const std::vector<Comparison>& comparisons();

Evaluation anand(const std::vector<Run>& runs, const std::filesystem::path& studies);
Evaluation beverloo(const std::vector<Run>& runs, const std::filesystem::path& studies);
Evaluation planeShear(const std::vector<Run>& runs, const std::filesystem::path& studies);
Evaluation longScrew(const std::vector<Run>& runs, const std::filesystem::path& studies);
Evaluation ringShear(const std::vector<Run>& runs, const std::filesystem::path& studies);
Evaluation screw(const std::vector<Run>& runs, const std::filesystem::path& studies);
Evaluation heap(const std::vector<Run>& runs, const std::filesystem::path& studies);
Evaluation dostaBall(const std::vector<Run>& runs, const std::filesystem::path& studies);
Evaluation dostaSilo(const std::vector<Run>& runs, const std::filesystem::path& studies);
Evaluation dostaDrum(const std::vector<Run>& runs, const std::filesystem::path& studies);

/// A comparison that cannot be made, with the reason; it stands in the tables beside the others.
struct Missing {
    const char* name;
    const char* what;
    const char* why;
};
const std::vector<Missing>& missingComparisons();

}  // namespace vkdose::validate
