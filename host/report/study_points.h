#pragma once
// The members of a sweep, gathered into points: those that differ in nothing but the seed.

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "host/analysis/beta.h"
#include "host/core/csv_table.h"
#include "host/report/expected.h"

namespace vkdose::report {

/// The parts of study.toml that a report needs.
struct StudyHead {
    std::string name, reason;
    std::vector<std::vector<std::string>> axes;  ///< keys of each
    double target = 0;                           ///< [kg/dose] of [calibrate]; NaN without
    bool searches = false;                       ///< its points are those of a search
    bool designs = false;                        ///< that of a [design]
};

/// Reads study.toml. The axes of a sweep without one are the columns between seed and status of `members`.
StudyHead readHead(const std::filesystem::path& folder, const Table& members);

struct StudyPoint {
    Point point;
    int finished = 0, failed = 0;     ///< members; interrupted ones are neither
    std::vector<std::string> errors;  ///< of those that failed, each once
    double beta = 0, betaError = 0;   ///< mean over the seeds [kg/dose]; of one seed the slope's own error
    bool errorOverSeeds = false;      ///< what kind of error that is
    double closedForm = 0;            ///< [kg/dose]; NaN if none is known
    std::vector<Estimate> doses;      ///< mass of dose 1, 2, ... over the seeds [kg]
};

/// The points in the order in which their first members stand in members.csv. The doses are taken from doses.csv. So is
/// beta where members.csv has none. The conditions of a point come from its columns and from its member's resolved
/// case. Without that case they come from [set] of study.toml and from base.toml, in this order.
std::vector<StudyPoint> readPoints(const std::filesystem::path& folder, const StudyHead& head, const Table& members);

}  // namespace vkdose::report
