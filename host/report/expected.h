#pragma once
// A table of published results, and the judgement of each by a study.

#include <filesystem>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace vkdose::report {

/// A value of a case: as text, and as a number if it is one.
struct Setting {
    std::string text;
    double number = std::numeric_limits<double>::quiet_NaN();  ///< if it is one
};

/// One point of a study, averaged over its seeds: the keys of its case that a condition may name, and its outputs in
/// the units of members.csv.
struct Point {
    std::map<std::string, Setting> keys;
    struct Output {
        double mean;
        double standardError;  ///< NaN if it is not known
    };
    std::map<std::string, Output> outputs;
    std::vector<double> cumulative;  ///< mean over the seeds after dose 1, 2, ... [kg]
    struct Place {
        std::vector<std::string> keys;  ///< of one axis: they move together
        std::string label;              ///< their values here
    };
    std::vector<Place> places;  ///< on every axis of the study
};

enum class Kind {
    Value,        ///< a figure
    AtMost,       ///< a figure that is not exceeded
    Falls,        ///< with the key `along`
    Rises,        ///< ditto
    Independent,  ///< of the key `along`, to within `matches`
    Linear,       ///< in the key `along`, to within `matches` of the range
    NotJudged,    ///< nothing in a sweep's tables tells
};

/// One row of the table. Differences are relative.
struct Expected {
    std::string id, what, section, source;
    Kind kind = Kind::Value;
    std::string quantity;  ///< a column of members.csv, or "cumulative_mass_kg" with `dose`
    int dose = 0;
    double value = 0;       ///< in the column's unit
    std::string along;      ///< key of a trend
    double matches = 0.05;  ///< up to this it matches; for trends, see Kind
    double near = 0.2;      ///< up to this it is told how far off; beyond, it contradicts
    std::map<std::string, Setting> where;
};

struct Verdict {
    enum class Kind { Matches, Within, TrendHolds, Contradicts, NotRun, NotJudged };
    Kind kind = Kind::NotRun;
    std::string text;   ///< "matches", "within 7 %", "trend holds", ...
    std::string found;  ///< what the study has: "3.81 ± 0.05 g/dose"
};

/// Reads the table (TOML, [[expected]]). Throws CaseError with every fault found.
std::vector<Expected> readExpected(const std::filesystem::path& file);

/// Judges a result by the points of a study. A point meets a condition if the numbers differ by no more than 1 %, or if
/// the words are equal. A value matches if it is off by no more than `matches`, or by no more than two standard errors
/// of the mean over the points that meet the conditions. A trend is judged along its key, for every combination of the
/// other keys that occurs. Neighbours are compared: a step against the trend counts only beyond two standard errors of
/// the difference, or always if no error is known.
Verdict judge(const Expected& expected, const std::vector<Point>& points);

}  // namespace vkdose::report
