#pragma once
// The findings as people, programs and the report's page read them.

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "host/validate/finding.h"

namespace vkdose::validate {

/// A comparison that was made, or one that could not be.
struct Result {
    std::string name, what, source;
    Evaluation evaluation;

    std::string cost;     ///< "4 runs, 61 s"
    std::string backend;  ///< that of the runs
    std::string missing;  ///< why it could not be made; empty: it was
};

std::string headLine();
std::string tableLine(const Finding& finding);
/// "verdicts: 5 agrees, 1 differs, 3 not comparable"
std::string tally(const std::vector<Result>& results);
/// Figures that differ.
std::size_t differing(const std::vector<Result>& results);

std::string markdownTable(const std::vector<Result>& results);
std::string jsonTable(const std::vector<Result>& results);
/// The data of the page (report::page).
nlohmann::ordered_json pageData(const std::vector<Result>& results);

/// The curves of a comparison as CSV: chart, curve, x, y, error.
std::string curvesCsv(const Evaluation& evaluation);

}  // namespace vkdose::validate
