#pragma once
// The axes of a study.

#include <filesystem>
#include <set>
#include <string>

#include "host/model/case_reader.h"
#include "host/study/study.h"

namespace vkdose {

/// Faults of the key at `path` when it cannot be varied; `used` holds the keys so far.
bool checkKey(CaseReader& reader, const std::string& path, const std::string& key, std::set<std::string>& used);

/// The first `points` rows of a CSV whose columns are keys. Throws CaseError if it has fewer, or other columns.
Axis axisOfTable(const std::filesystem::path& file, int points);

/// Reads an [[axis]]: values, a range, points spread over a box, or a table. A table's path is relative to `folder`.
Axis readAxis(CaseReader& reader, Section& table, const std::string& path, const std::filesystem::path& folder,
              std::set<std::string>& used);

}  // namespace vkdose
