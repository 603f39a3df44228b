#pragma once
// The table figures.csv of a sweep: what targets can name, of each member.

#include <vector>

#include "host/study/sweep_folder.h"

namespace vkdose {

inline constexpr const char* kFiguresName = "figures.csv";

/// Writes the figures of the `members` that ended well: a row for each, and a column for each figure that one of them
/// has. Throws OutputError.
void writeFigures(const SweepFolder& folder, const Study& study, const std::vector<Member>& members);

}  // namespace vkdose
