#pragma once
// The result of a member, from the output folder of its run.

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "host/core/csv_table.h"

namespace vkdose {

enum class MemberStatus { Ok, Failed, Interrupted };

/// How a member's run ended: the exit code of `vkdose run` (128 + signal if it was killed), and what it said.
struct MemberEnd {
    int number = 0;
    int code = 0;
    std::string said;
};

struct MemberResult {
    MemberStatus status = MemberStatus::Failed;
    std::string error;
    Row outputs;             ///< of kOutputColumns
    std::vector<bool> told;  ///< of each output: whether the run tells it; an empty output that is told has no value
    std::vector<Row> doses;  ///< rows of the run's doses.csv
};

/// The remains of a member's run, from which its row in members.csv is made.
struct MemberRemains;

/// A column of members.csv behind member, seed and the keys of the axes.
struct MemberColumn {
    const char* name = "";
    const char* unit = "";  ///< as in ColumnText
    const char* meaning = "";
    const char* inSummary = nullptr;                     ///< its place in summary.json, "/a/b"; null: `own` gives it
    std::string (*own)(const MemberRemains&) = nullptr;  ///< gives the value where `inSummary` is null
};
extern const std::span<const MemberColumn> kMemberColumns;

/// The names of kMemberColumns.
extern const Row kOutputColumns;

/// "ok", "failed", "interrupted".
std::string statusText(MemberStatus status);

/// The result that a run left in `folder`. A run that ended with 0 but left nothing readable has failed.
MemberResult readResult(const std::filesystem::path& folder, const MemberEnd& end);

/// The doses that a run noted in `folder`. An empty table if there are none, or if the file is not a run's.
Table dosesIn(const std::filesystem::path& folder);

/// Whether the folder holds a run that is over, so that it need not be repeated.
bool isOver(const std::filesystem::path& folder);

/// Simulated time of the last line of a run's time series [s]; 0 without lines.
double timeReached(const std::filesystem::path& folder);

}  // namespace vkdose
