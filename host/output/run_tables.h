#pragma once
// The tables that a run leaves, for the manual.

#include <string>
#include <vector>

#include "host/core/columns.h"

namespace vkdose {

/// A kind of CSV file.
struct OutputTable {
    std::string file;   ///< its name in the output folder
    std::string about;  ///< what a line of it stands for, one sentence
    std::vector<ColumnText> columns;
};

/// Every CSV file of a run's output folder.
std::vector<OutputTable> runTables();

}  // namespace vkdose
